"""Enumeration of ordered (planar) rooted trees and ordered forests.

An ordered forest is encoded by the levels of its vertices in preorder, where roots have level 0. The
sequences of levels are enumerated in descending lexicographic order.
"""

from __future__ import annotations

from collections.abc import Iterator

from orderconds.trees.levels import Forest, Tree

_RISING = bytes(range(256))


def ordered_trees(vertices: int) -> Iterator[Tree]:
    """Yield every ordered tree with ``vertices`` vertices exactly once.

    >>> from orderconds.trees.levels import text
    >>> [text(tree) for tree in ordered_trees(4)]
    ['[[[.]]]', '[[..]]', '[[.].]', '[.[.]]', '[...]']
    """
    return _sequences(vertices, lowest=1) if vertices > 0 else iter(())


def ordered_forests(vertices: int) -> Iterator[Forest]:
    """Yield every ordered forest with ``vertices`` vertices exactly once. For zero vertices, yield the empty
    forest.

    >>> from orderconds.trees.levels import text
    >>> [text(forest) for forest in ordered_forests(3)]
    ['[[.]]', '[..]', '[.] .', '. [.]', '. . .']
    """
    return _sequences(vertices, lowest=0)


def _sequences(vertices: int, lowest: int) -> Iterator[bytes]:
    levels, bottom = bytearray(range(vertices)), bytes((lowest,))
    while True:
        yield bytes(levels)
        last = len(levels.rstrip(bottom)) - 1
        if last < 1:
            return
        start = levels[last] - 1
        levels[last:] = _RISING[start : start + vertices - last]
