"""Powers by squaring."""

from __future__ import annotations

from fractions import Fraction

import pytest

from orderconds.ring.power import power


@pytest.mark.parametrize("n", range(-9, 20))
def test_powers_are_repeated_products(n: int) -> None:
    x = Fraction(-3, 2)
    product = Fraction(1)
    for _ in range(abs(n)):
        product *= x if n > 0 else 1 / x
    assert power(x, n, Fraction(1)) == product


def test_the_power_zero_is_the_one_that_was_given() -> None:
    one = object()
    assert power(object(), 0, one) is one


def test_a_negative_power_of_zero_is_refused() -> None:
    with pytest.raises(ZeroDivisionError):
        power(Fraction(0), -1, Fraction(1))


def test_squaring_takes_few_products() -> None:
    class Counted:
        products = 0

        def __mul__(self, other: object) -> Counted:
            Counted.products += 1
            return self

    power(Counted(), 1000, Counted())
    assert Counted.products <= 2 * (1000).bit_length()
