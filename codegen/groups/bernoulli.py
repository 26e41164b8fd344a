"""The truncated series of dexp^{-1}_x: the sum of B_k/k! ad_x^k for k = 0, ..., order.

B_k are the Bernoulli numbers with B_1 = -1/2.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from math import comb, factorial

from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


@cache
def bernoulli_over_factorial(k: int) -> Fraction:
    """Return B_k/k!, the coefficient of ad^k in dexp^{-1}. B_k is a Bernoulli number, with B_1 = -1/2.

    >>> [str(bernoulli_over_factorial(k)) for k in range(5)]
    ['1', '-1/2', '1/12', '0', '-1/720']
    """
    values = [Fraction(1)]
    for m in range(1, k + 1):
        values.append(-sum((comb(m + 1, j) * values[j] for j in range(m)), Fraction(0)) / (m + 1))
    return values[k] / factorial(k)


def last_term(order: int) -> int:
    """Return the greatest k <= order whose Bernoulli number is not zero.

    >>> [last_term(order) for order in range(6)]
    [0, 1, 2, 2, 4, 4]
    """
    return max(k for k in range(order + 1) if bernoulli_over_factorial(k))


def bernoulli_sum(
    d: Domain, advance: Callable[[Vector[S]], Vector[S]], first: Vector[S], order: int
) -> Vector[S]:
    """Return the sum of B_k/k! v_k for k = 0, ..., order.

    B_k are the Bernoulli numbers with B_1 = -1/2. Applying ``advance`` k times to ``first`` gives v_k.
    """
    total, power = first, first
    for k in range(1, last_term(order) + 1):
        power = advance(power)
        b = bernoulli_over_factorial(k)
        if b:
            factor: S = d.rational(b.numerator, b.denominator)
            total = tuple(s + factor * t for s, t in zip(total, power, strict=True))
    return total
