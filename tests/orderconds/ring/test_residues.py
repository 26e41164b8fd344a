"""Residues: each sample is the image of a rational number."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from orderconds.ring.residues import PRIMES, Residues

RING = Residues(101, 4)


def images(values: list[Fraction], prime: int) -> list[int]:
    return [q.numerator * pow(q.denominator, -1, prime) % prime for q in values]


def test_the_primes_are_the_two_largest_below_two_to_the_31() -> None:
    def is_prime(n: int) -> bool:
        return all(n % k for k in range(2, int(n**0.5) + 1))

    primes = [n for n in range(2**31 - 1, 2**31 - 20, -1) if is_prime(n)]
    assert tuple(primes[:2]) == PRIMES


@pytest.mark.parametrize("prime", [101, *PRIMES])
def test_arithmetic_is_that_of_the_images_of_rationals(prime: int) -> None:
    ring = Residues(prime, 3)
    p = [Fraction(1, 2), Fraction(-7, 3), Fraction(5)]
    q = [Fraction(4, 9), Fraction(2), Fraction(-1, 8)]
    x, y = (ring.element(np.array(images(values, prime))) for values in (p, q))
    for found, exact in (
        (x + y, [a + b for a, b in zip(p, q, strict=True)]),
        (x - y, [a - b for a, b in zip(p, q, strict=True)]),
        (x * y, [a * b for a, b in zip(p, q, strict=True)]),
        (x / y, [a / b for a, b in zip(p, q, strict=True)]),
        (3 - x, [3 - a for a in p]),
        (2 / x, [2 / a for a in p]),
        (x**5, [a**5 for a in p]),
        (x**-2, [a**-2 for a in p]),
    ):
        assert list(ring.key(found)) == images(exact, prime)


def test_products_of_the_largest_residues_do_not_overflow() -> None:
    ring = Residues(PRIMES[0], 1)
    assert ring.rational(-1) * ring.rational(-1) == ring.one
    assert ring.rational(-1) * ring.rational(-2) == ring.rational(2)


def test_a_sample_that_is_zero_does_not_divide() -> None:
    with pytest.raises(ZeroDivisionError):
        RING.one / RING.element(np.array([1, 2, 0, 3]))
    with pytest.raises(ZeroDivisionError):
        RING.rational(1, 101)


@pytest.mark.parametrize("prime", [2, 2**31])
def test_primes_out_of_range_are_refused(prime: int) -> None:
    with pytest.raises(ValueError, match="prime"):
        Residues(prime, 1)
