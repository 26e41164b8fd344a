"""Quadratic forms as sums of squares, in rational numbers."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from codegen.flows.quadratic_form import isotropic_part, shifted, squares


def symmetric(seed, n=3):
    rng = random.Random(seed)
    rows = [[Fraction(0)] * n for _ in range(n)]
    for i in range(n):
        for j in range(i, n):
            rows[i][j] = rows[j][i] = Fraction(rng.randint(-3, 3), rng.randint(1, 3))
    return rows


def total(terms, n):
    return [[sum((d * e[i] * e[j] for d, e in terms), Fraction(0)) for j in range(n)] for i in range(n)]


@pytest.mark.parametrize("n", [1, 2, 3, 4])
@pytest.mark.parametrize("seed", range(8))
def test_the_squares_add_up_to_the_form(seed, n):
    B = symmetric(seed, n)
    terms = squares(B)
    assert total(terms, n) == B
    assert len(terms) <= n


@pytest.mark.parametrize("diagonal", [(1, 2, 3), (-1, 2, 5), (1, 1, 1), (0, 0, 1)])
def test_small_diagonal_entries_do_not_make_large_squares(diagonal):
    """Flows of large squares that cancel would make a splitting inaccurate."""
    n = 3
    B = [
        [Fraction(x, 10**8) if i == j else Fraction(1 + i + j) for j in range(n)]
        for i, x in enumerate(diagonal)
    ]
    terms = squares(B)
    assert total(terms, n) == B
    assert max(abs(d * x * y) for d, e in terms for x in e for y in e) < 40


def test_a_form_without_diagonal_is_a_difference_of_squares():
    B = [[Fraction(0), Fraction(3)], [Fraction(3), Fraction(0)]]
    assert [d for d, _ in squares(B)] == [Fraction(3, 2), Fraction(-3, 2)]


@pytest.mark.parametrize("axis", [(1, 0, 0), (1, 1, 1), (1, -2, 3)])
def test_a_symmetric_top_is_isotropic_but_for_one_square(axis):
    B = [[Fraction(5 * int(i == j) + 2 * x * y) for j, y in enumerate(axis)] for i, x in enumerate(axis)]
    assert isotropic_part(B) == 5
    assert len(squares(shifted(B, Fraction(5)))) == 1


def test_a_diagonal_form_leaves_its_middle_entry():
    B = [[Fraction(x if i == j else 0) for j in range(3)] for i, x in enumerate((4, 1, 2))]
    assert isotropic_part(B) == 2


def test_the_form_is_not_changed():
    B = symmetric(1)
    before = [list(row) for row in B]
    squares(B)
    assert before == B
