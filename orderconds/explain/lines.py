"""Drawings of diagrams as text in Unicode or ASCII, with the root at the top."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from orderconds.explain.diagram import Diagram, Edge, Sign, Vertex


@dataclass(frozen=True)
class Style:
    """The characters of one drawing style.

    ``last`` is the corner at the last branch of a vertex. ``fork`` is the junction at each branch except the
    last branch. ``rail`` is a part of the vertical line between two branches.

    A text such as ``(▸*▸)`` after a vertex lists edges from left to right: ``▸`` is the edge to a branch, and
    ``*`` is the edge to the parent.

    >>> ASCII.signs["white"], UNICODE.signs["white"]
    ('o', '○')
    """

    signs: Mapping[Sign, str]
    edges: Mapping[Edge, str]
    fork: str
    last: str
    rail: str


ASCII = Style(
    {"dot": "o", "black": "*", "white": "o", "transport": "L", "bracket": "[,]"},
    {"plain": "-", "outward": ">", "inward": "<"},
    fork="+",
    last="+",
    rail="|",
)
UNICODE = Style(
    {"dot": "●", "black": "●", "white": "○", "transport": "◇", "bracket": "[,]"},
    {"plain": "─", "outward": "▸", "inward": "◂"},
    fork="├",
    last="└",
    rail="│",
)


def draw(diagram: Diagram, style: Style) -> list[str]:
    r"""Return the lines of a drawing. The trees of a forest are drawn one below another.

    >>> from orderconds.explain.diagram import plain, with_directions
    >>> print("\n".join(draw(plain(b"\0\1\2\1"), ASCII)))
    o
    +-o
    | +-o
    +-o
    >>> print("\n".join(draw(with_directions(b"\0\3\5\2"), UNICODE)))
    ●
    ├◂●
    │ └◂●
    └▸●
    """
    return [line for vertex in diagram for line in _lines(vertex, style)]


def _lines(vertex: Vertex, style: Style) -> Iterator[str]:
    place = ""
    if vertex.legs is not None:
        before, letters = vertex.legs
        letter = style.edges["outward"]
        place = f" ({letter * before}*{letter * (letters - before)})"
    yield (vertex.label or style.signs[vertex.sign]) + place
    for number, branch in enumerate(vertex.branches, start=1):
        is_last = number == len(vertex.branches)
        first, *rest = _lines(branch.vertex, style)
        yield (style.last if is_last else style.fork) + style.edges[branch.edge] + first
        for line in rest:
            yield ("  " if is_last else style.rail + " ") + line
