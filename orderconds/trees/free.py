"""Free (unrooted) trees, and the effect of moving the root of a tree.

The order conditions of symplectic Runge-Kutta methods are indexed by free trees. For symplectic methods, the
tableau a_ij and the weights b_i satisfy b_i a_ij + b_j a_ji = b_i b_j. Let phi be the elementary weight, and
let o be Butcher's product of rooted trees. Then phi(u o v) + phi(v o u) = phi(u) phi(v) for all rooted trees
u and v (Sanz-Serna and Abia 1991; HLW VI.7.1).

A free tree is called superfluous if one of its edges joins the roots of two copies of a rooted tree t, as
in t o t. The order condition of t o t follows from the order condition of t.

HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from orderconds.trees.levels import Tree, children, rooted_at_new_vertex
from orderconds.trees.rooted import rooted_trees

Move = tuple[Tree, Tree]
"""A pair (u, v) represents the replacement of u o v by v o u, where o is Butcher's product."""


@lru_cache(maxsize=32)
def free_trees(vertices: int) -> tuple[Tree, ...]:
    """Return every free tree exactly once. The function :func:`representative` chooses the root of each tree.

    >>> from orderconds.trees.levels import text
    >>> [text(tree) for tree in free_trees(5)]
    ['[[..].]', '[[.][.]]', '[....]']
    """
    return tuple(tree for tree in rooted_trees(vertices) if representative(tree) == tree)


def essential_free_trees(vertices: int) -> tuple[Tree, ...]:
    """Return the free trees that are not superfluous (:func:`superfluous`; Hairer, Lubich and Wanner,
    *Geometric Numerical Integration*, VI.7.1).

    >>> [len(essential_free_trees(n)) for n in range(1, 8)]
    [1, 0, 1, 1, 3, 4, 11]
    """
    return tuple(tree for tree in free_trees(vertices) if not superfluous(tree))


def superfluous(tree: Tree) -> bool:
    r"""Return True if one of the edges of the tree joins the roots of two equal rooted trees. The order
    condition of the tree then follows from a condition of lower order.

    >>> superfluous(b"\0\1"), superfluous(b"\0\1\1")
    (True, False)
    """
    return any(u == v for u, v in _edges(tree))


def representative(tree: Tree) -> Tree:
    r"""Return the tree with the root at the vertex that gives the least height. If several vertices give the
    least height, choose the vertex that gives the greatest level sequence in lexicographic order.

    >>> representative(b"\0\1\2")
    b'\x00\x01\x01'
    """
    return min((rooting for rooting, _ in rootings(tree)), key=lambda t: (max(t), bytes(255 - x for x in t)))


def moves(tree: Tree) -> Iterator[tuple[Tree, Tree, Tree]]:
    r"""Yield three trees (u, v, w) for each edge at the root of a canonical tree. The removal of the edge
    gives two trees: u contains the root, and v does not. The tree w is the given tree, but its root is the
    root of v. Thus w is Butcher's product v o u.

    >>> list(moves(b"\0\1\1"))[0]
    (b'\x00\x01', b'\x00', b'\x00\x01\x02')
    """
    below = children(tree)
    for place, child in enumerate(below):
        rest = _joined((*below[:place], *below[place + 1 :]))
        yield rest, child, _joined((*children(child), rest))


def rootings(tree: Tree) -> Iterator[tuple[Tree, tuple[Move, ...]]]:
    r"""Yield a pair (rooting, moves) for each vertex of a canonical tree. ``rooting`` is the tree with the
    vertex as root. ``moves`` contains one :data:`Move` for each edge on the path from the root of ``tree`` to
    the vertex.

    >>> list(rootings(b"\0\1"))
    [(b'\x00\x01', ()), (b'\x00\x01', ((b'\x00', b'\x00'),))]
    """
    yield from _rootings(children(tree), None, ())


def _rootings(
    below: tuple[Tree, ...], above: Tree | None, moves: tuple[Move, ...]
) -> Iterator[tuple[Tree, tuple[Move, ...]]]:
    everything = below if above is None else (*below, above)
    yield _joined(everything), moves
    for place, child in enumerate(below):
        rest = _joined((*everything[:place], *everything[place + 1 :]))
        yield from _rootings(children(child), rest, (*moves, (rest, child)))


def _edges(tree: Tree) -> Iterator[Move]:
    for _, moves in rootings(tree):
        yield from moves[-1:]


def _joined(below: tuple[Tree, ...]) -> Tree:
    return rooted_at_new_vertex(b"".join(sorted(below, reverse=True)))
