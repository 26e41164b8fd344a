"""Level sequences of trees and forests. A level sequence contains the level of each vertex as one byte, in
preorder.

Roots have level 0. A tree is a forest with one root.

Trees are printed in brackets: ``.`` is one vertex, and ``[..]`` is a root with two leaves. The trees of a
forest are separated by spaces. HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import pairwise
from math import factorial, prod

from orderconds.errors import InputError

Tree = bytes
Forest = bytes

_RAISED = bytes(range(1, 256)) + b"\xff"
_LOWERED = b"\x00" + bytes(range(255))
_LARGEST = 250


def trees_of(forest: Forest) -> tuple[Tree, ...]:
    r"""Return the trees of a forest.

    >>> trees_of(b"\0\1\0")
    (b'\x00\x01', b'\x00')
    """
    roots = [place for place, level in enumerate(forest) if level == 0]
    return tuple(forest[start:end] for start, end in pairwise([*roots, len(forest)]))


@lru_cache(maxsize=1 << 16)
def children(tree: Tree) -> tuple[Tree, ...]:
    r"""Return the subtrees below the root, from left to right.

    >>> children(b"\0\1\2\1")
    (b'\x00\x01', b'\x00')
    """
    return trees_of(branches(tree))


def branches(tree: Tree) -> Forest:
    r"""Return the forest that remains when the root is removed (Butcher's B-).

    >>> branches(b"\0\1\2\1")
    b'\x00\x01\x00'
    """
    return tree[1:].translate(_LOWERED)


def rooted_at_new_vertex(forest: Forest) -> Tree:
    r"""Return the tree with the branches ``forest`` (Butcher's B+).

    >>> rooted_at_new_vertex(b"\0\1\0")
    b'\x00\x01\x02\x01'
    """
    return b"\0" + forest.translate(_RAISED)


def density(forest: Forest) -> int:
    r"""Return the density gamma (HLW III.1, Definition 1.10).

    For each vertex, count the vertex itself and all its descendants. The density is the product of these
    counts.

    >>> density(b"\0\1\2\1")
    8
    """
    return prod([_density(tree) for tree in trees_of(forest)])


def symmetry(tree: Tree) -> int:
    r"""Return sigma, the order of the symmetry group of an unordered rooted tree (HLW III.1, Def. 1.7).

    The tree must be canonical (see :func:`canonical`), because equal subtrees are recognised by equal bytes.

    >>> symmetry(b"\0\1\1\1")
    6
    """
    below = children(tree)
    repeated = {child: below.count(child) for child in below}
    return prod(factorial(times) * symmetry(child) ** times for child, times in repeated.items())


def canonical(tree: Tree) -> Tree:
    r"""Return the canonical form of a tree. Branches are rearranged such that the level sequence becomes as
    great as possible in lexicographic order.

    >>> canonical(b"\0\1\1\2")
    b'\x00\x01\x02\x01'
    """
    ordered = sorted((canonical(child) for child in children(tree)), reverse=True)
    return rooted_at_new_vertex(b"".join(ordered))


def text(forest: Forest) -> str:
    r"""Return a tree or forest as text in brackets.

    >>> text(b"\0\1\2\1"), text(b"\0\1\0"), text(b"")
    ('[[.].]', '[.] .', '')
    """
    return " ".join(_bracket(tree) for tree in trees_of(forest))


def parse(written: str) -> Forest:
    r"""Parse a tree or forest in brackets. Spaces and commas between trees are optional.

    >>> parse("[[.],.]") == b"\0\1\2\1"
    True

    Raises :class:`~orderconds.errors.InputError` if there are more than 250 vertices, a character is not
    allowed, or brackets are empty or unbalanced.
    """
    levels, depth = bytearray(), 0
    compact = re.sub(r"[\s,]", "", written)
    for place, sign in enumerate(compact):
        before = compact[place - 1 : place]
        if sign in ".[":
            if len(levels) == _LARGEST:
                raise InputError("a tree is too large", expected=f"at most {_LARGEST} vertices")
            levels.append(depth)
            depth += sign == "["
        elif sign == "]" and depth and before != "[":
            depth -= 1
        else:
            raise InputError(
                f"{sign!r} in tree {written!r}", expected="dots and balanced brackets, such as [[.].]"
            )
    if depth:
        raise InputError(
            f"unbalanced brackets in tree {written!r}", expected="balanced brackets, such as [[.].]"
        )
    return bytes(levels)


@lru_cache(maxsize=1 << 16)
def _density(tree: Tree) -> int:
    return len(tree) * prod([_density(child) for child in children(tree)])


@lru_cache(maxsize=1 << 16)
def _bracket(tree: Tree) -> str:
    below = children(tree)
    return f"[{''.join(_bracket(child) for child in below)}]" if below else "."
