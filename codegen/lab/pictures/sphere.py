"""Draws curves on a sphere in orthogonal projection. On the far half of the sphere, the curves are
fainter.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy

from codegen.lab.page.series_style import Style
from codegen.lab.page.svg import INK, MUTED, PLACEHOLDERS, RULE
from codegen.lab.pictures.canvas import (
    REFERENCE,
    REFERENCE_LOOKS,
    REFERENCE_STYLE,
    WIDE,
    Canvas,
    Looks,
    failures,
    styles,
)
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.scene.figure import SphereCurves

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HIDDEN = 0.3
"""The opacity of the curves on the half of the sphere that faces away from the viewer."""


THIN: Looks = {"linewidth": 0.9, "marker": ""}


def draw(figure: SphereCurves, source: Source) -> Drawn:
    """Return the picture of a figure. A black dot marks the start of each curve."""
    runs, looks = figure.runs, styles(figure)
    canvas = Canvas.of(len(runs) if figure.panels else 1, height=WIDE / 2)
    frame = projection(*figure.direction)
    reference = figure.reference
    curves = [source.values(run, figure.point) for run in runs]
    radius = float(numpy.linalg.norm(source.start(runs[0], figure.point)))
    spread: dict[str, object] = {}
    for axes in canvas.panels:
        _sphere(axes, radius, frame, figure.axes)
    for k, (run, points) in enumerate(zip(runs, curves, strict=True)):
        axes = canvas.panels[k if figure.panels else 0]
        if figure.panels:
            canvas.title(axes, run.name)
        _curve(canvas, axes, frame @ points, run.name, looks[run.name], THIN, figure.dots)
        if reference is not None:
            exact = frame @ source.values(reference, figure.point)
            _curve(canvas, axes, exact, REFERENCE, REFERENCE_STYLE, REFERENCE_LOOKS)
        start = frame @ source.start(run, figure.point)
        axes.plot(*start[:2], marker="o", color=INK, markersize=4, zorder=5)
        norms = numpy.linalg.norm(points, axis=0)
        spread[run.name] = float(numpy.abs(norms / radius - 1.0).max())
    note = failures(runs, [source.path(run).failure for run in runs])
    far = "; ".join(
        f"{name}: relative distance from the sphere at most {x:.1e}" for name, x in spread.items()
    )
    return Drawn(canvas.finish(figure, source.problem, f"{far}."), note, spread)


def projection(azimuth: float, elevation: float) -> numpy.ndarray:
    """Return the rotation matrix that maps a point in space to its coordinates in the picture.

    In the picture, the first coordinate increases to the right, the second upwards, and the third towards the
    viewer. ``azimuth`` and ``elevation`` give the direction from the origin to the viewer, in degrees.

    >>> projection(0.0, 0.0).round(12).tolist()
    [[-0.0, 1.0, 0.0], [-0.0, -0.0, 1.0], [1.0, 0.0, 0.0]]
    """
    a, e = math.radians(azimuth), math.radians(elevation)
    return numpy.array(
        [
            [-math.sin(a), math.cos(a), 0.0],
            [-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e)],
            [math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)],
        ]
    )


def _curve(
    canvas: Canvas,
    axes: Axes,
    seen: numpy.ndarray,
    label: str,
    style: Style,
    looks: Looks,
    dots: bool = False,
) -> None:
    """Draw a curve on the sphere, fainter on the far half of the sphere.

    Each column of ``seen`` is a point of the curve, in the coordinates that :func:`projection` defines.
    """
    for hidden in (False, True):
        x = numpy.where((seen[2] < 0) == hidden, seen[0], math.nan)
        if dots:
            canvas.dots(axes, (x, seen[1]), label, style, HIDDEN if hidden else 1.0)
        elif numpy.isfinite(x).any():
            shown: Looks = {**looks, "alpha": HIDDEN} if hidden else looks
            canvas.line(axes, (x, seen[1]), label, style, looks=shown)


def _sphere(axes: Axes, radius: float, frame: numpy.ndarray, names: tuple[str, str, str]) -> None:
    """Draw the outline of the sphere, three great circles, and the outer ends of the coordinate axes.

    ``frame`` is the matrix of the projection.
    """
    angle = numpy.linspace(0.0, 2 * math.pi, 181)
    circle = radius * numpy.array([numpy.cos(angle), numpy.sin(angle), 0 * angle])
    axes.grid(False)
    axes.set_axis_off()
    axes.plot(circle[0], circle[1], color=MUTED, linewidth=0.8, zorder=1)
    for k, name in enumerate(names):
        ring = frame @ numpy.roll(circle, k, axis=0)
        for hidden in (False, True):
            x = numpy.where((ring[2] < 0) == hidden, ring[0], math.nan)
            axes.plot(x, ring[1], color=RULE, linewidth=0.6, linestyle=":" if hidden else "-", zorder=1)
        end = frame @ (radius * numpy.eye(3)[k])
        axes.plot([end[0], 1.12 * end[0]], [end[1], 1.12 * end[1]], color=MUTED, linewidth=0.6, zorder=1)
        at = (1.2 * end[0], 1.2 * end[1])
        # A box in the colour of the page hides the lines behind each label.
        behind = {"facecolor": PLACEHOLDERS["var(--paper)"], "edgecolor": "none", "pad": 0.8}
        axes.annotate(name, at, color=MUTED, fontsize=8, ha="center", va="center", bbox=behind, zorder=4)
    axes.set_aspect("equal")
    axes.set_xlim(-1.22 * radius, 1.22 * radius)
    axes.set_ylim(-1.22 * radius, 1.22 * radius)
