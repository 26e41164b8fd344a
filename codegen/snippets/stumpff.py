"""Evaluation of Stumpff functions for z >= 0: the intervals of z, and the coefficients of polynomials.

The Stumpff functions are defined by the series c_k(z) = sum_j (-z)^j/(2j+k)!. The closed forms are

    c_0 = cos sqrt z,   c_1 = sin(sqrt z)/sqrt z,
    c_2 = (1 - cos sqrt z)/z,   c_3 = (sqrt z - sin sqrt z)/z^(3/2).

If z <= SWITCH[k], c_k is evaluated by a polynomial. If z > SWITCH[k], c_0 and c_1 are evaluated by their
closed forms. The closed forms of c_2 and c_3 suffer from cancellation. Instead, the formulas c_2(z) =
c_1(z/4)^2/2 and c_3(z) = (1 - c_1(z))/z are used. :data:`ROUNDINGS` bounds the errors. For z above
:func:`limit`, c_k(z) is NaN.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import factorial

from codegen.ir.precision import DOUBLE, Precision

SWITCH = (1, 1, 1, 4)
"""For 0 <= z <= SWITCH[k], c_k(z) is evaluated by a polynomial."""

ROUNDINGS = (3, 3, 5, 4)
"""The error of c_k(z) is at most max |c_k(z +- u) - c_k(z)| + ROUNDINGS[k] r |c_k(z)|.

Here r is the unit roundoff, and u is 3/2 units in the last place of z. The first term bounds the effect of
the rounding error of sqrt z, because a change of z by u changes sqrt z by more than this rounding error.
The second term bounds the other rounding errors to first order in r, if the errors of sine and cosine are at
most r. For example, the error of c_1(z/4) from a sine and a division is at most 2 r |c_1(z/4)|. The formula
c_2(z) = c_1(z/4)^2/2 squares c_1(z/4). The square doubles the relative error 2 r, and its rounding error adds
r. The sum is 5 r, so ROUNDINGS[2] is 5.
"""

SMALL, TINY = Fraction(1, 16), Fraction(1, 256)
"""For 0 <= z <= SMALL, a short polynomial approximates the Stumpff function c_k(z).

For 0 <= z <= TINY, there is an even shorter polynomial.
"""

PI = Fraction("3.14159265358979323846264338327950288")


SETS = tuple(orders for n in range(1, 5) for orders in combinations(range(4), n))
"""All non-empty sets of the indices 0, 1, 2 and 3 of the functions c_k."""


LEFT = 10
"""The error of the last rotation in a chain of rotations should be at most about 2^-LEFT.

