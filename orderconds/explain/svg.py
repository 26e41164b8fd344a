"""Drawings of diagrams in SVG, with the root at the bottom.

Coordinates are rounded to two decimal places, so that the bytes of a drawing do not depend on the platform.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape

from orderconds.explain.diagram import Branch, Diagram, Edge, Vertex

STEP = 18.0
"""The horizontal distance between neighbouring vertices, and the vertical distance between levels, in px."""
RADIUS = 3.5
MARGIN = 10.0
SIZE = 11.0
"""The font size of captions in px. A letter of the monospaced font has the width ``0.6 * SIZE``."""

TEXT_FONT = 'font-family="monospace"'
FORMULA_FONT = 'font-family="serif" font-style="italic" letter-spacing="0.8"'
RAISED = str.maketrans("()0123456789", "⁽⁾⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Layout:
    """A vertex with its branches and its horizontal position ``x`` relative to its parent.

    Level k of the subtree extends from ``left[k]`` to ``right[k]``, relative to the vertex. The unit of
    length is the least distance between neighbouring vertices.
    """

    x: float
    vertex: Vertex
    below: tuple[Layout, ...]
    left: tuple[float, ...]
    right: tuple[float, ...]


def lay_out(vertex: Vertex) -> Layout:
    r"""Return the layout of a vertex by the method of Reingold and Tilford.

    The vertex is drawn in the middle between its first and its last branch. Source: E. M. Reingold and J. S.
    Tilford, IEEE Trans. Softw. Eng. 7 (1981) 223.

    >>> from orderconds.explain.diagram import plain
    >>> [child.x for child in lay_out(plain(b"\0\1\1\1")[0]).below]
    [-1.0, 0.0, 1.0]
    """
    children = [lay_out(branch.vertex) for branch in vertex.branches]
    places: list[float] = []
    outline: list[float] = []
    for child in children:
        gaps = [right - left for right, left in zip(outline, child.left, strict=False)]
        place = max((gap + 1.0 for gap in gaps), default=0.0)
        places.append(place)
        reached = [place + x for x in child.right]
        outline = reached + outline[len(reached) :]
    middle = (places[0] + places[-1]) / 2 if places else 0.0
    places = [place - middle for place in places]
    moved = tuple(
        Layout(place, child.vertex, child.below, child.left, child.right)
        for place, child in zip(places, children, strict=True)
    )
    depth = max((len(child.left) for child in moved), default=0)
    left = [min(c.x + c.left[level] for c in moved if level < len(c.left)) for level in range(depth)]
    right = [max(c.x + c.right[level] for c in moved if level < len(c.right)) for level in range(depth)]
    # A vertex with ``legs`` needs room for a text to its right, such as ``›*``.
    room = 1.0 if vertex.legs is not None else 0.0
    return Layout(0.0, vertex, moved, (0.0, *left), (room, *right))


def sheet(entries: Iterable[tuple[Diagram, Sequence[str]]], width: float = 900.0) -> str:
    r"""Return an SVG document that contains all diagrams in rows, with captions.

    ``width`` is the width of the document in px.

    >>> from orderconds.explain.diagram import plain
    >>> document = sheet([(plain(b"\0\1\1"), ["[..]"])])
    >>> document.count("<circle"), document.count("<path"), "[..]" in document
    (3, 2, True)
    """
    body: list[str] = []
    y, widest = MARGIN, 0.0
    for row in _rows([_Block(diagram, tuple(caption)) for diagram, caption in entries], width):
        x, ground = MARGIN, y + max(block.levels for block in row) * STEP
        for block in row:
            body += block.drawn(x, ground)
            x += block.width + 2 * MARGIN
        widest = max(widest, x - MARGIN)
        y = ground + max(block.under for block in row) + 2 * MARGIN
    height = max(y - MARGIN, 0.0)
    size = f'width="{_number(widest)}" height="{_number(height)}"'
    view_box = f'viewBox="0 0 {_number(widest)} {_number(height)}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} {view_box} fill="none" stroke="currentColor">'
    return "\n".join([head, *body, "</svg>", ""])


def _rows(blocks: Iterable[_Block], width: float) -> Iterator[list[_Block]]:
    row: list[_Block] = []
    taken = MARGIN
    for block in blocks:
        if row and taken + block.width > width - MARGIN:
            yield row
            row, taken = [], MARGIN
        row.append(block)
        taken += block.width + 2 * MARGIN
    if row:
        yield row


class _Block:
    """One diagram and its caption. All lengths are in px."""

    def __init__(self, diagram: Diagram, caption: tuple[str, ...]) -> None:
        self.caption = caption
        self.trees = [lay_out(vertex) for vertex in diagram]
        self.spans = [(min(tree.left), max(tree.right)) for tree in self.trees]
        self.levels = max((len(tree.left) for tree in self.trees), default=0)
        self.drawing = sum(right - left + 1 for left, right in self.spans) * STEP
        self.width = max([self.drawing, *(0.6 * SIZE * len(line) for line in caption)])
        self.under = 1.4 * SIZE * len(caption)

    def drawn(self, x: float, ground: float) -> Iterator[str]:
        """Yield the SVG elements of the diagram and of its caption. ``x`` is the left border. The diagram
        is above the vertical position ``ground``, and the caption is below."""
        at = x + (self.width - self.drawing) / 2
        for tree, (left, right) in zip(self.trees, self.spans, strict=True):
            yield from _drawn(tree, at + (0.5 - left) * STEP, ground - STEP / 2)
            at += (right - left + 1) * STEP
        for line, text in enumerate(self.caption, start=1):
            baseline = ground + 1.4 * SIZE * line - 0.4 * SIZE
            # The first line of the caption is the text of a tree.
            font = TEXT_FONT if line == 1 else FORMULA_FONT
            shown = text if line == 1 else _formula(text)
            yield _text(x + self.width / 2, baseline, shown, SIZE, "middle", font)


def _drawn(tree: Layout, x: float, y: float) -> Iterator[str]:
    """Yield the SVG elements of a tree whose root is at (x, y)."""
    for branch, child in zip(tree.vertex.branches, tree.below, strict=True):
        far = x + child.x * STEP
        yield _edge(tree.vertex, branch, x, y, far, y - STEP)
        yield from _drawn(child, far, y - STEP)
    yield _vertex(tree.vertex, x, y)
    if tree.vertex.legs is not None:
        before, letters = tree.vertex.legs
        place = "›" * before + "*" + "›" * (letters - before)
        yield _text(x + 1.6 * RADIUS, y + RADIUS, place, 0.8 * SIZE, "start")


def _formula(text: str) -> str:
    """Return the text of an elementary differential with typographic primes and superscripts."""
    raised = re.sub(r"\^(\(\d+\)|\d+)", lambda match: match[1].translate(RAISED), text)
    return raised.replace("'", "′")


def _vertex(vertex: Vertex, x: float, y: float) -> str:
    if vertex.sign == "letter":
        return _text(x, y + 0.35 * SIZE, vertex.label, SIZE, "middle")
    if vertex.sign == "bracket":
        return f'<circle cx="{_number(x)}" cy="{_number(y)}" r="1"/>'
    if vertex.sign == "transport":
        corners = [(x, y - RADIUS), (x + RADIUS, y), (x, y + RADIUS), (x - RADIUS, y)]
        path = " L".join(f"{_number(a)} {_number(b)}" for a, b in corners)
        return f'<path d="M{path} Z"/>'
    filled = "" if vertex.sign == "white" else ' fill="currentColor"'
    return f'<circle cx="{_number(x)}" cy="{_number(y)}" r="{_number(RADIUS)}"{filled}/>'


def _edge(vertex: Vertex, branch: Branch, x: float, y: float, far: float, high: float) -> str:
    """Return the SVG path of an edge between the borders of its two vertices."""
    length = ((far - x) ** 2 + (high - y) ** 2) ** 0.5
    along = ((far - x) / length, (high - y) / length)
    near, rim = _room(vertex), _room(branch.vertex)
    start = (x + near * along[0], y + near * along[1])
    end = (far - rim * along[0], high - rim * along[1])
    return f'<path d="M{_pair(start)} L{_pair(end)}{_head(branch.edge, start, end, along)}"/>'


def _room(vertex: Vertex) -> float:
    """Return the distance in px from the centre of ``vertex`` at which the lines to other vertices begin."""
    return {"letter": 2 * RADIUS, "bracket": 1.0}.get(vertex.sign, RADIUS)


def _head(
    edge: Edge, start: tuple[float, float], end: tuple[float, float], along: tuple[float, float]
) -> str:
    if edge == "plain":
        return ""
    forward = 1.0 if edge == "outward" else -1.0
    u, v = forward * along[0], forward * along[1]
    tip = ((start[0] + end[0]) / 2 + 2 * u, (start[1] + end[1]) / 2 + 2 * v)
    barbs = [(tip[0] - 4 * u + side * 3 * v, tip[1] - 4 * v - side * 3 * u) for side in (1, -1)]
    return f" M{_pair(barbs[0])} L{_pair(tip)} L{_pair(barbs[1])}"


def _text(x: float, y: float, text: str, size: float, anchor: str, family: str = TEXT_FONT) -> str:
    font = f'{family} font-size="{_number(size)}" text-anchor="{anchor}"'
    place = f'x="{_number(x)}" y="{_number(y)}"'
    return f'<text {place} {font} fill="currentColor" stroke="none">{escape(text)}</text>'


def _pair(point: tuple[float, float]) -> str:
    return f"{_number(point[0])} {_number(point[1])}"


def _number(value: float) -> str:
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")
