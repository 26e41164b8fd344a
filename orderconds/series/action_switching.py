"""Root switching: trees that differ only in the choice of the root have the same condition.

The module :mod:`orderconds.series.action_trees` defines the notation of trees. Let u, v and w be words of
trees, and let M and N be multisets of trees. The trees A and B are

- A: ``o(w | M, H(u*v | N))``,
- B: ``o(u o(w | M) v | N)``.

Both trees have a vertex a with the branches w and M, a vertex b with the branches u, v and N, and an edge
between a and b. In A, the vertex a is the root, b is denoted by H, and ``*`` marks the place of the edge
among the branches of b. In B, the vertex b is the root, and ``o(w | M)`` is at this place. For example, if
all words and multisets are empty, A is ``o(|H(*))``, and B is ``o(o)``.

In the left-hand side of each condition, one sum over the stages belongs to the vertex a, and one sum over
the stages belongs to the vertex b. In the conditions of A and B, only the order of these two sums is
different. Therefore the left-hand sides are equal. The right-hand sides are equal, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from orderconds.series.action_enumeration import velocities_in_turn
from orderconds.series.action_trees import Force, Velocity, force, velocity


def switched(tree: Velocity) -> Iterator[Velocity]:
    """Move the root to each neighbouring vertex, and yield the resulting trees. The same tree may be yielded
    several times.

    >>> list(switched(velocity((), (force(), force()))))
    [o(o(|f(*))), o(o(|f(*)))]
    """
    for k, p in enumerate(tree.momenta):
        if isinstance(p, Force):
            old_root = velocity(tree.word, tree.momenta[:k] + tree.momenta[k + 1 :])
            yield velocity((*p.before, old_root, *p.after), p.momenta)
    for k, letter in enumerate(tree.word):
        old_root_force = force(tree.word[:k], tree.word[k + 1 :], tree.momenta)
        yield velocity(letter.word, (*letter.momenta, old_root_force))


@cache
def classes(vertices: int) -> tuple[tuple[Velocity, ...], ...]:
    """Return all classes of trees with ``vertices`` vertices. The trees of one class differ only in the
    choice of the root. In each class, the first tree has the smallest sort key (the attribute ``key``).

    >>> classes(2)
    ((o(o), o(|f(*))), (o(|L(o)),))
    """
    return tuple(classes_in_turn(vertices))


def classes_in_turn(vertices: int) -> Iterator[tuple[Velocity, ...]]:
    """Yield all classes of trees with ``vertices`` vertices. The trees of one class differ only in the choice
    of the root. The class with the simplest tree is the first.

    >>> next(classes_in_turn(7))[0]
    o(o o o o o o)
    """
    listed, more = _listing(vertices)
    place = 0
    while True:
        if place == len(listed):
            of_class = next(more, None)
            if of_class is None:
                return
            listed.append(of_class)
        yield listed[place]
        place += 1


@cache
def _listing(vertices: int) -> tuple[list[tuple[Velocity, ...]], Iterator[tuple[Velocity, ...]]]:
    return [], _classes(vertices)


def _classes(vertices: int) -> Iterator[tuple[Velocity, ...]]:
    seen: set[Velocity] = set()
    for tree in velocities_in_turn(vertices):
        if tree not in seen:
            members = [tree]
            seen.add(tree)
            for member in members:  # The loop also visits the trees that it appends to ``members``.
                for other in switched(member):
                    if other not in seen:
                        seen.add(other)
                        members.append(other)
            yield tuple(members)


def representatives(vertices: int) -> tuple[Velocity, ...]:
    """Return the simplest tree of each class. A class contains the trees that differ only in the choice of
    the root.

    >>> [len(representatives(n)) for n in range(1, 6)]
    [1, 2, 10, 58, 398]
    """
    return tuple(of_class[0] for of_class in classes(vertices))
