"""Ranks modulo a prime agree with ranks over Q, and combinations reproduce their columns."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from orderconds.ring import Residues
from orderconds.ring.rank import combinations, pivot_columns
from orderconds.ring.rational_matrix import rank

RING = Residues(10007, 6)


def columns(seed: int) -> list[list[int]]:
    """Eight columns of small integers, every third a combination of the two before it."""
    numbers = np.random.default_rng(seed)
    found: list[list[int]] = []
    for place in range(8):
        if place % 3 == 2:
            found.append([2 * x - 3 * y for x, y in zip(found[-1], found[-2], strict=True)])
        else:
            found.append([int(x) for x in numbers.integers(-9, 9, 6)])
    return found


@pytest.mark.parametrize("seed", range(6))
def test_pivots_are_where_the_rank_over_q_grows(seed: int) -> None:
    rows = columns(seed)
    ranks = [rank([[Fraction(x) for x in row] for row in rows[:n]]) for n in range(len(rows) + 1)]
    growing = tuple(n for n in range(len(rows)) if ranks[n + 1] > ranks[n])
    assert pivot_columns([RING.element(np.array(row)) for row in rows]) == growing


@pytest.mark.parametrize("seed", range(6))
def test_combinations_give_the_other_columns(seed: int) -> None:
    elements = [RING.element(np.array(row)) for row in columns(seed)]
    pivots, dependent = pivot_columns(elements), combinations(elements)
    assert sorted([*pivots, *dependent]) == list(range(len(elements)))
    for place, scales in dependent.items():
        assert all(pivot < place for pivot in scales)
        total = sum((elements[pivot] * scale for pivot, scale in scales.items()), RING.zero)
        assert total == elements[place]


def test_no_columns_have_no_pivots() -> None:
    assert pivot_columns([]) == ()
    assert combinations([]) == {}
