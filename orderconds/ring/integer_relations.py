"""Lattice reduction that finds integer relations between approximate numbers.

An integer relation of numbers x_k is an equation sum_k c_k x_k = 0 with integers c_k. Let N be a large
number, and let e_k be the unit vectors. The vectors (e_k, N x_k), with N x_k rounded to an integer, span a
lattice. A relation with small integers c_k gives a short vector of the lattice. The algorithm of Lenstra,
Lenstra and Lovasz (1982) finds short vectors. The numbers are approximate, so each relation that the
algorithm finds must be proved.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

from flint import fmpz, fmpz_mat

GUARD = 6
"""A safety margin in bits. The probability that :func:`relation` finds a false relation between random
numbers is at most about 2^-GUARD."""


def relation(values: Sequence[Fraction], bits: int) -> list[int] | None:
    """Return small integers c_k such that the absolute value of sum_k c_k x_k is a small multiple of 2^-bits.

    The x_k are the numbers in ``values``. Return None if no such integers are found.

    >>> root = Fraction(2**0.5)
    >>> relation([root / 2 - 1, Fraction(1), root], 50)
    [-2, -2, 1]
    """
    scale = 2**bits
    rows = [[int(k == j) for j in range(len(values))] + [round(x * scale)] for k, x in enumerate(values)]
    reduced = fmpz_mat(rows).lll()
    shortest = [int(reduced[0, k]) for k in range(len(values) + 1)]
    longest = max(map(abs, shortest)).bit_length()
    return shortest[:-1] if longest * len(values) + GUARD <= bits else None


def square_free_part(n: int) -> int:
    """Return the square-free d with n = d k^2, for n > 0.

    >>> square_free_part(12), square_free_part(5)
    (3, 5)
    """
    free = 1
    for prime, power in fmpz(n).factor():
        free *= int(prime) ** (power % 2)
    return free


def root_of(d: int, bits: int) -> Fraction:
    """Return the square root of the integer d, rounded down to ``bits`` binary places after the point.

    >>> root_of(9, 10)
    Fraction(3, 1)
    """
    return Fraction(isqrt(d << 2 * bits), 1 << bits)


def quadratic_field(x: Fraction, bits: int) -> int | None:
    """Let y be the unknown number that x approximates. Return a square-free integer d > 1 such that probably
    y = u + v sqrt(d) with rational numbers u and v.

    Search for a quadratic polynomial p with small integer coefficients such that |p(x)| is at most a small
    multiple of 2^-bits. The roots of p are irrational elements of Q(sqrt(d)). Return None if no polynomial p
    is found.

    >>> quadratic_field(Fraction(0.25 - 3**0.5 / 6), 50)
    3
    """
    coefficients = relation([Fraction(1), x, x * x], bits)
    if coefficients is None or not coefficients[2]:
        return None
    c, b, a = coefficients
    discriminant = b * b - 4 * a * c
    if discriminant <= 0 or isqrt(discriminant) ** 2 == discriminant:
        return None
    return square_free_part(discriminant)


def simplest(low: Fraction, high: Fraction) -> Fraction:
    """Among the fractions in the interval [low, high], return one with the smallest denominator.

    >>> simplest(Fraction(31, 100), Fraction(34, 100))
    Fraction(1, 3)
    """
    terms: list[int] = []
    while True:
        whole = low.numerator // low.denominator
        if whole == low or whole + 1 <= high:
            terms.append(whole if whole == low else whole + 1)
            break
        terms.append(whole)
        low, high = 1 / (high - whole), 1 / (low - whole)
    value = Fraction(terms[-1])
    for term in reversed(terms[:-1]):
        value = term + 1 / value
    return value
