"""Python numbers as coefficients: no rounded number counts as exact."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from orderconds.tableau.python_numbers import coefficient


@pytest.mark.parametrize(
    ("kind", "x"),
    [
        (np.float16, Fraction(7, 10)),
        (np.float16, Fraction(-11, 10)),
        (np.float16, Fraction(4, 3)),
        (np.float32, Fraction(4, 3)),
        (np.float32, Fraction(300001, 3)),
    ],
)
def test_a_rounded_narrow_float_is_a_rounded_decimal(kind: type[np.floating], x: Fraction) -> None:
    text = coefficient(kind(float(x)), "b[1]")
    assert isinstance(text, str)
    assert text.endswith("~")
    decimals = text.removesuffix("~").partition(".")[2]
    # The radius of a rounded decimal is one unit of its last digit.
    assert abs(Fraction(text.removesuffix("~")) - x) <= Fraction(1, 10 ** len(decimals))


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64])
@pytest.mark.parametrize("x", [Fraction(1, 2), Fraction(-3, 4), Fraction(5, 16), Fraction(3), Fraction(0)])
def test_a_narrow_float_with_few_bits_is_exact(kind: type[np.floating], x: Fraction) -> None:
    assert Fraction(coefficient(kind(float(x)), "b[1]")) == x
