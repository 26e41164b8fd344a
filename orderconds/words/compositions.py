"""Compositions of an integer n: sequences of positive integers with the sum n."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, pairwise


def compositions(n: int) -> Iterator[tuple[int, ...]]:
    """Yield all sequences of positive integers with the sum n. Sequences with few parts come first.

    >>> list(compositions(3))
    [(3,), (1, 2), (2, 1), (1, 1, 1)]
    """
    for parts in range(1, n + 1):
        for cuts in combinations(range(1, n), parts - 1):
            yield tuple(end - start for start, end in pairwise((0, *cuts, n)))
