"""Draws orthogonal projections of space curves, and the edges of the box around all curves."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy

from codegen.lab.page.svg import INK, MUTED, RULE
from codegen.lab.pictures.canvas import Canvas, Looks, failures, styles
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.lab.pictures.sphere import projection
from codegen.scene.figure import SpaceCurves

if TYPE_CHECKING:
    from matplotlib.axes import Axes

THIN: Looks = {"linewidth": 0.8, "marker": ""}


def draw(figure: SpaceCurves, source: Source) -> Drawn:
    """Return the picture of a figure. A black dot marks the start of the first curve."""
    looks, runs = styles(figure), figure.runs
    canvas = Canvas.of(1, height=4.4)
    axes, frame = canvas.panels[0], projection(*figure.direction)
    curves = [source.values(run, figure.point) for run in runs]
    points = numpy.concatenate(curves, axis=1)
    points = points[:, numpy.isfinite(points).all(axis=0)]
    low, high = points.min(axis=1), points.max(axis=1)
    _box(axes, frame, low, high, figure.axes)
    for run, curve in zip(runs, curves, strict=True):
        x, y, _ = frame @ curve
        canvas.line(axes, (x, y), run.name, looks[run.name], looks=THIN)
    x, y, _ = frame @ source.start(runs[0], figure.point)
    axes.plot([x], [y], marker="o", markersize=4, color=INK, zorder=5)
    numbers = {
        run.name: [[float(row.min()), float(row.max())] for row in curve]
        for run, curve in zip(runs, curves, strict=True)
    }
    ranges = ", ".join(
        f"{name} from {a:.4g} to {b:.4g}" for name, a, b in zip(figure.axes, low, high, strict=True)
    )
    note = failures(runs, [source.path(run).failure for run in runs])
    return Drawn(canvas.finish(figure, source.problem, f"Curves with {ranges}."), note, numbers)


def _box(
    axes: Axes, frame: numpy.ndarray, low: numpy.ndarray, high: numpy.ndarray, names: tuple[str, str, str]
) -> None:
    """Draw the edges of a box, and write the range of each coordinate k beside an edge parallel to axis k.

    ``low`` and ``high`` are opposite corners of the box, and ``frame`` is the matrix of the projection.
    """
    axes.grid(False)
    axes.set_axis_off()
    axes.set_aspect("equal")
    corners = numpy.array([low, high])
    for k, name in enumerate(names):
        edges = []
        for others in product((0, 1), repeat=2):
            choice = numpy.insert(numpy.array(others), k, 0)
            ends = numpy.array([corners[choice, range(3)]] * 2)
            ends[:, k] = corners[:, k]
            edges.append(frame @ ends.T)
            axes.plot(edges[-1][0], edges[-1][1], color=RULE, linewidth=0.7, zorder=1)
        # Four edges are parallel to axis k. If they are steep, label the leftmost edge, otherwise the lowest.
        upright = abs(edges[0][1, 1] - edges[0][1, 0]) > abs(edges[0][0, 1] - edges[0][0, 0])
        chosen = min(edges, key=lambda edge: edge[0].mean() if upright else edge[1].mean())
        at, shift = (chosen[0].mean(), chosen[1].mean()), (-6, 0) if upright else (0, -12)
        axes.annotate(
            f"{name}: {low[k]:.3g} … {high[k]:.3g}".replace("-", "−"),
            at,
            xytext=shift,
            textcoords="offset points",
            ha="center",
            va="center",
            rotation=90 if upright else 0,
            color=MUTED,
            fontsize=8,
        )
