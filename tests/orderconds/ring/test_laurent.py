"""Laurent polynomials: ring laws, division by monomials, lowest terms."""

from __future__ import annotations

import itertools

import pytest

from orderconds.ring import QQ, Polynomials
from orderconds.ring.laurent import Laurent, LaurentPolynomials

RING = LaurentPolynomials(["x", "y"])
X, Y = RING.generators
ELEMENTS = [RING.zero, RING.one, X, X / Y + 2, (X + Y) / X - RING.rational(1, 3), X * X - Y / (X * X)]


def test_the_axioms_of_a_commutative_ring_hold() -> None:
    for x, y, z in itertools.product(ELEMENTS, repeat=3):
        assert (x + y) + z == x + (y + z)
        assert (x * y) * z == x * (y * z)
        assert x * y == y * x
        assert x * (y + z) == x * y + x * z
        assert x - x == RING.zero


@pytest.mark.parametrize("unit", [X, 3 * Y, X * X * Y / 2, RING.one / X, Y / X])
def test_monomials_are_units(unit: Laurent) -> None:
    for x in ELEMENTS:
        assert x / unit * unit == x
    assert RING.is_zero(unit * (RING.one / unit) - 1)


@pytest.mark.parametrize("x", [RING.zero, X + Y, RING.one + X])
def test_only_monomials_divide(x: Laurent) -> None:
    with pytest.raises(ZeroDivisionError, match="has no inverse"):
        RING.one / x


def test_equal_elements_have_equal_keys_and_texts() -> None:
    one_way, other = (X * X + X * Y) / (X * Y), X / Y + 1
    assert (one_way, RING.key(one_way), RING.text(one_way)) == (other, RING.key(other), RING.text(other))
    assert hash(one_way) == hash(other)
    assert RING.text(one_way) == "x*y^-1 + 1"


def test_values_at_a_point_are_those_of_the_formula() -> None:
    point = (QQ.rational(2, 3), QQ.rational(-5))
    for x, expected in (
        (X / Y + 2, point[0] / point[1] + 2),
        ((X + Y) / X, (point[0] + point[1]) / point[0]),
    ):
        value = sum((c * point[0] ** i * point[1] ** j for (i, j), c in RING.terms(x)), QQ.zero)
        assert value == expected


def test_without_denominators_the_texts_are_those_of_polynomials() -> None:
    plain = Polynomials(["x", "y"])
    x, y = plain.generators
    assert RING.text((X + Y) * (X - 2 * Y)) == plain.text((x + y) * (x - 2 * y))
