"""Constants for functions that compute sine and cosine without branches.

A C compiler can vectorise loops that call these functions.

The reduced angle of an angle x is r = x - k pi/2, where k is the integer nearest to 2x/pi. To compute k
without a branch, the large constant ``round`` is added to 2x/pi, and is subtracted from the sum. ``round`` is
so large that the sum is rounded to an integer. The number pi/2 is stored as a sum of parts. All parts except
the last have few bits, so their products with k are exact. Polynomials for the Stumpff functions c_0 and c_1
(:func:`codegen.snippets.stumpff.economised`) give sin r = r c_1(r^2) and cos r = c_0(r^2).
"""

from __future__ import annotations

from fractions import Fraction

from codegen.ir.precision import DOUBLE, Precision
from codegen.snippets.stumpff import PI, economised

LARGEST = {53: 2**20, 24: 2**9}
"""The largest angle for which the helpers ``sin_near`` and ``cos_near`` do not return NaN.

The keys are the numbers of bits of the significand.
"""

_PARTS = {53: (31, 31, 31), 24: (12, 11, 11)}
_REDUCED = Fraction(5, 8)
"""An upper bound of r^2 for a reduced angle r. |r| is at most about pi/4, so r^2 is at most about 0.617."""


def reduction(precision: Precision = DOUBLE) -> dict[str, object]:
    """Return the constants for the reduction of an angle x, with their names as keys.

    - ``largest``: the largest angle that can be reduced.
    - ``per_quarter``: 2/pi.
    - ``parts``: numbers whose sum is pi/2.
    - ``round``: a constant c. Let y = 2x/pi. In floating-point arithmetic, (y + c) - c is the integer nearest
      to y.

    >>> constants = reduction()
    >>> constants["largest"], constants["round"], len(constants["parts"])
    (1048576.0, 6755399441055744.0, 4)
    """
    rest, parts = _half_pi(), []
    for bits in _PARTS[precision.bits]:
        unit = Fraction(2) ** (_exponent(rest) - bits)
        part = (rest // unit) * unit
        parts.append(float(part))
        rest -= part
    return {
        "largest": float(LARGEST[precision.bits]),
        "per_quarter": float(precision.round(Fraction(2) / PI)),
        "parts": [*parts, float(precision.round(rest))],
        "round": 1.5 * 2.0 ** (precision.bits - 1),
    }


def polynomial(k: int, precision: Precision = DOUBLE) -> list[float]:
    """Return the coefficients of a polynomial for the Stumpff function c_k, beginning with the constant term.

    The polynomial approximates c_k(z) for 0 <= z <= 5/8.
    """
    return [float(precision.round(c)) for c in economised(k, _REDUCED, precision.bits)]


def _half_pi() -> Fraction:
    """Return pi/2 with an error below 2^-160 (Machin's formula)."""

    def arctangent(n: int) -> Fraction:
        return sum((Fraction((-1) ** j, (2 * j + 1) * n ** (2 * j + 1)) for j in range(80)), Fraction(0))

    return 2 * (4 * arctangent(5) - arctangent(239))


def _exponent(x: Fraction) -> int:
    """Return the smallest integer e such that x < 2^e, for x > 0."""
    e = x.numerator.bit_length() - x.denominator.bit_length() + 1
    while x < Fraction(2) ** (e - 1):
        e -= 1
    return e
