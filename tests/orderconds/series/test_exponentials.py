"""Words in products of exponentials: group-like, and equal to products of series."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import product

from orderconds.ring import QQ
from orderconds.series.exponentials import ProductOfExponentials
from orderconds.words.shuffle import Series, concatenate, exponential, shuffle

LENGTH = 5
LETTERS = (0, 1)


def random_exponents(seed: int) -> list[dict[int, Fraction]]:
    numbers = random.Random(seed)
    return [{k: Fraction(numbers.randint(-5, 5), numbers.randint(1, 4)) for k in LETTERS} for _ in range(3)]


def values_of(exponents: list[dict[int, Fraction]]) -> ProductOfExponentials:
    def letter(J: int, k: int) -> object:
        x = exponents[J][k]
        return QQ.rational(x.numerator, x.denominator) if x else None

    return ProductOfExponentials(QQ, len(exponents), letter)


def test_values_are_those_of_the_product_of_exponential_series() -> None:
    exponents = random_exponents(1)
    expected: Series = {(): Fraction(1)}
    for exponent in exponents:
        # A word is in the order of action, so that the first exponential takes its first letters.
        factor = exponential({(k,): x for k, x in exponent.items() if x}, LENGTH)
        expected = concatenate(expected, factor, LENGTH)
    values = values_of(exponents)
    for n in range(LENGTH + 1):
        for word in product(LETTERS, repeat=n):
            assert Fraction(str(values(word))) == expected.get(word, 0), word


def test_values_multiply_over_shuffles() -> None:
    values = values_of(random_exponents(2))
    for u, v in product(product(LETTERS, repeat=2), product(LETTERS, repeat=3)):
        shuffled = sum((times * values(word) for word, times in shuffle(u, v).items()), QQ.zero)
        assert shuffled == values(u) * values(v)


def test_a_letter_that_is_zero_by_construction_and_a_zero_coefficient_agree() -> None:
    sparse = ProductOfExponentials(QQ, 2, lambda J, k: QQ.one if k == J else None)
    full = ProductOfExponentials(QQ, 2, lambda J, k: QQ.one if k == J else QQ.zero)
    for n in range(5):
        assert all(sparse(word) == full(word) for word in product(LETTERS, repeat=n))
