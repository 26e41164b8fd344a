"""Draws quantities of the runs of a figure against time.

A figure can have a reference run. The first quantity of the figure is evaluated along the reference run, and
the result is drawn as a separate line. If the attribute ``difference`` of the figure is True, this line is
omitted, and its values are subtracted from all quantities.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy

from codegen.lab.page.axes import label_axes
from codegen.lab.page.series_style import numbered
from codegen.lab.page.svg import INK
from codegen.lab.pictures.canvas import REFERENCE_LOOKS, REFERENCE_STYLE, WIDE, Canvas, failures, marks
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.scene.figure import Run, TimeSeries

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ONE, SEVERAL = 3.4, 1.7
"""The height of a panel in inches: ONE for a single panel, SEVERAL for two or more panels."""


def draw(figure: TimeSeries, source: Source) -> Drawn:
    """Return the picture of a figure, with one panel for each run."""
    runs, reference = figure.runs, figure.reference
    canvas = Canvas.of(len(runs), 1, ONE if len(runs) == 1 else SEVERAL, width=WIDE)
    numbers: dict[str, dict[str, list[float]]] = {}
    for run, axes in zip(runs, canvas.panels, strict=True):
        times = source.path(run).times
        rows = source.values(run, list(figure.quantities.values()))
        if reference is not None and figure.difference:
            rows = rows - source.beside(run, reference, next(iter(figure.quantities.values())))
        numbers[run.name] = _draw_rows(canvas, axes, figure, run, times, rows)
        if len(runs) > 1:
            axes.set_title(run.name, fontsize=9, color=INK)
        if reference is not None and not figure.difference:
            row = source.values(reference, [next(iter(figure.quantities.values()))])[0]
            exact = _window(figure, source.path(reference).times, row)
            canvas.line(axes, exact, figure.reference_label, REFERENCE_STYLE, looks=REFERENCE_LOOKS)
        label_axes(axes, "time t" if axes is canvas.panels[-1] else "", figure.axis)
    note = failures(runs, [source.path(run).failure for run in runs])
    return Drawn(canvas.finish(figure, source.problem, _ranges(numbers)), note, numbers)


def _draw_rows(
    canvas: Canvas,
    axes: Axes,
    figure: TimeSeries,
    run: Run,
    times: numpy.ndarray,
    rows: numpy.ndarray,
) -> dict[str, list[float]]:
    """Draw the quantities of a run, and return the least and the largest drawn value for each label.

    Each row of ``rows`` contains the values of one quantity.
    """
    numbers = {}
    for k, (label, row) in enumerate(zip(figure.quantities, rows, strict=True)):
        style = numbered(k)
        x, y = _window(figure, times, row)
        chosen = marks(len(x), (k + 0.5) / len(rows))
        texts = [f"{run.name}, {label}: {y[i]:.6g} at t = {x[i]:.4g}" for i in chosen]
        canvas.line(axes, (x, y), label, style, chosen, texts, {"linewidth": 0.9})
        numbers[label] = [float(y.min()), float(y.max())]
    return numbers


def _window(
    figure: TimeSeries, times: numpy.ndarray, row: numpy.ndarray
) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Return the times within the time interval of the figure, and the values in ``row`` at these times."""
    first, last = figure.window or (-numpy.inf, numpy.inf)
    shown = (times >= first) & (times <= last)
    return times[shown], row[shown]


def _ranges(numbers: Mapping[str, Mapping[str, Sequence[float]]]) -> str:
    parts = (
        f"{name}, {label}: between {low:.6g} and {high:.6g}"
        for name, series in numbers.items()
        for label, (low, high) in series.items()
    )
    return "; ".join(parts) + "."
