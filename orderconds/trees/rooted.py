"""Enumeration of unordered rooted trees as canonical level sequences.

The algorithm computes each sequence from the preceding sequence (T. Beyer and S. M. Hedetniemi, "Constant
time generation of rooted trees", SIAM J. Comput. 9 (1980) 706-712).
"""

from __future__ import annotations

from collections.abc import Iterator

from orderconds.trees.levels import Tree


def rooted_trees(vertices: int) -> Iterator[Tree]:
    """Yield the canonical form of every rooted tree with ``vertices`` vertices exactly once
    (:func:`orderconds.trees.levels.canonical`).

    >>> from orderconds.trees.levels import text
    >>> [text(tree) for tree in rooted_trees(4)]
    ['[[[.]]]', '[[..]]', '[[.].]', '[...]']
    """
    if vertices < 1:
        return
    levels = bytearray(range(vertices))
    while True:
        yield bytes(levels)
        # Compute the next canonical sequence: replace levels[last:] by copies of levels[parent:last].
        last = len(levels.rstrip(b"\1")) - 1
        if last < 1:
            return
        parent = levels.rindex(levels[last] - 1, 0, last)
        period = levels[parent:last]
        copies = (vertices - last) // len(period) + 1
        levels[last:] = (period * copies)[: vertices - last]
