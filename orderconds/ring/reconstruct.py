"""Reconstruction of rational numbers from their residues modulo primes."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt, prod


def rational_number(residues: Sequence[int], primes: Sequence[int]) -> Fraction:
    """Return the fraction p/q with the given residues modulo the primes, one residue for each prime.

    The result is the only such fraction with |p| <= sqrt(M/2) and 0 < q <= sqrt(M/2), where M is the product
    of the primes. Raises ArithmeticError if there is no such fraction.

    The fraction is computed by Euclid's algorithm (von zur Gathen and Gerhard, *Modern Computer Algebra*,
    Section 5.10).

    >>> primes = (10007, 10009)
    >>> print(rational_number([-5 * pow(12, -1, p) % p for p in primes], primes))
    -5/12
    """
    modulus = prod(primes)
    value = sum(x * (modulus // p) * pow(modulus // p, -1, p) for x, p in zip(residues, primes, strict=True))
    bound = isqrt(modulus // 2)
    r, t = (modulus, value % modulus), (0, 1)
    while r[1] > bound:
        quotient = r[0] // r[1]
        r, t = (r[1], r[0] - quotient * r[1]), (t[1], t[0] - quotient * t[1])
    if not 0 < abs(t[1]) <= bound:
        raise ArithmeticError(
            f"no fraction within the bounds has residues {list(residues)} modulo {list(primes)}"
        )
    return Fraction(r[1], t[1])
