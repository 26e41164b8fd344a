"""The figures of the report.

The figures show error against step size, error against CPU time, deviations over time, and stability regions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

from markupsafe import Markup

from codegen.lab.page.axes import annotate, appearance, label_axes, legend, log_ticks, new_figure
from codegen.lab.page.formatting import power_of_ten, scientific, seconds, superscript
from codegen.lab.page.series_style import Style
from codegen.lab.page.svg import MUTED, Point, Text, svg_element

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARKS = 9
"""The largest number of markers on a curve over time, or on a boundary line of a stability region."""

Function: TypeAlias = tuple[str, Style, Callable[[complex], complex]]


@dataclass(frozen=True)
class Curve:
    """A labelled sequence of points (x, y) with its style.

    ``order`` is the slope of the reference line, or None. ``upper`` is empty, or it contains a number u for
    each point (x, y). For each number u, a horizontal bar is drawn from (x, y) to (u, y).
    """

    label: str
    points: tuple[Point, ...]
    style: Style
    order: int | None = None
    upper: tuple[float, ...] = ()


@dataclass
class _Drawing:
    """A figure to which curves are added.

    ``values`` maps the number of a curve (from 0) to the tooltips of its markers.
    """

    figure: Figure
    axes: Axes
    values: dict[int, list[str]] = field(default_factory=dict)

    def draw(self, curve: Curve, value: Callable[[float, float], str], marks: Sequence[int]) -> None:
        """Draw a curve with markers at the points with the indices ``marks``.

        The tooltip of the marker at (x, y) contains the label of the curve and the text ``value(x, y)``.
        """
        number, style = len(self.values), curve.style
        x, y = zip(*curve.points, strict=True)
        (line,) = self.axes.plot(
            x, y, label=curve.label, clip_on=False, markevery=list(marks), **appearance(style)
        )
        line.set_gid(f"series:{number}")
        self.values[number] = [f"{curve.label}: {value(*curve.points[k])}" for k in marks]
        if curve.upper:
            # All horizontal bars are drawn as one line, which is interrupted where a coordinate is NaN.
            ends = [z for (a, _), b in zip(curve.points, curve.upper, strict=True) for z in (a, b, math.nan)]
            heights = [z for _, e in curve.points for z in (e, e, math.nan)]
            (bars,) = self.axes.plot(ends, heights, color=line.get_color(), linewidth=2.6, alpha=0.35)
            bars.set(gid=f"series:{number}", solid_capstyle="butt", zorder=1.5)

    def finish(self, name: str, title: str, description: str) -> Markup:
        """Add the legend and return the figure as an SVG element."""
        legend(self.figure, [self.axes])
        return svg_element(self.figure, Text(name, title, description, self.values))


def convergence_figure(name: str, title: str, curves: Sequence[Curve], error_label: str) -> Markup:
    """Return a log-log diagram of error against step size.

    Curves with the same ``order`` share one dashed reference line with this slope.
    """
    drawing = _drawing()
    for order in sorted({c.order for c in curves if c.order is not None}):
        _reference_line(drawing.axes, order, next(c for c in curves if c.order == order))
    for curve in curves:
        drawing.draw(curve, lambda h, e: f"h = {scientific(h, 3)}, error {scientific(e)}", _all(curve))
    label_axes(drawing.axes, "step size h", error_label)
    log_ticks(drawing.axes.xaxis, lambda x: f"{x:g}")
    return drawing.finish(name, title, _description("step size", "error", curves))


SLOPES = (2, 4, 8)
"""The orders p for which a work-precision diagram shows a reference line of slope -p."""


def efficiency_figure(name: str, title: str, curves: Sequence[Curve], error_label: str) -> Markup:
    """Return a log-log diagram of error against CPU time.

    With equal steps, the error of a method of order p is proportional to T^(-p), where T is the CPU time. The
    diagram contains a reference line of slope -p for each p of :data:`SLOPES`.
    """
    drawing = _drawing()
    for curve in curves:
        upper = dict(zip(curve.points, curve.upper, strict=False))

        def value(t: float, e: float, upper: dict[Point, float] = upper) -> str:
            interval = f" to {seconds(upper[t, e])}" if upper.get((t, e), t) > 1.005 * t else ""
            return f"{seconds(t)}{interval}, error {scientific(e)}"

        drawing.draw(curve, value, _all(curve))
    _slopes(drawing.axes, [p for c in curves for p in c.points])
    label_axes(drawing.axes, "CPU time of the run", error_label)
    log_ticks(drawing.axes.xaxis, seconds)
    return drawing.finish(name, title, _description("CPU time in seconds", "error", curves))


def growth_figure(name: str, title: str, curves: Sequence[Curve], label: str) -> Markup:
    """Return a log-log diagram that shows the growth of a deviation with time.

    The value of a curve at the time t is the largest deviation from time 0 to t. Dotted lines show growth
    proportional to t^(1/2) and to t.
    """
    drawing = _drawing()
    axes = drawing.axes
    for number, curve in enumerate(curves):
        marks = spread([math.log(t) for t, _ in curve.points], MARKS, number / max(1, len(curves)))
        drawing.draw(curve, lambda t, e: f"up to t = {scientific(t, 3)}, {scientific(e)}", marks)
    left, right = axes.get_xlim()
    low, high = axes.get_ylim()
    for exponent, text in ((0.5, "√t"), (1.0, "t")):
        ends = (left * 1.3, right / 1.3)
        values = [low * 3 * (x / ends[0]) ** exponent for x in ends]
        axes.plot(ends, values, color=MUTED, linewidth=0.8, linestyle=(0, (1, 2)), zorder=1)
        annotate(axes, text, (ends[1], values[1]), (2, 0), "left")
    axes.set_ylim(low, high)
    label_axes(axes, "time", label)
    log_ticks(axes.xaxis, power_of_ten)
    return drawing.finish(name, title, _description("time", "deviation", curves))


PLANE = (-8.0, 4.0, -6.0, 6.0)
"""The largest part of the complex plane that a diagram of stability regions shows.

