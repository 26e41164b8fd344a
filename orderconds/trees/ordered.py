"""Ordered (planar) rooted trees and ordered forests. Each level sequence is computed from the preceding one,
in place.

The sequences of n levels that start at 0 and never rise by more than one are exactly the ordered forests with
n vertices. The sequences that contain the level 0 only at the start are the trees. Both are listed in
descending lexicographic order.
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
        # The last level that can decrease is decreased. From this level on, all later levels increase as fast
        # as possible.
        last = len(levels.rstrip(bottom)) - 1
        if last < 1:
            return
        start = levels[last] - 1
        levels[last:] = _RISING[start : start + vertices - last]
