"""Admissible cuts of trees and forests.

A cut removes parts, called components, from a tree or forest. The part that remains is called the rest.

- For unordered trees, a cut is a set of edges, with at most one edge on each path from the root (Connes and
  Kreimer 1998; HLW III.1.4). One additional cut removes the whole tree.
- For ordered forests, a left admissible cut removes the first k trees from the left, where k may be zero. The
  removed trees form one component. At each remaining vertex, the cut removes the first n branches from the
  left. The number n may be zero, and may be different for each vertex. The branches removed at one vertex
  form one component (Munthe-Kaas and Wright, Found. Comput. Math. 8 (2008) 227).

HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from itertools import product

from orderconds.trees.levels import Forest, Tree, branches, children, rooted_at_new_vertex, trees_of

Cut = tuple[tuple[bytes, ...], bytes]
"""A pair (components, rest). A cut removes the components from a tree or a forest, and leaves the rest."""

Cuts = Callable[[bytes], tuple[Cut, ...]]


@lru_cache(maxsize=1 << 14)
def tree_cuts(tree: Tree) -> tuple[Cut, ...]:
    r"""Return every admissible cut of a canonical rooted tree. If the tree has equal branches, equal cuts are
    returned several times. The last cut removes the whole tree.

    >>> tree_cuts(b"\0\1")
    (((), b'\x00\x01'), ((b'\x00',), b'\x00'), ((b'\x00\x01',), b''))
    """
    if not tree:
        return (((), b""),)
    cuts = []
    for choice in product(*map(tree_cuts, children(tree))):
        components = tuple(component for cut, _ in choice for component in cut)
        cuts.append(
            (components, rooted_at_new_vertex(b"".join(sorted((rest for _, rest in choice), reverse=True))))
        )
    return (*cuts, ((tree,), b""))


@lru_cache(maxsize=1 << 14)
def left_cuts(forest: Forest) -> tuple[Cut, ...]:
    r"""Return every left admissible cut of an ordered forest, as a pair (components, rest). The last cut
    removes the whole forest.

    >>> left_cuts(b"\0\0")
    (((), b'\x00\x00'), ((b'\x00',), b'\x00'), ((b'\x00\x00',), b''))
    """
    trees = trees_of(forest)
    cuts = []
    for cut in range(len(trees) + 1):
        off = (b"".join(trees[:cut]),) if cut else ()
        for choice in product(*(left_cuts(branches(tree)) for tree in trees[cut:])):
            components = tuple(component for above, _ in choice for component in above)
            cuts.append((off + components, b"".join(rooted_at_new_vertex(rest) for _, rest in choice)))
    return tuple(cuts)
