"""Polynomials in time: integrals, derivatives and values."""

from __future__ import annotations

from fractions import Fraction

import pytest

from orderconds.ring.univariate import (
    ONE,
    VARIABLE,
    ZERO,
    derivative,
    integral_from_zero,
    integral_to_one,
    value_at_one,
)

POLYNOMIALS = [ZERO, ONE, VARIABLE, 3 * VARIABLE**4 - VARIABLE / 7 + 2]


@pytest.mark.parametrize("f", POLYNOMIALS, ids=str)
def test_differentiation_undoes_integration(f: object) -> None:
    assert derivative(integral_from_zero(f)) == f
    assert derivative(integral_to_one(f)) == -f


@pytest.mark.parametrize("f", POLYNOMIALS, ids=str)
def test_both_integrals_add_up_to_that_over_the_unit_interval(f: object) -> None:
    whole = value_at_one(integral_from_zero(f))
    both = integral_from_zero(f) + integral_to_one(f)
    assert both.degree() <= 0
    assert value_at_one(both) == whole
    assert value_at_one(integral_to_one(f)) == 0


def test_iterated_integrals_of_one_are_reciprocals_of_factorials() -> None:
    f = ONE
    for n in range(1, 8):
        f = integral_from_zero(f)
        assert value_at_one(f) * n == value_at_one(derivative(f))
    assert value_at_one(f) == Fraction(1, 5040)
