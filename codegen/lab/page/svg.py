"""Converts Matplotlib figures to SVG elements, with the colours and fonts of the page.

The placeholder colours in the Matplotlib figure are replaced by CSS variables. The identifiers in the SVG
depend only on the drawn shapes and the name of the figure. Therefore, if a figure is drawn again, the SVG
does not change.

The elements of a curve have the attribute ``data-series``, and the legend entry of the curve has the
attribute ``data-key``. The script of the page uses these attributes.
"""

from __future__ import annotations

import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from html import escape
from typing import TYPE_CHECKING, TypeAlias, cast

from markupsafe import Markup

from codegen.lab.page.series_style import COLOURS, Style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Point: TypeAlias = tuple[float, float]

INK, MUTED, RULE = "#010a01", "#010a02", "#010a03"
PLACEHOLDERS = {"var(--ink)": INK, "var(--muted)": MUTED, "var(--rule)": RULE, "var(--paper)": "#010a04"} | {
    f"var(--series-{k})": f"#010b{k:02x}" for k in range(1, COLOURS + 1)
}
"""Maps each CSS variable for a colour to the placeholder colour in the Matplotlib figure."""

SERIES_LIGHT = ("#4963de", "#e55900", "#589457", "#85176f", "#662836", "#009fa9", "#3644a0", "#684a00")
SERIES_DARK = ("#20a5ee", "#d2790e", "#98e57d", "#b341a8", "#cf3452", "#6bcaca", "#6a6dee", "#dfb127")
"""SERIES_LIGHT lists the colours of the curves in light mode, and SERIES_DARK those in dark mode.

Colour-blind readers can distinguish any two colours of one list.
"""

LIGHT = {
    "var(--ink)": "#1d1c1a",
    "var(--muted)": "#6b675f",
    "var(--rule)": "#dedad1",
    "var(--paper)": "#ffffff",
    "var(--sans)": "Helvetica, Arial, 'Liberation Sans', sans-serif",
} | {f"var(--series-{k})": colour for k, colour in enumerate(SERIES_LIGHT, start=1)}
"""Maps each CSS variable to the value that replaces it in a complete SVG document (:func:`standalone`).

In a figure that is part of a page, the style sheet of the page defines the CSS variables.
"""

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
    "lines.markersize": 4.8,
}
"""The settings of Matplotlib for all figures of the report."""


@dataclass(frozen=True)
class Text:
    """The texts of a figure.

    - ``name``: a name that no other figure of the page has.
    - ``title`` and ``description``: texts that screen readers read aloud.
    - ``values``: maps the index of a curve to the tooltips of its markers.
    """

    name: str
    title: str
    description: str
    values: Mapping[int, Sequence[str]]


def svg_element(figure: Figure, text: Text) -> Markup:
    """Return the figure as an SVG element.

    The element has no fixed size, and all colours are CSS variables of the page.
    """
    import matplotlib

    stream = io.StringIO()
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": text.name}):
        figure.savefig(stream, format="svg", transparent=True, metadata={"Date": None})
    drawn = stream.getvalue()
    drawn = drawn[drawn.index("<svg") :]
    drawn = re.sub(r"<metadata>.*?</metadata>", "", drawn, flags=re.DOTALL)
    drawn = re.sub(r'\s+(width|height)="[\d.]+pt"', "", drawn, count=2)
    # The style element is removed, because it would apply to the whole page.
    drawn = re.sub(r"<style.*?</style>", "", drawn, flags=re.DOTALL)
    drawn = re.sub(r'\s+id="[^"]*_\d+"', "", drawn)
    drawn = re.sub(r"""'DejaVu Sans'(?:, [^;"]*)?""", "var(--sans)", drawn)
    for variable, colour in PLACEHOLDERS.items():
        drawn = drawn.replace(colour, variable)
    return Markup(_titled(_with_series(drawn, text.values), text).strip())


def _with_series(drawn: str, values: Mapping[int, Sequence[str]]) -> str:
    """Replace ``id="series:k"`` by ``data-series="k"``, and ``id="key:k"`` by ``data-key="k"`` in ``drawn``.

    If ``values`` contains the number k of a curve, the texts ``values[k]`` become the titles of the markers
    of this curve.
    """
    before, *groups = re.split(r'<g id="series:(\d+)">', drawn)
    parts = [before]
    for number, body in zip(groups[::2], groups[1::2], strict=True):
        parts += [f'<g data-series="{number}">', _with_titles(body, values.get(int(number), ()))]
    return re.sub(r'<g id="key:(\d+)">', r'<g data-key="\1">', "".join(parts))


def _with_titles(body: str, values: Sequence[str]) -> str:
    """Add ``values[0]`` as a title to the first marker in ``body``, ``values[1]`` to the second, and so on.

    If ``body`` has more markers than ``values`` has entries, the last markers get no title.
    """
    titles = iter(values)

    def titled(match: re.Match[str]) -> str:
        value = next(titles, None)
        return match[0] if value is None else f"<use{match[1]}><title>{escape(value)}</title></use>"

    return re.sub(r"<use([^>]*?)/>", titled, body)


def _titled(drawn: str, text: Text) -> str:
    """Return the SVG element ``drawn`` with a title and a description."""
    name = re.sub(r"\W+", "-", text.name)
    head = drawn.index(">")
    return (
        f'{drawn[:head]} role="img" aria-labelledby="{name}-title {name}-desc">'
        f'<title id="{name}-title">{escape(text.title)}</title>'
        f'<desc id="{name}-desc">{escape(text.description)}</desc>{drawn[head + 1 :]}'
    )


def standalone(svg: str) -> str:
    """Return an SVG element as a complete SVG document, with fixed colours and a white background."""
    for variable, value in LIGHT.items():
        svg = svg.replace(variable, value)
    head = svg.index("</desc>") + len("</desc>")
    size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)
    width, height = size.groups() if size else ("100%", "100%")
    paper = f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{svg[:head]}{paper}{svg[head:]}\n'


def key(style: Style) -> Markup:
    """Return a small SVG element that shows a line and a marker in the given style."""
    dash = f";stroke-dasharray:{' '.join(f'{1.4 * x:g}' for x in style.dash)}" if style.dash else ""
    fill = "var(--paper)" if style.hollow else style.colour
    return Markup(
        '<svg class="key" viewBox="0 0 24 10" aria-hidden="true">'
        f'<path d="M0 5H24" style="fill:none;stroke:{style.colour};stroke-width:1.4{dash}"/>'
        f'<path d="{_outline(style.marker)}" style="fill:{fill};stroke:{style.colour};stroke-width:1"/></svg>'
    )


@cache
def _outline(marker: str) -> str:
    """Return the outline of a Matplotlib marker as SVG path data with the centre (12, 5)."""
    from matplotlib.markers import MarkerStyle

    if marker == "o":
        return "M9 5a3 3 0 1 0 6 0a3 3 0 1 0 -6 0Z"
    shape = MarkerStyle(marker)
    path = shape.get_path().transformed(shape.get_transform())
    polygons = cast("Sequence[Sequence[Point]]", path.to_polygons(closed_only=False))
    lines = ("L".join(f"{12 + 6 * x:.2f} {5 - 6 * y:.2f}" for x, y in polygon) for polygon in polygons)
    return "".join(f"M{line}Z" for line in lines)
