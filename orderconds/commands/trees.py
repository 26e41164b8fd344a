"""``orderconds trees``: enumerate, count and draw trees, forests and Lyndon words of one order."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import click

from orderconds.commands import screen
from orderconds.errors import UnknownName


@dataclass(frozen=True)
class Kind:
    """What one KIND enumerates: its members of an order, their number, their text and their drawing."""

    members: Callable[[int], Iterable[Any]]
    count: Callable[[int], int]
    text: Callable[[Any], str]
    draw: Callable[[Any], list[str]]


@click.command(name="trees", short_help="Enumerate trees, forests and Lyndon words.")
@click.argument("kind")
@click.option("--order", "-p", type=click.IntRange(1, 40), required=True, help="How many vertices.")
@click.option("--count", is_flag=True, help="Only their number, from its generating function.")
@click.option("--draw", is_flag=True, help="A drawing of each.")
@click.option("--json", "as_json", is_flag=True, help="One record on stdout, nothing else.")
def command(kind: str, order: int, count: bool, draw: bool, as_json: bool) -> int:
    """Enumerate the trees of one KIND with so many vertices: rooted (unordered), ordered (planar),
    directed (free trees whose edges carry a direction), forests (of ordered trees), or lyndon (Lyndon
    words over ordered trees).
    """
    found = _kind(kind)
    number = found.count(order)
    if as_json:
        record: dict[str, Any] = {"kind": kind, "order": order, "count": number}
        screen.print_json(record if count else {**record, "trees": [*map(found.text, found.members(order))]})
    elif count:
        click.echo(number)
    else:
        for member in found.members(order):
            click.echo(found.text(member))
            if draw:
                click.echo("".join(f"    {line}\n" for line in found.draw(member)))
    return 0


def draw_tree(level_sequence: Iterable[int], marks: Iterable[str] = ()) -> list[str]:
    r"""Draw a rooted tree, the root on top, a vertex a line, from its levels in preorder.

    ``marks`` stand in front of the vertices, one each.

    >>> print("\n".join(draw_tree([0, 1, 2, 1])))
    o
    +-o
    | +-o
    +-o
    """
    levels = list(level_sequence)
    signs = list(marks) or ["-"] * len(levels)
    lines = []
    for place, level in enumerate(levels):
        # A line runs down at level k where another child of the vertex at level k - 1 still follows.
        rails = ["| " if _continues(levels[place + 1 :], k) else "  " for k in range(1, level)]
        lines.append("".join(rails) + (f"+{signs[place]}" if level else "") + "o")
    return lines


def _continues(after: list[int], level: int) -> bool:
    return next((found == level for found in after if found <= level), False)


def _draw_directed(tree: bytes) -> list[str]:
    """Draw a rooting of a directed tree: ``>`` an edge away from the root (a_ij), ``<`` towards it
    (ahat_ij)."""
    return draw_tree([v >> 1 for v in tree], ["<" if v & 1 else ">" for v in tree])


def _draw_forest(forest: bytes) -> list[str]:
    from orderconds.trees.levels import trees_of

    return _draw_word(trees_of(forest))


def _draw_word(word: Iterable[bytes]) -> list[str]:
    return [line for tree in word for line in draw_tree(tree)]


def _rooted() -> Kind:
    from orderconds.trees import counts, levels, rooted

    return Kind(rooted.rooted_trees, counts.rooted_tree_count, levels.text, draw_tree)


def _ordered() -> Kind:
    from orderconds.trees import counts, levels, ordered

    return Kind(ordered.ordered_trees, counts.ordered_tree_count, levels.text, draw_tree)


def _directed() -> Kind:
    from orderconds.trees import counts, directed

    count = counts.directed_free_tree_count
    return Kind(directed.directed_free_trees, count, directed.text, _draw_directed)


def _forests() -> Kind:
    from orderconds.trees import counts, levels, ordered

    return Kind(ordered.ordered_forests, counts.ordered_forest_count, levels.text, _draw_forest)


def _lyndon() -> Kind:
    from orderconds.trees import counts, levels, ordered
    from orderconds.words.lyndon import lyndon_words

    def words(order: int) -> Iterator[tuple[bytes, ...]]:
        letters = [tree for n in range(1, order + 1) for tree in ordered.ordered_trees(n)]
        return lyndon_words(letters, order, weigh=len)

    def count(order: int) -> int:
        return counts.lyndon_word_count(order, counts.ordered_tree_count)

    def text(word: tuple[bytes, ...]) -> str:
        return " ".join(map(levels.text, word))

    return Kind(words, count, text, _draw_word)


KINDS = {
    "rooted": _rooted,
    "ordered": _ordered,
    "directed": _directed,
    "forests": _forests,
    "lyndon": _lyndon,
}
"""The kinds; each is put together when it is asked for."""


def _kind(name: str) -> Kind:
    if name not in KINDS:
        close = difflib.get_close_matches(name, KINDS, n=1)
        raise UnknownName(
            f"there is no kind of trees {name!r}",
            expected=f"one of {', '.join(KINDS)}",
            hint=f"type: orderconds trees {close[0] if close else 'rooted'} --order 4",
        )
    return KINDS[name]()
