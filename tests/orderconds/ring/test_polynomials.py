"""Polynomials in named variables: texts and keys."""

from __future__ import annotations

import pytest

from orderconds.ring import QQ, Polynomials

RING = Polynomials(["x", "y"])
X, Y = RING.generators


@pytest.mark.parametrize(
    ("element", "text"),
    [
        (RING.zero, "0"),
        (RING.one, "1"),
        (-X, "-x"),
        (X * Y * 2 - Y / 3 + 1, "2*x*y - 1/3*y + 1"),
        ((X - Y) * (X - Y), "x^2 - 2*x*y + y^2"),
        (RING.rational(-5, 7) * X, "-5/7*x"),
    ],
)
def test_texts_are_expanded_with_the_leading_term_first(element: object, text: str) -> None:
    assert RING.text(element) == text


def test_terms_rebuild_the_polynomial() -> None:
    p = (X + 2 * Y) ** 3 - X * Y / 4
    total = sum((c * X**i * Y**j for (i, j), c in RING.terms(p)), RING.zero)
    assert total == p


def test_equal_polynomials_have_equal_keys_and_different_ones_have_not() -> None:
    assert RING.key((X + Y) ** 2) == RING.key(X * X + 2 * X * Y + Y * Y)
    assert RING.key(X) != RING.key(Y)


def test_a_variable_is_found_by_its_name_and_rings_are_equal_by_their_names() -> None:
    assert RING.generator("y") == Y
    assert Polynomials(["x", "y"]) == RING != Polynomials(["y", "x"])


def test_decimals_replace_coefficients_only() -> None:
    assert RING.approximate(X / 3 - Y / 8, 4) == "0.3333*x - 0.125*y"
    assert RING.is_zero(X * QQ.zero)
