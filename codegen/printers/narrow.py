"""An order of statements that holds few values at a time.

A compiler keeps the order of statements, and what does not fit its sixteen registers goes to memory and comes
back. Here the next statement is always the one after which the fewest values wait to be read; of equals, the
one that reads what was made last. Stages of a method then stand one after the other, as a person would write
them.
"""

from __future__ import annotations

from collections.abc import Sequence, Set


def narrowed(made: Sequence[Sequence[str]], read: Sequence[Set[str]], after: Set[str]) -> tuple[int, ...]:
    """Return the places of statements in that order.

    ``made`` are the names that each gives values, ``read`` those that it reads, ``after`` those read when all
    are done. Each stands after those that it reads from, so that no value changes.

    >>> narrowed([["a"], ["b"], ["x"], ["y"]], [set(), set(), {"a"}, {"b"}], {"x", "y"})
    (0, 2, 1, 3)
    """
    maker = {name: k for k, names in enumerate(made) for name in names}
    sources = [sorted({maker[name] for name in names if name in maker}) for names in read]
    readers: list[list[int]] = [[] for _ in made]
    for k, found in enumerate(sources):
        for source in found:
            readers[source].append(k)
    unread = [len(r) + any(n in after for n in names) for r, names in zip(readers, made, strict=True)]
    waiting = [len(found) for found in sources]
    ready = [k for k, n in enumerate(waiting) if n == 0]
    place = [0] * len(made)
    order: list[int] = []

    def cost(k: int) -> tuple[int, int, int]:
        held = len(made[k]) * (unread[k] > 0) - sum(unread[source] == 1 for source in sources[k])
        return held, -max((place[source] for source in sources[k]), default=0), k

    while ready:
        best = min(ready, key=cost)
        ready.remove(best)
        order.append(best)
        place[best] = len(order)
        for source in sources[best]:
            unread[source] -= 1
        for reader in readers[best]:
            waiting[reader] -= 1
            if waiting[reader] == 0:
                ready.append(reader)
    return tuple(order)
