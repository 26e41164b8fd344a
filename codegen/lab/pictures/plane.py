"""Draws the curves of runs in a plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy

from codegen.lab.page.axes import SIZE, label_axes
from codegen.lab.page.svg import INK, MUTED
from codegen.lab.pictures.canvas import (
    REFERENCE,
    REFERENCE_LOOKS,
    REFERENCE_STYLE,
    Canvas,
    failures,
    marks,
    styles,
)
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.scene.figure import PlaneCurves, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARGIN = 0.06
"""The width of the margin around the curves, divided by the larger side of their bounding box."""


def draw(figure: PlaneCurves, source: Source) -> Drawn:
    """Return the picture of a figure. A dot in each panel marks the initial point of the first run."""
    runs = figure.runs
    canvas = Canvas.of(len(runs) if figure.panels else 1, height=SIZE[1] if len(runs) != 3 else 2.9)
    curves = {run.name: source.values(run, figure.point) for run in runs}
    exact = [] if figure.reference is None else [source.values(figure.reference, figure.point)]
    for k, run in enumerate(runs):
        axes = canvas.panels[k if figure.panels else 0]
        if figure.panels:
            canvas.title(axes, run.name)
            _frame(axes, figure, [curves[run.name], *exact])
        _draw_run(canvas, axes, figure, run, source.path(run).times, curves[run.name])
    if not figure.panels:
        _frame(canvas.panels[0], figure, [*curves.values(), *exact])
    x, y = source.start(runs[0], figure.point)
    for axes in canvas.panels:
        for points in exact:
            canvas.line(axes, (points[0], points[1]), REFERENCE, REFERENCE_STYLE, looks=REFERENCE_LOOKS)
        axes.plot([x], [y], marker="o", color=INK, zorder=4)
    numbers = {name: [float(x[-1]), float(y[-1])] for name, (x, y) in curves.items()}
    ends = "; ".join(f"{name} ends at ({x:.4g}, {y:.4g})" for name, (x, y) in numbers.items())
    note = failures(runs, [source.path(run).failure for run in runs])
    return Drawn(canvas.finish(figure, source.problem, f"{ends}."), note, numbers)


def _draw_run(
    canvas: Canvas, axes: Axes, figure: PlaneCurves, run: Run, times: numpy.ndarray, points: numpy.ndarray
) -> None:
    """Draw the curve of a run, as dots if ``figure.dots`` is True.

    ``points`` contains the x and the y coordinates of the curve. ``times`` contains the time or the parameter
    value of each point.
    """
    x, y = points
    style = styles(figure)[run.name]
    if figure.dots:
        canvas.dots(axes, (x, y), run.name, style)
        return
    shift = figure.runs.index(run) / len(figure.runs)
    chosen = [] if figure.panels else list(range(len(x))) if figure.marked else marks(len(x), shift)
    name = "t" if run.sweep is None else run.sweep.name
    texts = [f"{run.name}: {name} = {times[i]:.3g}, ({x[i]:.3g}, {y[i]:.3g})" for i in chosen]
    canvas.line(axes, (x, y), run.name, style, chosen, texts)


def _frame(axes: Axes, figure: PlaneCurves, curves: list[numpy.ndarray]) -> None:
    """Set the bounds and the labels of a panel, and draw the lines x = 0 and y = 0."""
    axes.axhline(0.0, color=MUTED, linewidth=0.6, zorder=1)
    axes.axvline(0.0, color=MUTED, linewidth=0.6, zorder=1)
    label_axes(axes, *figure.axes)
    axes.set_aspect("equal")
    left, right, low, high = figure.bounds or _bounds(curves, figure.panels)
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)


def _bounds(curves: list[numpy.ndarray], square: bool) -> tuple[float, float, float, float]:
    """Return the bounds (left, right, bottom, top) of the curves, enlarged by a margin."""
    points = numpy.concatenate(curves, axis=1)
    points = points[:, numpy.isfinite(points).all(axis=0)]
    low, high = points.min(axis=1), points.max(axis=1)
    middle, half = (low + high) / 2, (high - low) / 2
    margin = MARGIN * 2 * half.max() or 1.0
    if square:
        half = numpy.array([half.max(), half.max()])
    low, high = middle - half - margin, middle + half + margin
    return float(low[0]), float(high[0]), float(low[1]), float(high[1])
