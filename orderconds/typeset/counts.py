"""A text that gives the number of order conditions of each order, and their sum."""

from __future__ import annotations

from collections.abc import Sequence


def sum_of_counts(counts: Sequence[int]) -> str:
    """Return the numbers of conditions of orders 1, 2, ... and their sum, as text.

    >>> sum_of_counts([1, 1, 6])
    '1 + 1 + 6 = 8 conditions of orders 1 to 3'
    >>> sum_of_counts([1])
    '1 condition of order 1'
    """
    if len(counts) == 1:
        return f"{counts[0]} condition{'' if counts[0] == 1 else 's'} of order 1"
    return f"{' + '.join(map(str, counts))} = {sum(counts)} conditions of orders 1 to {len(counts)}"
