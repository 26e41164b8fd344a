"""Draws curves on a torus, with level lines and the arrows of a vector field. The axes show two angles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy

from codegen.lab.page.axes import label_axes
from codegen.lab.page.svg import INK, MUTED, RULE
from codegen.lab.pictures.canvas import Canvas, failures, styles
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source, formulas
from codegen.scene.figure import TorusCurves

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ARROWS, LEVELS = 15, 10
"""The number of arrows along each axis, and the approximate number of contour levels."""

GRID = 61
"""The number of points along each axis at which the formula of the level lines is evaluated."""

TICKS = {-math.pi: "−π", -math.pi / 2: "−π/2", 0.0: "0", math.pi / 2: "π/2", math.pi: "π"}


def draw(figure: TorusCurves, source: Source) -> Drawn:
    """Return the picture of a figure. Each curve begins at a small dot and ends at a large dot."""
    looks = styles(figure)
    canvas = Canvas.of(1, height=4.7)
    axes = canvas.panels[0]
    _background(axes, figure, source)
    numbers: dict[str, list[float]] = {}
    for run in figure.runs:
        x, y = source.values(run, figure.angles)
        # A NaN interrupts the line where an angle jumps by more than pi.
        jumps = (numpy.abs(numpy.diff(x)) > math.pi) | (numpy.abs(numpy.diff(y)) > math.pi)
        places = numpy.flatnonzero(jumps) + 1
        curve = numpy.insert(x, places, math.nan), numpy.insert(y, places, math.nan)
        canvas.line(axes, curve, run.name, looks[run.name], looks={"linewidth": 1.6})
        axes.plot(x[0], y[0], marker="o", markersize=3.5, color=INK, zorder=4)
        axes.plot(x[-1], y[-1], marker="o", markersize=7, color=INK, zorder=4)
        numbers[run.name] = [float(x[-1]), float(y[-1])]
    label_axes(axes, *figure.axes)
    axes.set_aspect("equal")
    axes.set_xlim(-math.pi, math.pi)
    axes.set_ylim(-math.pi, math.pi)
    axes.set_xticks(list(TICKS), list(TICKS.values()))
    axes.set_yticks(list(TICKS), list(TICKS.values()))
    note = failures(figure.runs, [source.path(run).failure for run in figure.runs])
    ends = "; ".join(f"{name} ends at ({a:.4g}, {b:.4g})" for name, (a, b) in numbers.items())
    return Drawn(canvas.finish(figure, source.problem, f"{ends}."), note, numbers)


def _background(axes: Axes, figure: TorusCurves, source: Source) -> None:
    """Draw the level lines of ``figure.levels`` and the arrows of ``figure.directions``, if present."""
    if figure.levels is not None:
        angles, states = _states(figure, numpy.linspace(-math.pi, math.pi, GRID))
        heights = formulas(source.problem, [figure.levels])(states, numpy.zeros(states.shape[1]))[0]
        x, y, z = (row.reshape(GRID, GRID) for row in (*angles, heights))
        axes.contour(x, y, z, LEVELS, colors=[RULE], linewidths=0.7)
    if figure.directions:
        middle = numpy.linspace(-math.pi, math.pi, 2 * ARROWS + 1)[1::2]
        (x, y), states = _states(figure, middle)
        u, v = formulas(source.problem, figure.directions)(states, numpy.zeros(states.shape[1]))
        # Short vectors stay visible: an arrow length is proportional to the square root of a vector length.
        size = numpy.sqrt(numpy.hypot(u, v))
        scale = numpy.where(size > 0, size, 1.0)
        axes.quiver(x, y, u / scale, v / scale, color=MUTED, width=0.0028, zorder=2)


def _states(figure: TorusCurves, values: numpy.ndarray) -> tuple[list[numpy.ndarray], numpy.ndarray]:
    """Return the points of a grid in the plane of the two angles, and the states at these points.

    The points are two arrays, one for each angle, and the states are the columns of a third array.
    """
    import sympy

    angles = [a.ravel() for a in numpy.meshgrid(values, values)]
    state = sympy.lambdify(figure.variables, list(figure.state), "numpy")(*angles)
    return angles, numpy.array([numpy.broadcast_to(row, angles[0].shape) for row in state])
