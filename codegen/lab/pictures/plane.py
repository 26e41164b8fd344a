"""Draws curves in a plane."""

from __future__ import annotations

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
from codegen.scene.figure import PlaneCurves

MARGIN = 0.06
"""Distance of the curves from the frame, as a part of the width."""


def draw(figure: PlaneCurves, source: Source) -> Drawn:
    """Return the picture. The start of the curves is marked by a black dot."""
    runs, looks = figure.runs, styles(figure)
    canvas = Canvas.of(len(runs) if figure.panels else 1, height=SIZE[1] if len(runs) != 3 else 2.9)
    curves = [source.values(run, figure.point) for run in runs]
    exact = None if figure.reference is None else source.values(figure.reference, figure.point)
    for k, (run, (x, y)) in enumerate(zip(runs, curves, strict=True)):
        axes = canvas.panels[k if figure.panels else 0]
        chosen = list(range(len(x))) if figure.marked else marks(len(x), k / len(runs))
        if figure.panels:
            canvas.title(axes, run.name)
            chosen = []
        times = source.path(run).times
        name = "t" if run.sweep is None else run.sweep.name
        texts = [f"{run.name}: {name} = {times[i]:.3g}, ({x[i]:.3g}, {y[i]:.3g})" for i in chosen]
        canvas.line(axes, (x, y), run.name, looks[run.name], chosen, texts)
    for axes in canvas.panels:
        if exact is not None:
            canvas.line(axes, (exact[0], exact[1]), REFERENCE, REFERENCE_STYLE, looks=REFERENCE_LOOKS)
        x, y = source.start(runs[0], figure.point)
        axes.plot([x], [y], marker="o", color=INK, zorder=4)
        axes.axhline(0.0, color=MUTED, linewidth=0.6, zorder=1)
        axes.axvline(0.0, color=MUTED, linewidth=0.6, zorder=1)
        label_axes(axes, *figure.axes)
        axes.set_aspect("equal")
        left, right, low, high = figure.bounds or _bounds([*curves, *([] if exact is None else [exact])])
        axes.set_xlim(left, right)
        axes.set_ylim(low, high)
    ends = "; ".join(
        f"{run.name} ends at ({x[-1]:.4g}, {y[-1]:.4g})" for run, (x, y) in zip(runs, curves, strict=True)
    )
    note = failures(runs, [source.path(run).failure for run in runs])
    svg = canvas.finish(figure, source.problem, f"{ends}.")
    return Drawn(
        svg, note, {run.name: [float(x[-1]), float(y[-1])] for run, (x, y) in zip(runs, curves, strict=True)}
    )


def _bounds(curves: list[numpy.ndarray]) -> tuple[float, float, float, float]:
    points = numpy.concatenate(curves, axis=1)
    points = points[:, numpy.isfinite(points).all(axis=0)]
    low, high = points.min(axis=1), points.max(axis=1)
    gap = MARGIN * (high - low).max() or 1.0
    return float(low[0] - gap), float(high[0] + gap), float(low[1] - gap), float(high[1] + gap)
