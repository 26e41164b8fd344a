"""Rooted and free trees with directed edges: the trees of symplectic partitioned methods.

A partitioned method has weights b_i and two tableaux, a_ij and ahat_ij. Let an edge join a parent i and a
child j. An edge that points away from the root has kind 0 and gives the factor a_ij in the elementary weight.
An edge that points to the root has kind 1 and gives the factor ahat_ij.

Symplectic methods satisfy b_i ahat_ij + b_j a_ji = b_i b_j. In a free tree, let an edge join the vertices r
and s. Let u be the tree with the root r, and let v be the same tree with the root s. Then the sum of the
elementary weights of u and v is the product of the elementary weights of two smaller trees. These two trees
remain if the edge is removed. If the method satisfies the order conditions of the smaller trees, the
conditions of u and v are equivalent. Therefore one condition suffices for all choices of the root: each free
tree with directed edges gives one order condition.

A tree is encoded by one byte ``2 level + kind`` for each vertex, in preorder. ``level`` is the level of the
vertex, and ``kind`` is the kind of the edge to its parent. The branches of a vertex are sorted by their
bytes, in descending order.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import combinations_with_replacement, pairwise, product
from math import factorial, prod

DirectedTree = bytes
Branch = tuple[int, DirectedTree]
"""A branch of a vertex: the kind of its edge, and the subtree at the other end of the edge."""

_LOWERED = bytes((0, 1)) + bytes(range(254))
_RAISED = bytes(range(2, 256)) + bytes(2)
_HUNG = (b"\2", b"\3")


@lru_cache(maxsize=1 << 17)
def branches(tree: DirectedTree) -> tuple[Branch, ...]:
    r"""Return the branches at the root as pairs (kind of the edge, subtree).

    >>> branches(b"\0\2\3")
    ((0, b'\x00'), (1, b'\x00'))
    """
    starts = [place for place in range(1, len(tree)) if tree[place] >> 1 == 1]
    pairs = []
    for start, end in pairwise([*starts, len(tree)]):
        child = tree[start:end].translate(_LOWERED)
        pairs.append((child[0], b"\0" + child[1:]))
    return tuple(pairs)


def joined(below: tuple[Branch, ...] | list[Branch]) -> DirectedTree:
    """Return the tree with a new root and the given branches. The branches are sorted in canonical order.

    >>> text(joined([(1, bytes((0,))), (0, bytes((0,)))]))
    '[^..]'
    """
    raised = [_HUNG[kind] + child[1:].translate(_RAISED) for kind, child in below]
    return b"\0" + b"".join(sorted(raised, reverse=True))


def density(tree: DirectedTree) -> int:
    r"""Return the density gamma, the product of the sizes of all subtrees.

    >>> density(b"\0\2\3")
    3
    """
    result = len(tree)
    for _, child in branches(tree):
        result *= density(child)
    return result


def symmetry(tree: DirectedTree) -> int:
    r"""Return sigma, the number of symmetries of a tree. The branches of each vertex of the tree must be
    sorted by their bytes, in descending order.

    >>> symmetry(b"\0\2\2"), symmetry(b"\0\3\2")
    (2, 1)
    """
    below = branches(tree)
    repeated = {branch: below.count(branch) for branch in below}
    return prod(factorial(times) * symmetry(child) ** times for (_, child), times in repeated.items())


@lru_cache(maxsize=1 << 16)
def text(tree: DirectedTree) -> str:
    r"""Return a tree as text in brackets. The sign ``^`` precedes each subtree below an edge that points
    to the root.

    >>> text(b"\0\3\2")
    '[^..]'
    """
    below = branches(tree)
    inside = "".join(("^" if kind else "") + text(child) for kind, child in below)
    return f"[{inside}]" if below else "."


@lru_cache(maxsize=32)
def directed_rooted_trees(vertices: int) -> tuple[DirectedTree, ...]:
    """Return every rooted tree with directed edges exactly once. The rooted trees index the order conditions
    of partitioned Runge-Kutta methods whose two tableaux have equal weights b.

    >>> [text(tree) for tree in directed_rooted_trees(3)]
    ['[[.]]', '[[^.]]', '[^[.]]', '[^[^.]]', '[..]', '[^..]', '[^.^.]']
    """
    return tuple(directed_rooted_trees_in_turn(vertices))


def directed_rooted_trees_in_turn(vertices: int) -> Iterator[DirectedTree]:
    """Yield the trees of :func:`directed_rooted_trees` one by one, without storing all of them.

    >>> text(next(directed_rooted_trees_in_turn(50))).count("[")
    49
    """
    if vertices >= 1:
        yield from (joined(below) for below in _multisets_in_turn(vertices - 1, vertices - 1))


def directed_free_trees(vertices: int) -> tuple[DirectedTree, ...]:
    """Return all free trees with directed edges, each tree once. The function :func:`representative` chooses
    the root of each tree.

    >>> [text(tree) for tree in directed_free_trees(3)]
    ['[..]', '[^.^.]', '[[.]]']
    """
    if vertices < 1:
        return ()
    # If there is only one centroid, each of its branches has less than half of the vertices. The edge between
    # two centroids divides the tree into halves.
    central = [joined(below) for below in _multisets_in_turn(vertices - 1, (vertices - 1) // 2)]
    if vertices % 2 == 0:
        halves = directed_rooted_trees(vertices // 2)
        central += [joined([*branches(first), (0, second)]) for first, second in product(halves, halves)]
    chosen = [representative(tree) for tree in central]
    return tuple(sorted(chosen, key=lambda tree: (_simplicity(tree), tree)))


def representative(tree: DirectedTree) -> DirectedTree:
    """Move the root of the tree to the vertex that gives the simplest order condition.

    Let n_0 and n_1 be the numbers of edges of kind 0 and of kind 1 after the move. The new root minimizes
    min(n_0, n_1). If several roots are possible, the height of the tree decides, then n_1, and then the byte
    string that encodes the tree. The smallest value is chosen in each case.

    >>> text(representative(bytes((0, 3, 5))))
    '[[.]]'
    """
    return min(_rooted_at(tree, place) for place in _simplest_roots(tree))


def rootings(tree: DirectedTree) -> Iterator[DirectedTree]:
    """For each vertex, yield the given tree with the vertex as root. The edges keep their directions.

    >>> [text(tree) for tree in rootings(bytes((0, 2)))]
    ['[.]', '[^.]']
    """
    yield joined(list(branches(tree)))
    below = branches(tree)
    for place, (kind, child) in enumerate(below):
        rest = joined([*below[:place], *below[place + 1 :]])
        yield from _rootings_beyond(joined([*branches(child), (1 - kind, rest)]), (1 - kind, rest))


def moves(tree: DirectedTree) -> Iterator[tuple[DirectedTree, DirectedTree, DirectedTree]]:
    r"""Yield three trees (u, v, w) for each edge at the root. The removal of the edge gives two trees: u
    contains the root, and v does not. To obtain w, move the root of ``tree`` along the edge to the
    root of v.

    >>> list(moves(b"\0\2"))
    [(b'\x00', b'\x00', b'\x00\x03')]
    """
    below = branches(tree)
    for place, (kind, child) in enumerate(below):
        rest = joined([*below[:place], *below[place + 1 :]])
        yield rest, child, joined([*branches(child), (1 - kind, rest)])


def _simplest_roots(tree: DirectedTree) -> list[int]:
    """Try each vertex of the tree as the root. For each root, let n_0 and n_1 be the numbers of edges of kind
    0 and of kind 1, and let H be the height of the tree. Return the preorder indices of all vertices for
    which the triple (min(n_0, n_1), H, n_1) is smallest in lexicographic order."""
    edges, last, hats, below = len(tree) - 1, [0] * len(tree), [0] * len(tree), [0] * len(tree)
    parents, above = [0] * len(tree), [0] * len(tree)
    hats[0] = sum(level & 1 for level in tree[1:])
    for place in range(1, len(tree)):
        level, kind = tree[place] >> 1, tree[place] & 1
        parents[place] = last[level - 1]
        last[level] = place
        # Each edge of a tree has the kind 0 or 1. Consider the tree in which the vertex ``place`` is the
        # root. The number of edges of kind 1 in this tree is ``hats[place]``. A move of the root across an
        # edge changes the kind of this edge only.
        hats[place] = hats[parents[place]] + 1 - 2 * kind
    rare = [min(n, edges - n) for n in hats]
    least = min(rare)
    places = [place for place, n in enumerate(rare) if n == least]
    if len(places) == 1:
        return places
    for place in range(edges, 0, -1):
        below[parents[place]] = max(below[parents[place]], below[place] + 1)
    heights = below[:]
    for place in range(1, len(tree)):
        up = parents[place]
        siblings = [below[n] + 1 for n in range(1, len(tree)) if parents[n] == up and n != place]
        # ``above[place]`` is the length of the longest path that begins with the edge from ``place`` to its
        # parent.
        beyond = max([*siblings, 0 if up == 0 else above[up]])
        above[place] = beyond + 1
        heights[place] = max(below[place], above[place])
    simplest = min([(heights[place], hats[place]) for place in places])
    return [place for place in places if (heights[place], hats[place]) == simplest]


def _rooted_at(tree: DirectedTree, place: int) -> DirectedTree:
    """Return the tree, in canonical form, with the vertex of preorder index ``place`` as root."""
    behind: list[Branch] = []
    while place:
        start = 1
        for branch in branches(tree):
            if start <= place < start + len(branch[1]):
                break
            start += len(branch[1])
        kind, child = branch
        below = [*branches(tree), *behind]
        below.remove(branch)
        behind = [(1 - kind, joined(below))]
        tree, place = child, place - start
    return joined([*branches(tree), *behind])


def _rootings_beyond(tree: DirectedTree, behind: Branch) -> Iterator[DirectedTree]:
    yield tree
    below = list(branches(tree))
    below.remove(behind)
    for place, (kind, child) in enumerate(below):
        rest = joined([*below[:place], *below[place + 1 :], behind])
        yield from _rootings_beyond(joined([*branches(child), (1 - kind, rest)]), (1 - kind, rest))


def _simplicity(tree: DirectedTree) -> tuple[int, int, int]:
    hats = sum(level & 1 for level in tree[1:])
    return min(hats, len(tree) - 1 - hats), max(tree) >> 1, hats


@lru_cache(maxsize=256)
def _multisets(vertices: int, largest: int) -> tuple[list[Branch], ...]:
    """Return all multisets of branches with ``vertices`` vertices in total. Each branch has at most
    ``largest`` vertices."""
    return tuple(_multisets_in_turn(vertices, largest))


def _multisets_in_turn(vertices: int, largest: int) -> Iterator[list[Branch]]:
    if vertices == 0:
        yield []
        return
    if largest == 0:
        return
    for times in range(vertices // largest, -1, -1):
        rests = (
            None
            if times == 1 and vertices == largest
            else _multisets(vertices - times * largest, largest - 1)
        )
        if rests is None:
            yield from ([(kind, tree)] for kind in (0, 1) for tree in directed_rooted_trees_in_turn(largest))
            continue
        single = [(kind, tree) for kind in (0, 1) for tree in directed_rooted_trees(largest)] if times else []
        for chosen in combinations_with_replacement(single, times):
            for rest in rests:
                yield [*chosen, *rest]
