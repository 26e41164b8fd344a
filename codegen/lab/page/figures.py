"""Figures as inline SVG with the colours and fonts of the page, in light and dark mode.

Matplotlib draws with placeholder colours, which are then replaced by CSS variables of the page. Text is
written as SVG text, not as outlines. The identifiers in the SVG are hashes that depend on the data and on the
name of the figure. Therefore equal data gives equal bytes, and two figures of a page have different
identifiers.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

INK, MUTED, RULE = "#010a01", "#010a02", "#010a03"
SERIES = tuple(f"#010b{k:02x}" for k in range(1, 11))
COLOURS = {INK: "var(--ink)", MUTED: "var(--muted)", RULE: "var(--rule)"} | {
    colour: f"var(--series-{k})" for k, colour in enumerate(SERIES, start=1)
}
"""The CSS variable of the page for each placeholder colour."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "h")

LIGHT = {
    "var(--ink)": "#1d1c1a",
    "var(--muted)": "#6b675f",
    "var(--rule)": "#dedad1",
    "var(--sans)": "Helvetica, Arial, 'Liberation Sans', sans-serif",
} | {
    f"var(--series-{k})": colour
    for k, colour in enumerate(
        (
            "#1f6fb2",
            "#c2501f",
            "#2a8a5c",
            "#8349a6",
            "#9c7a00",
            "#54606b",
            "#b3264a",
            "#0f8f94",
            "#5a4fcf",
            "#7a4a2a",
        ),
        start=1,
    )
}
"""The colour for each CSS variable, for pictures with a white background that are not part of a page."""
SIZE = (4.7, 3.9)
"""Width and height in inches. On a phone the picture is shown at about this size, so its text is readable."""

LINE = 0.175
"""Height of a line of labels in inches. The figure becomes higher by LINE for each line after the third."""


@dataclass(frozen=True)
class Curve:
    """A labelled sequence of points (x, y), and the order for a reference line (None: no line).

    The curve of a ``peer`` is dashed and thin. ``place`` is the number of the colour and marker, so that a
    method can have the same colour and marker in all pictures. By default it is the position of the curve.
    """

    label: str
    points: tuple[tuple[float, float], ...]
    order: int | None = None
    peer: bool = False
    place: int | None = None


def convergence_figure(name: str, curves: Sequence[Curve], error_label: str) -> str:
    """Return error against step size, log-log, with a dashed line for each stated order."""
    figure, axes = _canvas()
    for order in sorted({c.order for c in curves if c.order is not None}):
        _reference_line(axes, order, next(c for c in curves if c.order == order))
    _draw(axes, curves)
    axes.set_xlabel("step size h")
    axes.set_ylabel(error_label)
    _ticks(axes.xaxis, lambda x: f"{x:g}")
    _legend(figure)
    return _svg(figure, name)


def efficiency_figure(name: str, curves: Sequence[Curve], error_label: str) -> str:
    """Return error against CPU time of the whole run, log-log."""
    figure, axes = _canvas()
    _draw(axes, curves)
    axes.set_xlabel("CPU time of the run")
    axes.set_ylabel(error_label)
    _ticks(axes.xaxis, seconds)
    _legend(figure)
    return _svg(figure, name)


def growth_figure(name: str, curves: Sequence[Curve], label: str) -> str:
    """Return the largest deviation up to each time, log-log, with dotted lines for t^1/2 and t."""
    figure, axes = _canvas()
    _draw(axes, curves, marked=False)
    left, right = axes.get_xlim()
    low, high = axes.get_ylim()
    for exponent, text in ((0.5, "√t"), (1.0, "t")):
        ends = (left * 1.3, right / 1.3)
        values = [low * 3 * (x / ends[0]) ** exponent for x in ends]
        axes.plot(ends, values, color=MUTED, linewidth=0.8, linestyle=(0, (1, 2)), zorder=1)
        axes.annotate(
            text, (ends[1], values[1]), xytext=(2, 0), textcoords="offset points", color=MUTED, fontsize=8
        )
    axes.set_ylim(low, high)
    axes.set_xlabel("time")
    axes.set_ylabel(label)
    _ticks(axes.xaxis, power_of_ten)
    _legend(figure)
    return _svg(figure, name)


PLANE = (-8.0, 4.0, -6.0, 6.0)
"""Bounds of a picture of linear stability: interval of real parts, then interval of imaginary parts."""

GRID = 121
"""Number of grid points in each direction."""


def region_figure(name: str, functions: Sequence[tuple[str, int, Callable[[complex], complex]]]) -> str:
    """Return the boundaries |R(z)| = 1; ``functions`` are triples of label, place and stability function R.

    Every boundary contains zero. Near zero, the stable region is to the left of the boundary.
    """
    left, right, low, high = PLANE
    xs, ys = ([a + (b - a) * k / (GRID - 1) for k in range(GRID)] for a, b in ((left, right), (low, high)))
    figure, axes = _canvas(log=False)
    axes.axhline(0.0, color=MUTED, linewidth=0.6)
    axes.axvline(0.0, color=MUTED, linewidth=0.6)
    for label, place, value in functions:
        sizes = [[min(abs(value(complex(x, y))), 1e3) for x in xs] for y in ys]
        colour = SERIES[place % len(SERIES)]
        axes.contour(xs, ys, sizes, levels=[1.0], colors=[colour], linewidths=1.3)
        axes.plot([], [], color=colour, label=label)
    axes.set_aspect("equal")
    axes.set_xlabel("real part of hλ")
    axes.set_ylabel("imaginary part of hλ")
    _legend(figure)
    return _svg(figure, name)


