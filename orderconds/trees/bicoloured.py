"""Rooted trees with vertices of two colours: the trees of P-series (HLW III.2.1).

Colour 0 (black) denotes the first part y of a partitioned system, and colour 1 (white) denotes the second
part z. A tree is encoded by one byte ``2 level + colour`` for each vertex, in preorder. The root has level
0. The branches at each vertex are sorted, and the branch with the greatest encoding comes first.

HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import factorial, prod

from orderconds.trees.directed import branches, directed_rooted_trees_in_turn, joined
from orderconds.trees.free import free_trees
from orderconds.trees.levels import Tree

BicolouredTree = bytes


def bicoloured_rooted_trees(vertices: int) -> Iterator[BicolouredTree]:
    """Yield all rooted trees with ``vertices`` vertices, each tree once. Every vertex is black or white. The
    trees with a black root come before the trees with a white root.

    In the example, ``.`` is a black leaf, and ``o`` is a white leaf. Square brackets enclose the branches of
    a black root, and round brackets enclose the branches of a white root.

    >>> [text(tree) for tree in bicoloured_rooted_trees(2)]
    ['[.]', '[o]', '(.)', '(o)']
    """
    for colour in (0, 1):
        for tree in directed_rooted_trees_in_turn(vertices):
            yield coloured(colour, tree)


def alternating_free_trees(vertices: int) -> tuple[BicolouredTree, ...]:
    """Return all free trees in which neighbours differ in colour, each tree once. The root is chosen to make
    the height of the tree as small as possible.

    Symplectic partitioned methods for separable Hamiltonians have one order condition for each of these trees
    (Abia and Sanz-Serna 1993; HLW VI.7.2).

    >>> [text(tree) for n in (1, 2, 3) for tree in alternating_free_trees(n)]
    ['.', 'o', '[o]', '[oo]', '(..)']
    """
    chosen: dict[BicolouredTree, BicolouredTree] = {}
    for tree in free_trees(vertices):
        for colour in (0, 1):
            every = sorted(bicoloured_rootings(alternating(colour, tree)), key=lambda t: (max(t) >> 1, t))
            chosen.setdefault(min(every), every[0])
    return tuple(chosen.values())


def alternating(colour: int, tree: Tree) -> BicolouredTree:
    r"""Colour a rooted tree such that neighbours differ in colour, and the root has the given colour. Return
    the coloured tree in canonical order.

    >>> text(alternating(1, b"\0\1\2\1"))
    '([o].)'
    """
    plain = bytes(2 * level + ((colour + level) & 1) for level in tree)
    return canonical(plain)


def canonical(tree: BicolouredTree) -> BicolouredTree:
    """Return the tree in canonical order: at every vertex, the branches are sorted by their encodings, the
    greatest encoding first.

    >>> canonical(bytes((0, 2, 3))) == canonical(bytes((0, 3, 2)))
    True
    """
    below = [(kind, canonical(child)) for kind, child in branches(tree)]
    return coloured(tree[0], joined(below))


def coloured(colour: int, tree: bytes) -> BicolouredTree:
    """Return a copy of the tree in which the root has the given colour.

    >>> text(coloured(1, bytes((0, 2))))
    '(.)'
    """
    return bytes((colour,)) + tree[1:]


def children(tree: BicolouredTree) -> tuple[BicolouredTree, ...]:
    """Return the subtrees below the root.

    >>> [text(child) for child in children(bytes((0, 3, 2)))]
    ['o', '.']
    """
    return tuple(coloured(colour, child) for colour, child in branches(tree))


def rooted(colour: int, below: list[BicolouredTree]) -> BicolouredTree:
    """Return the tree with a new root of the given colour. The given subtrees become the branches of the
    root, sorted in canonical order.

    >>> text(rooted(1, [bytes((0,)), bytes((1,))]))
    '(o.)'
    """
    return coloured(colour, joined([(child[0], coloured(0, child)) for child in below]))


def bicoloured_rootings(tree: BicolouredTree) -> Iterator[BicolouredTree]:
    """For each vertex, yield the given tree with the vertex as root. The colours do not change.

    >>> [text(tree) for tree in bicoloured_rootings(bytes((0, 3)))]
    ['[o]', '(.)']
    """
    yield from _rootings(tree[0], list(children(tree)), [])


def moves(tree: BicolouredTree) -> Iterator[tuple[BicolouredTree, BicolouredTree, BicolouredTree]]:
    r"""Yield three trees (u, v, w) for each edge at the root. The removal of the edge gives two trees: u
    contains the root, and v does not. The tree w has the vertices and edges of ``tree``, but its root is the
    root of v.

    >>> list(moves(b"\0\3"))
    [(b'\x00', b'\x01', b'\x01\x02')]
    """
    below = list(children(tree))
    for place, child in enumerate(below):
        rest = rooted(tree[0], below[:place] + below[place + 1 :])
        yield rest, child, rooted(child[0], [*children(child), rest])


def _rootings(
    colour: int, below: list[BicolouredTree], above: list[BicolouredTree]
) -> Iterator[BicolouredTree]:
    yield rooted(colour, below + above)
    for place, child in enumerate(below):
        rest = rooted(colour, below[:place] + below[place + 1 :] + above)
        yield from _rootings(child[0], list(children(child)), [rest])


def symmetry(tree: BicolouredTree) -> int:
    """Return sigma, the order of the group of symmetries that preserve the colours (HLW III.2, (2.4)).

    >>> [symmetry(tree) for tree in bicoloured_rooted_trees(3)][4:7]
    [2, 1, 2]
    """
    below = children(tree)
    return prod(factorial(below.count(child)) * symmetry(child) ** below.count(child) for child in set(below))


def text(tree: BicolouredTree) -> str:
    """Return a tree as text. A black vertex without branches is ``.``, and a white one is ``o``. At other
    vertices, the branches are written in ``[ ]`` if the vertex is black, and in ``( )`` if it is white.

    >>> text(bytes((0, 3, 2, 5)))
    '[o[o]]'
    """
    below = "".join(map(text, children(tree)))
    if not below:
        return ".o"[tree[0]]
    return f"({below})" if tree[0] else f"[{below}]"
