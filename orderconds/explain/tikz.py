r"""Drawings of diagrams as TikZ pictures for use within formulas. The root is at the bottom.

Pictures of action trees need the tikz library shapes.geometric.
"""

from __future__ import annotations

from collections.abc import Iterator

from orderconds.explain.diagram import Diagram, Edge, Vertex
from orderconds.explain.svg import Layout, lay_out

STYLE = r"\tikzset{tree/.style={x=2mm, y=2.4mm, baseline=(current bounding box.center)}}"
"""The definition of the style of all pictures. A document must contain it before the first picture."""

ARROWS: dict[Edge, str] = {"plain": "", "outward": "[->]", "inward": "[<-]"}


def picture(diagram: Diagram) -> str:
    r"""Return an inline picture.

    >>> from orderconds.explain.diagram import plain
    >>> print(picture(plain(b"\0\1")))
    \tikz[tree]{\draw (0,0) -- (0,1); \fill (0,1) circle[radius=1.2pt]; \fill (0,0) circle[radius=1.2pt];}
    """
    parts, at = list[str](), 0.0
    for vertex in diagram:
        tree = lay_out(vertex)
        parts += _drawn(tree, at - min(tree.left), 0)
        at += max(tree.right) - min(tree.left) + 1
    # Edges are drawn first, because white vertices must cover the ends of the edges.
    ordered = sorted(parts, key=lambda part: not part.startswith(r"\draw") or " -- " not in part)
    return rf"\tikz[tree]{{{' '.join(ordered)}}}"


def _drawn(tree: Layout, x: float, y: int) -> Iterator[str]:
    for branch, child in zip(tree.vertex.branches, tree.below, strict=True):
        far = x + child.x
        yield rf"\draw{ARROWS[branch.edge]} {_point(x, y)} -- {_point(far, y + 1)};"
        yield from _drawn(child, far, y + 1)
    yield _vertex(tree.vertex, x, y)
    if tree.vertex.legs is not None:
        before, letters = tree.vertex.legs
        place = r"\triangleright " * before + "*" + r"\triangleright " * (letters - before)
        yield rf"\node[right,inner sep=1.5pt] at {_point(x, y)} {{$\scriptscriptstyle {place.strip()}$}};"


def _vertex(vertex: Vertex, x: float, y: int) -> str:
    at = _point(x, y)
    match vertex.sign:
        case "letter":
            return rf"\node[inner sep=1pt,fill=white] at {at} {{$\scriptstyle {vertex.label}$}};"
        case "bracket":
            return rf"\fill {at} circle[radius=0.4pt];"
        case "transport":
            return rf"\node[diamond,draw,fill=white,inner sep=1.1pt] at {at} {{}};"
        case "white":
            return rf"\draw[fill=white] {at} circle[radius=1.2pt];"
        case _:
            return rf"\fill {at} circle[radius=1.2pt];"


def _point(x: float, y: int) -> str:
    return f"({round(x, 3):g},{y})"