STYLE: dict[str, object] = {
    "svg.fonttype": "none",
    "font.size": 9,
    "legend.fontsize": 8.5,
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.size": 0,
    "ytick.minor.size": 0,
    "lines.linewidth": 1.3,
    "lines.markersize": 4.5,
}


def _canvas(*, log: bool = True) -> tuple[Figure, Axes]:
    import matplotlib
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=SIZE, layout="constrained")
        FigureCanvasSVG(figure)
        axes = figure.add_subplot()
    if log:
        axes.set_xscale("log")
        axes.set_yscale("log")
    axes.grid(color=RULE, linewidth=0.5)
    axes.set_axisbelow(True)
    return figure, axes


def _legend(figure: Figure) -> None:
    """Put the labels above the axes, where they do not overlap curves."""
    labels = sum(len(axes.get_legend_handles_labels()[1]) for axes in figure.axes)
    if not labels:
        return
    width, height = SIZE
    figure.set_size_inches(width, height + LINE * max(0, (labels + 1) // 2 - 3))
    figure.legend(
        loc="outside upper left",
        ncols=2,
        frameon=False,
        labelcolor=INK,
        handlelength=1.6,
        columnspacing=1.4,
        borderaxespad=0.2,
    )


def _draw(axes: Axes, curves: Sequence[Curve], *, marked: bool = True) -> None:
    for number, curve in enumerate(curves):
        k = number if curve.place is None else curve.place
        colour = SERIES[k % len(SERIES)]
        x, y = zip(*curve.points, strict=True)
        marker = MARKERS[(k + 3 * (k // len(SERIES))) % len(MARKERS)] if marked else ""
        (line,) = axes.plot(x, y, color=colour, marker=marker, label=curve.label, clip_on=False)
        if curve.peer:
            line.set(linestyle=(0, (3, 2)), linewidth=0.9, markerfacecolor="none")
    _ticks(axes.yaxis, power_of_ten)


def _reference_line(axes: Axes, order: int, curve: Curve) -> None:
    """Draw the line C h^order over the curve's range of h, slightly below the point with the smallest h."""
    x = sorted(p[0] for p in curve.points)
    finest = min(curve.points)
    y = [0.45 * finest[1] * (h / finest[0]) ** order for h in (x[0], x[-1])]
    axes.plot([x[0], x[-1]], y, color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.annotate(
        f"h{superscript(order)}" if order > 1 else "h",
        (x[0], y[0]),
        xytext=(-2, -7),
        textcoords="offset points",
        ha="right",
        color=MUTED,
        fontsize=8,
    )


def _ticks(axis: Axis, text: Callable[[float], str]) -> None:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(base=10, numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda x, _: text(x)))
    axis.set_minor_formatter(NullFormatter())


def superscript(n: int) -> str:
    """Return an integer in superscript digits.

    >>> superscript(-12)
    '⁻¹²'
    """
    return str(n).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def power_of_ten(x: float) -> str:
    """Return a power of ten in mathematical notation.

    >>> power_of_ten(1e-08), power_of_ten(1.0)
    ('10⁻⁸', '1')
    """
    exponent = round(math.log10(x))
    return "1" if exponent == 0 else f"10{superscript(exponent)}"


def seconds(x: float) -> str:
    """Return a time with a unit.

    >>> seconds(1e-5), seconds(0.1), seconds(1e-9)
    ('10 µs', '100 ms', '1 ns')
    """
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if x >= 0.999 * size:
            return f"{x / size:g} {unit}"
    return f"{x / 1e-9:.3g} ns"


def standalone(svg: str, title: str) -> str:
    """Return an SVG element of this module as a complete document with fixed colours on white and a title."""
    for variable, value in LIGHT.items():
        svg = svg.replace(variable, value)
    head = svg.index(">") + 1
    size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)
    width, height = size.groups() if size else ("100%", "100%")
    paper = f'<title>{title}</title><rect width="{width}" height="{height}" fill="#ffffff"/>'
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{svg[:head]}{paper}{svg[head:]}\n'


def _svg(figure: Figure, name: str) -> str:
    """Return the figure as an SVG element, without size and date, and with the colours of the page."""
    import matplotlib

    stream = io.StringIO()
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": name}):
        figure.savefig(stream, format="svg", transparent=True, metadata={"Date": None})
    text = stream.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\s+(width|height)="[\d.]+pt"', "", text, count=2)
    # A style element in the figure would apply to the whole page.
    text = re.sub(r"<style.*?</style>", "", text, flags=re.DOTALL)
    text = re.sub(r'\s+id="[^"]*_\d+"', "", text)
    text = re.sub(r"""'DejaVu Sans'(?:, [^;"]*)?""", "var(--sans)", text)
    for colour, variable in COLOURS.items():
        text = text.replace(colour, variable)
    return text.strip()