The first two numbers bound the real part, and the last two numbers bound the imaginary part.
"""

GRID = 120
"""The number of grid points along each axis of a diagram of stability regions.

With this number, no grid point is on the imaginary axis. On this axis, rounding errors can decide whether a
point belongs to a stability region.
"""

MARGIN = 0.7
"""The width of the margin around the stability regions, in the coordinates of the complex plane."""

SHADE = 0.09
"""Opacity of the colour that fills a stability region."""


def region_figure(name: str, title: str, functions: Sequence[Function]) -> Markup:
    """Return a diagram in which the stability region of each method is shaded.

    ``functions`` contains a triple for each method: its label, its style and its stability function R. The
    stability region contains the points z of the complex plane with |R(z)| <= 1.
    """
    drawing, plane = _drawing(log=False), _Plane.containing([f for _, _, f in functions])
    axes = drawing.axes
    axes.axhline(0.0, color=MUTED, linewidth=0.6)
    axes.axvline(0.0, color=MUTED, linewidth=0.6)
    for number, (label, style, value) in enumerate(functions):
        looks, grid = appearance(style), (plane.xs, plane.ys, plane.sizes(value))
        fill = axes.contourf(*grid, levels=[-1.0, 1.0], colors=[looks["color"]], alpha=SHADE)
        line = axes.contour(*grid, levels=[1.0], colors=[looks["color"]], linewidths=1.3)
        points = _boundary(line.allsegs[0], number / len(functions))
        x, y = zip(*points, strict=True) if points else ((), ())
        (marks,) = axes.plot(x, y, **looks)
        marks.set_linestyle("none")
        for artist in (fill, line, marks):
            artist.set_gid(f"series:{number}")
        axes.plot([], [], label=label, **looks)
        drawing.values[number] = [
            f"{label}: |R| = 1 at {a:.2f} {b:+.2f}i".replace("-", "−") for a, b in points
        ]
    axes.set_xlim(plane.xs[0], plane.xs[-1])
    axes.set_ylim(plane.ys[0], plane.ys[-1])
    axes.set_aspect("equal")
    label_axes(axes, "real part of hλ", "imaginary part of hλ")
    about = "Boundaries of the regions of linear stability of " + ", ".join(f[0] for f in functions) + "."
    return drawing.finish(name, title, about)


@dataclass(frozen=True)
class _Plane:
    """A rectangular grid of points x + iy in the complex plane, with x in ``xs`` and y in ``ys``."""

    xs: tuple[float, ...]
    ys: tuple[float, ...]

    @classmethod
    def between(cls, left: float, right: float, low: float, high: float) -> _Plane:
        """Return the grid of points x + iy with ``left`` <= x <= ``right`` and ``low`` <= y <= ``high``."""
        xs, ys = (
            tuple(a + (b - a) * k / (GRID - 1) for k in range(GRID)) for a, b in ((left, right), (low, high))
        )
        return cls(xs, ys)

    @classmethod
    def containing(cls, functions: Sequence[Callable[[complex], complex]]) -> _Plane:
        """Return a grid for a diagram of the stability regions of ``functions``.

        The grid covers the stability regions and a margin around them, but nothing outside :data:`PLANE`.
        """
        whole = cls.between(*PLANE)
        points = [
            (x, y)
            for function in functions
            for y, row in zip(whole.ys[::4], whole.sizes(function, 4), strict=True)
            for x, size in zip(whole.xs[::4], row, strict=True)
            if size <= 1.0
        ]
        left = min((x for x, _ in points), default=PLANE[0]) - MARGIN
        high = max((abs(y) for _, y in points), default=PLANE[3]) + MARGIN
        right = max((x for x, _ in points), default=PLANE[1]) + MARGIN
        if high > PLANE[3]:
            return whole
        left = max(PLANE[0], min(left, right - 2 * high))
        return cls.between(left, min(max(right, 1.0), PLANE[1]), -high, high)

    def sizes(self, function: Callable[[complex], complex], step: int = 1) -> list[list[float]]:
        """Return the absolute values of ``function`` at every ``step``-th x and y of the grid.

        Each inner list belongs to one y. Values above 1000 are replaced by 1000.
        """
        return [[min(abs(function(complex(x, y))), 1e3) for x in self.xs[::step]] for y in self.ys[::step]]


def spread(positions: Sequence[float], count: int, shift: float) -> list[int]:
    """Choose at most ``count`` positions at about equal distances, and return their indices.

    The interval from the first to the last of the increasing ``positions`` is divided into ``count`` equal
    intervals. The number ``shift`` is between 0 and 1. For each interval [a, b], the position nearest to the
    point a + shift * (b - a) is chosen.

    >>> spread([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0], 3, 0.5)
    [1, 4, 7]
    """
    if len(positions) <= count:
        return list(range(len(positions)))
    first, last = positions[0], positions[-1]
    wanted = [first + (last - first) * (k + shift) / count for k in range(count)]
    nearest = (min(range(len(positions)), key=lambda i: abs(positions[i] - x)) for x in wanted)
    return sorted(set(nearest))


def _boundary(segments: Iterable[Iterable[Sequence[float]]], shift: float) -> list[Point]:
    points: list[Point] = []
    for segment in segments:
        line = [(float(x), float(y)) for x, y in segment]
        lengths = [0.0]
        for a, b in pairwise(line):
            lengths.append(lengths[-1] + math.dist(a, b))
        points += [line[k] for k in spread(lengths, max(1, min(MARKS, round(lengths[-1] / 1.2))), shift)]
    return points


def _drawing(*, log: bool = True) -> _Drawing:
    figure, (axes,) = new_figure()
    if log:
        axes.set_xscale("log")
        axes.set_yscale("log")
    return _Drawing(figure, axes)


def _all(curve: Curve) -> list[int]:
    return list(range(len(curve.points)))


def _description(x: str, y: str, curves: Sequence[Curve]) -> str:
    """Return the first and the last point of each curve as text, for a reader who cannot see the figure."""
    ends = []
    for curve in curves:
        (a, b), (c, d) = curve.points[0], curve.points[-1]
        ends.append(
            f"{curve.label}: {y} {scientific(b)} at {x} {scientific(a)}, {scientific(d)} at {scientific(c)}"
        )
    return "; ".join(ends) + "." if ends else "No run succeeds."


def _reference_line(axes: Axes, order: int, curve: Curve) -> None:
    """Draw a line y = C h^order that is slightly below the curve at the smallest step size h."""
    x = sorted(p[0] for p in curve.points)
    finest = min(curve.points)
    y = [0.45 * finest[1] * (h / finest[0]) ** order for h in (x[0], x[-1])]
    axes.plot([x[0], x[-1]], y, color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)))
    annotate(axes, f"h{superscript(order)}" if order > 1 else "h", (x[0], y[0]), (-2, -7), "right")


def _slopes(axes: Axes, points: Sequence[Point]) -> None:
    """Draw lines of slope -p for each p of :data:`SLOPES`, in a corner that the curves seldom reach."""
    if not points:
        return
    left, right = map(math.log10, axes.get_xlim())
    low, high = map(math.log10, axes.get_ylim())
    wide, tall = 0.26 * (right - left), 0.36 * (high - low)
    boxes = ((left, low), (right - wide, high - tall))

    def inside(box: Point) -> int:
        return sum(
            0 <= math.log10(x) - box[0] <= wide and 0 <= math.log10(y) - box[1] <= tall for x, y in points
        )

    x, y = min(boxes, key=inside)
    x, y = x + 0.1 * wide, y + 0.92 * tall
    for order in SLOPES:
        run = min(0.75 * wide, 0.8 * tall / order)
        ends = [(10**x, 10**y), (10 ** (x + run), 10 ** (y - order * run))]
        axes.plot(*zip(*ends, strict=True), color=MUTED, linewidth=0.8, linestyle=(0, (1, 2)), zorder=1)
        annotate(axes, f"p = {order}" if order == SLOPES[0] else str(order), ends[1], (2, -4), "left")
    axes.set_xlim(10**left, 10**right)
    axes.set_ylim(10**low, 10**high)