In a chain, each angle except the first is computed from the result of the preceding rotation. The function
:func:`limit` limits the angles to keep the error below this bound. In long chains, the error can be larger.
"""


def limit(precision: Precision = DOUBLE, chain: int = 1) -> float:
    """Return the largest z for which the Stumpff functions c_k(z) are computed.

    For z above the returned limit, c_k(z) is NaN. For a rotation by the angle a, z is a^2.

    A chain is a sequence of ``chain`` rotations. The angle of each rotation except the first is computed from
    the result of the preceding rotation (:func:`codegen.ir.angle_depth.chain`). Rounding errors grow along
    the chain. If all angles are at most a, the error of the last rotation is at most about

        a^chain 8^(chain-1) 2^-bits,   with bits = ``precision.bits``.

    Let m be the largest integer for which this bound with a = 2^m is at most 2^-LEFT (:data:`LEFT`).
    A momentum that is computed with one rotation by the angle a has a larger error than the rotation: about
    a^2 2^-bits. Therefore, if m > floor(2*bits/5), m is reduced to floor(2*bits/5). Then the error of the
    momentum is at most about 2^(-bits/5). If m < floor(bits/6), m is increased to floor(bits/6), because the
    bound overestimates the error of long chains. The result is 4^m, the square of the angle 2^m.

    >>> [limit(DOUBLE, n) ** 0.5 for n in (1, 2, 3, 4, 9)]
    [2097152.0, 1048576.0, 4096.0, 256.0, 256.0]
    """
    bits = precision.bits
    power = (bits - LEFT - 3 * (chain - 1)) // chain
    return 2.0 ** (2 * max(bits // 6, min(2 * bits // 5, power)))


def coefficients(k: int, last: Fraction | int | None = None, bits: int = 53) -> tuple[Fraction, ...]:
    """Return the coefficients of a Taylor polynomial of c_k that is accurate from z = 0 to z = ``last``.

    At z = ``last``, the absolute value of the first omitted term is at most c_k(0) / 2^(bits + 3). The
    default of ``last`` is SWITCH[k].

    >>> coefficients(1)[:3], len(coefficients(1)), len(coefficients(1, SMALL))
    ((Fraction(1, 1), Fraction(-1, 6), Fraction(1, 120)), 9, 6)
    >>> len(coefficients(1, bits=24))
    6
    """
    z = Fraction(SWITCH[k] if last is None else last)
    terms: list[Fraction] = []
    while abs(term := Fraction((-1) ** (j := len(terms)), factorial(2 * j + k))) * z**j * factorial(k) > (
        Fraction(1, 2 ** (bits + 3))
    ):
        terms.append(term)
    return tuple(terms)


def economised(k: int, last: Fraction, bits: int = 53) -> tuple[Fraction, ...]:
    """Return the coefficients of a short polynomial for c_k on 0 <= z <= ``last``.

    The error is at most about 2^-(bits + 4) c_k(0). To lower the degree of the Taylor polynomial, multiples
    of shifted Chebyshev polynomials are subtracted. The value at z = 0 is exact.

    >>> [len(economised(1, last)) for last in (TINY, SMALL)]
    [4, 6]
    """
    terms = list(coefficients(k, last, bits + 6))
    spent, allowance = Fraction(0), Fraction(1, 2 ** (bits + 4) * factorial(k))
    while True:
        shift = _cosine(PI / (2 * (len(terms) - 1)))
        stretched = _chebyshev(len(terms) - 1, (1 + shift) / last, -shift)
        multiple = terms[-1] / stretched[-1]
        spent += abs(multiple)
        if spent > allowance:
            return tuple(terms)
        terms = [t - multiple * s for t, s in zip(terms[:-1], (Fraction(0), *stretched[1:-1]), strict=True)]


def _cosine(x: Fraction) -> Fraction:
    """Return cos(x) with about thirty correct digits."""
    value = sum(((-1) ** j * x ** (2 * j) / factorial(2 * j) for j in range(16)), Fraction(0))
    return Fraction(round(value * 10**34), 10**34)


def _chebyshev(n: int, slope: Fraction, shift: Fraction) -> list[Fraction]:
    """Return the coefficients of the Chebyshev polynomial T_n(slope z + shift) in powers of z."""
    none = Fraction(0)
    before, now = [Fraction(1)], [shift, slope]
    for _ in range(n - 1):
        lifted = [shift * a + slope * b for a, b in zip([*now, none], [none, *now], strict=True)]
        before, now = now, [2 * a - b for a, b in zip(lifted, [*before, none, none], strict=True)]
    return now


def constants(k: int, last: Fraction | int | None = None, precision: Precision = DOUBLE) -> tuple[float, ...]:
    """Return the result of :func:`coefficients`, rounded to the given floating-point precision."""
    return tuple(precision.round(c) for c in coefficients(k, last, precision.bits))


def curvatures(k: int, precision: Precision = DOUBLE) -> tuple[float, ...]:
    """Return the coefficients of a Taylor polynomial for c_k''(z) on 0 <= z <= 1.

    >>> [round(1 / x) for x in curvatures(2)[:2]]
    [360, -6720]
    """
    terms = coefficients(k, 1, precision.bits + 8)
    return tuple(precision.round((j + 1) * (j + 2) * c) for j, c in enumerate(terms[2:]))


def slopes(k: int, precision: Precision = DOUBLE) -> tuple[float, ...]:
    """Return the coefficients of a Taylor polynomial of the first derivative of c_k, for z from -1 to 1.

    >>> [1 / x for x in slopes(2)[:2]]
    [-24.0, 360.0]
    """
    terms = coefficients(k, 1, precision.bits)
    return tuple(precision.round((j + 1) * c) for j, c in enumerate(terms[1:]))
