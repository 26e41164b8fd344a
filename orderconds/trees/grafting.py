"""Two products of trees: Butcher's product and grafting.

Let F(t) be the elementary differential of a tree t. Grafting u onto v corresponds to the derivative of F(v)
in the direction F(u). Unordered trees with the grafting product form the free pre-Lie algebra (Chapoton and
Livernet 2001).

On a Lie group, trees are ordered, because derivatives in different directions do not commute. Let t be an
ordered tree with the branches t_1, ..., t_k at the root. To obtain F(t), differentiate the vector field k
times: first in the direction F(t_k), then in the direction F(t_{k-1}), ..., and last in the direction F(t_1).
In these derivatives, each direction is frozen: F(t_i) is an element of the Lie algebra and is not
differentiated. Grafting onto the root gives one further derivative. The grafted tree becomes the leftmost
branch (Munthe-Kaas and Wright, Found. Comput. Math. 8 (2008) 227).

HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections import Counter
from functools import lru_cache

from orderconds.trees.levels import (
    Forest,
    Tree,
    branches,
    canonical,
    children,
    rooted_at_new_vertex,
    trees_of,
)


def butcher_product(u: Tree, v: Tree) -> Tree:
    r"""Return u o v, the tree u with v as an additional branch at the root (HLW VI.7.1). The result is
    canonical if u and v are canonical.

    >>> butcher_product(b"\0\1", b"\0\1\1")
    b'\x00\x01\x02\x02\x01'
    """
    below = sorted((*children(u), v), reverse=True)
    return rooted_at_new_vertex(b"".join(below))


def graft(u: Tree, v: Tree) -> Counter[Tree]:
    r"""Return the unordered trees that result if u becomes a new branch of a vertex of v.

    The result maps each tree to the number of vertices of v that give this tree.

    >>> sorted(graft(b"\0", b"\0\1\1").items())
    [(b'\x00\x01\x01\x01', 1), (b'\x00\x01\x02\x01', 2)]
    """
    result = Counter([butcher_product(v, u)])
    below = children(v)
    for place, child in enumerate(below):
        others = (*below[:place], *below[place + 1 :])
        for grown, times in graft(u, child).items():
            result[canonical(rooted_at_new_vertex(b"".join((grown, *others))))] += times
    return result


@lru_cache(maxsize=1 << 14)
def left_graft(word: Forest, onto: Forest) -> tuple[Forest, ...]:
    r"""Return the forests that result from grafting: each tree of the forest ``word`` becomes a branch of a
    vertex of ``onto``.

    The tuple contains one forest for each choice of the vertices, so a forest can occur several times. The
    new branches of a vertex keep their order, and are placed to the left of its existing branches.

    >>> left_graft(b"\0", b"\0\1")
    (b'\x00\x01\x02', b'\x00\x01\x01')
    """
    if not word:
        return (onto,)
    if not onto:
        return ()
    first, rest = trees_of(onto)[0], onto[len(trees_of(onto)[0]) :]
    grafted = []
    for first_part, second_part in deshuffles(word):
        for front in _left_graft_tree(first_part, first):
            grafted += [front + behind for behind in left_graft(second_part, rest)]
    return tuple(grafted)


def _left_graft_tree(word: Forest, tree: Tree) -> list[Tree]:
    """Return the trees that result from grafting the forest ``word`` onto vertices of ``tree``, as in
    :func:`left_graft`."""
    grafted = []
    for root, above in deshuffles(word):
        grafted += [rooted_at_new_vertex(root + grown) for grown in left_graft(above, branches(tree))]
    return grafted


def deshuffles(word: Forest) -> tuple[tuple[Forest, Forest], ...]:
    r"""Return all divisions of a forest into two forests. The trees of a forest keep their order.

    >>> deshuffles(b"\0")
    ((b'', b'\x00'), (b'\x00', b''))
    """
    letters = trees_of(word)
    parted = []
    for chosen in range(1 << len(letters)):
        inside = b"".join(tree for n, tree in enumerate(letters) if chosen >> n & 1)
        outside = b"".join(tree for n, tree in enumerate(letters) if not chosen >> n & 1)
        parted.append((inside, outside))
    return tuple(parted)
