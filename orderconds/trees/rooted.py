"""Enumeration of unordered rooted trees as canonical level sequences.

Each sequence is computed in place from the preceding sequence (T. Beyer and S. M. Hedetniemi, "Constant time
generation of rooted trees", SIAM J. Comput. 9 (1980) 706-712).
"""

from __future__ import annotations

from collections.abc import Iterator

from orderconds.trees.levels import Tree


def rooted_trees(vertices: int) -> Iterator[Tree]:
    """Yield every rooted tree with ``vertices`` vertices exactly once, in canonical form. The first tree is a
    path. In the last tree, all vertices except the root are leaves.

    >>> from orderconds.trees.levels import text
    >>> [text(tree) for tree in rooted_trees(4)]
    ['[[[.]]]', '[[..]]', '[[.].]', '[...]']
    """
    if vertices < 1:
        return
    levels = bytearray(range(vertices))
    while True:
        yield bytes(levels)
        # Number the vertices in preorder. Let p be the last vertex of level 2 or more. Let q be the parent of
        # p. Replace the levels from p to the end. The new levels repeat the levels of q, ..., p - 1.
        last = len(levels.rstrip(b"\1")) - 1
        if last < 1:
            return
        parent = levels.rindex(levels[last] - 1, 0, last)
        period = levels[parent:last]
        copies = (vertices - last) // len(period) + 1
        levels[last:] = (period * copies)[: vertices - last]
