"""Numbers with sizes: equal numbers cancel up to rounding, whatever their units are."""

from __future__ import annotations

import pytest

from codegen.ir.rounding_domain import RoundingDomain

D = RoundingDomain(0, 40)


def vanishes(x):
    return abs(x.value) <= D.rounding(x)


@pytest.mark.parametrize("unit", [1, 10**40])
def test_only_cancellation_to_rounding_errors_counts_as_zero(unit):
    x, y = D.rational(1, 7 * unit), D.rational(3, 11 * unit)
    square = (x + y) * (x + y) - x * x - 2 * (x * y) - y * y
    assert vanishes(square)
    assert not vanishes(square + x * x / 10**20)
    assert not vanishes(x * y)
    assert vanishes(0 * x)
    assert not vanishes(-x)


@pytest.mark.parametrize("function", ["sin", "exp", "stumpff1"])
def test_functions_pass_the_rounding_errors_of_their_arguments_on(function):
    x = D.rational(1, 3)
    difference = D.call(function, x * x / x) - D.call(function, x)
    assert vanishes(difference)
    assert vanishes(difference * 10**30)
    assert not vanishes(difference + D.rational(1, 10**20))


def test_the_edge_of_a_domain_has_a_size():
    half = D.rational(1, 3) + D.rational(1, 6)
    edge = D.call("acos", half + half)
    assert vanishes(edge)
    assert not vanishes(D.call("acos", half))


def test_the_inverse_of_a_matrix_has_sizes():
    a, b, c, d = (D.rational(k, 7) for k in (1, 2, 3, 5))
    p, q, r, s = D.vector("inverse2", (a, b, c, d))
    assert vanishes(a * p + b * r - 1)
    assert vanishes(a * q + b * s)
    assert not vanishes(a * p + b * r - 1 + D.rational(1, 10**20))


def test_the_changes_of_two_arguments_do_not_cancel():
    """The result x_i - x_j of a vector function keeps the sizes of both arguments, for all i and j."""
    domain = RoundingDomain(0, 40)
    third = domain.rational(1, 3)
    for j in range(1, 40):
        domain.plain.vector = lambda _, x, j=j: (x[0] - x[j],)
        (difference,) = domain.vector("any", [third] * 40)
        assert difference.value == 0
        assert difference.size > 0.01 * third.size
