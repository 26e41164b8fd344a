"""Creates Matplotlib figures for the report, and draws labels, ticks and legends in one style."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, TypedDict

from codegen.lab.page.formatting import power_of_ten, scientific
from codegen.lab.page.series_style import Style
from codegen.lab.page.svg import INK, MUTED, PLACEHOLDERS, RULE, STYLE, Point

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

SIZE = (4.7, 3.9)
"""Width and height of a figure in inches. With this size, the text of the figure is readable on a phone."""

LINE = 0.175
"""Height of a line of the legend in inches.

If the legend has more than three lines, the figure is made higher by LINE for each additional line.
"""

LONG_LABEL = 27
"""The largest number of characters of a label in a legend with two columns, at the default figure width."""


class Appearance(TypedDict):
    """The keyword arguments of ``plot`` that describe the style of a curve."""

    color: str
    marker: str
    markerfacecolor: str
    linestyle: str | tuple[float, tuple[float, ...]]
    linewidth: float


def new_figure(
    rows: int = 1, columns: int = 1, size: tuple[float, float] = SIZE, projection: str | None = None
) -> tuple[Figure, tuple[Axes, ...]]:
    """Return a figure in the style of the report, and the tuple of its axes, listed row by row.

    ``size`` is the width and height in inches.
    """
    import matplotlib
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasSVG(figure)
        panels = tuple(
            figure.add_subplot(rows, columns, k + 1, projection=projection) for k in range(rows * columns)
        )
    for axes in panels:
        axes.grid(color=RULE, linewidth=0.5)
        axes.set_axisbelow(True)
    return figure, panels


def appearance(style: Style) -> Appearance:
    """Return the keyword arguments of Matplotlib's ``plot`` for a style."""
    colour = PLACEHOLDERS[style.colour]
    return {
        "color": colour,
        "marker": style.marker,
        "markerfacecolor": PLACEHOLDERS["var(--paper)"] if style.hollow else colour,
        "linestyle": (0, style.dash) if style.dash else "-",
        "linewidth": 0.9 if style.hollow else 1.3,
    }


def label_axes(axes: Axes, x: str, y: str) -> None:
    """Write the labels ``x`` and ``y`` on the axes. Label a logarithmic vertical axis with powers of ten."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if axes.get_yscale() == "log":
        log_ticks(axes.yaxis, power_of_ten)


def few_decades(axes: Axes) -> None:
    """If the logarithmic vertical axis covers less than two decades, write labels at more values.

    The labels are at 1, 2 and 5 times each power of ten.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator

    low, high = axes.get_ylim()
    if high < 100 * low:
        axes.yaxis.set_major_locator(LogLocator(base=10, subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda x, _: scientific(x, 1)))


def log_ticks(axis: Axis, text: Callable[[float], str]) -> None:
    """Write labels at the powers of ten on an axis. The label at the value x is ``text(x)``."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(base=10, numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda x, _: text(x)))
    axis.set_minor_formatter(NullFormatter())


def annotate(axes: Axes, text: str, at: Point, shift: Point, side: str) -> None:
    """Write a small text near the point ``at``.

    ``shift`` is the offset of the text in units of 1/72 inch. ``side`` is the horizontal alignment,
    for example ``left``.
    """
    axes.annotate(text, at, xytext=shift, textcoords="offset points", ha=side, color=MUTED, fontsize=8)


def legend(figure: Figure, panels: Sequence[Axes], numbers: Mapping[str, int] | None = None) -> None:
    """Draw the legend above the axes, with one entry for each label.

    In the SVG element, the legend entry with the number k has the identifier ``key:k``. ``numbers`` maps each
    label to its number. By default, the entries are numbered 0, 1, 2, ....
    """
    entries: dict[str, object] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    if not entries:
        return
    width, height = figure.get_size_inches()
    # The legend has one or two columns in a figure of the default width, and more in a wider figure.
    columns = max(1, int(width / SIZE[0] * (1 if max(map(len, entries)) > LONG_LABEL else 2)))
    lines = -(-len(entries) // columns)
    figure.set_size_inches(width, height + LINE * max(0, lines - 3))
    drawn = figure.legend(
        handles=list(entries.values()),
        labels=list(entries),
        loc="outside upper left",
        ncols=columns,
        frameon=False,
        labelcolor=INK,
        handlelength=2.4,
        columnspacing=1.4,
        borderaxespad=0.2,
    )
    for place, (shown, text) in enumerate(zip(drawn.legend_handles, drawn.get_texts(), strict=True)):
        number = place if numbers is None else numbers[text.get_text()]
        text.set_gid(f"key:{number}")
        if shown is not None:
            shown.set_gid(f"key:{number}")
