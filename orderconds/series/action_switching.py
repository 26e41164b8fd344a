"""Root switching: trees that are one unrooted tree have one condition, whatever the method.

A force that hangs on the root vertex can be made the root instead: ``o(w | M, H(u*v | N))`` and ``o(u o(w |
M) v | N)`` have equal coefficients, for every method and for the flow, because the sum over the stages of
the edge between them may be taken last. So one tree of each class decides.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from orderconds.series.action_trees import Force, Velocity, force, velocities, velocity


def switched(tree: Velocity) -> Iterator[Velocity]:
    """Yield the trees whose root is a neighbour, along a force, of this tree's.

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
def representatives(vertices: int) -> tuple[Velocity, ...]:
    """Return the simplest tree of each class of trees that root switching connects.

    >>> [len(representatives(n)) for n in range(1, 6)]
    [1, 2, 10, 58, 398]
    """
    seen: set[Velocity] = set()
    simplest = []
    for tree in velocities(vertices):
        if tree not in seen:
            simplest.append(tree)
            seen.add(tree)
            waiting = [tree]
            while waiting:
                for other in switched(waiting.pop()):
                    if other not in seen:
                        seen.add(other)
                        waiting.append(other)
    return tuple(simplest)
