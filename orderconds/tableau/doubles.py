"""Coefficients that are given as binary floating-point numbers (doubles).

A double is usually a rounded coefficient, such as 0.3333333333333333 for 1/3. In a tableau file, such a
coefficient ends with ``d``, as in ``0.3333333333333333d``. This text denotes a ball: an interval around the
double x. The radius of the ball is ``UNITS * 2^-53 * max(1, |x|)``. One rounding changes a number x by at
most ``2^-53 |x|``. The radius is larger than ``2^-53 |x|``, because many coefficients are computed with a few
roundings.

A double that needs at most :data:`SHORT` bits, such as 0.5, 3.0 or -0.375, counts as an exact number.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction

from orderconds.errors import TableauError

UNITS = 8
"""A double x represents a ball (interval) around x. This number is the default radius of the ball, in units
of 2^-53 max(1, |x|)."""

ROUNDING = Fraction(1, 2**53)
"""The largest relative error of rounding a number to a double."""

SHORT = 26
"""A double with at most this number of significant bits counts as an exact number."""

PRINTED = 16
"""A decimal from another program is not treated as a double if it has fewer digits than this number."""

LARGE = 64
"""A double counts as an exact number only if its numerator and denominator have at most this number of bits.
With more bits, the exact decimal would be too long."""

LONGEST = 1200
"""An upper bound of the number of significant decimal digits of a double."""

_DOUBLE = re.compile(r"-?(?:\d+\.?\d*|\.\d+)d", re.ASCII)


def radius(value: Fraction, units: Fraction | int = UNITS) -> Fraction:
    """Return the radius of the ball that the double ``value`` denotes: ``units * 2^-53 * max(1, |value|)``.

    >>> float(radius(Fraction(1, 2))) == 8 * 2.0**-53, radius(Fraction(4)) == 4 * radius(Fraction(1))
    (True, True)
    """
    return units * ROUNDING * max(Fraction(1), abs(value))


def double_text(x: float, where: str = "") -> str:
    """Return a double as the text of a coefficient. A double that counts as an exact number
    (:func:`is_short`) is written without suffix. Every other double is written with the suffix ``d``.

    Raises :class:`~orderconds.errors.TableauError`, whose message contains ``where``, if x is not finite.

    >>> [double_text(x) for x in (0.5, -3.0, 0.0, 1 / 3, 0.1, 1e-05)]
    ['0.5', '-3', '0', '0.3333333333333333d', '0.1d', '0.00001d']
    """
    if not math.isfinite(x):
        raise TableauError(f"the number {x}", where=where, expected="a finite number")
    if is_short(x):
        return f"{Decimal(x):f}" if x else "0"
    return f"{Decimal(repr(x)):f}d"


def is_double(text: str | int) -> bool:
    """Return True if a coefficient is a decimal with the suffix ``d``, which denotes a double.

    >>> is_double("-0.1d"), is_double("1/3"), is_double(1)
    (True, False, False)
    """
    return isinstance(text, str) and _DOUBLE.fullmatch(text) is not None


def decimal_text(text: str) -> str:
    """Convert the text of a double, such as ``0.1d``, to a decimal without suffix and exponent. The decimal
    has at least :data:`PRINTED` digits, and other programs read it as the same double.

    >>> decimal_text("-0.3333333333333333d"), decimal_text("0.1d")
    ('-0.3333333333333333', '0.10000000000000001')
    """
    x = float(text.removesuffix("d"))
    return ("-" if x < 0 else "") + printed(Fraction(x))


def is_short(x: float) -> bool:
    """Return True if a double needs so few bits that it counts as an exact number.

    >>> is_short(0.375), is_short(0.1)
    (True, False)
    """
    numerator, denominator = x.as_integer_ratio()
    if max(numerator.bit_length(), denominator.bit_length()) > LARGE:
        return False
    numerator = abs(numerator)
    return not numerator or (numerator // (numerator & -numerator)).bit_length() <= SHORT


def printed(value: Fraction) -> str:
    """Return the absolute value of a double as a decimal without exponent. The decimal has at least
    :data:`PRINTED` digits.

    >>> printed(Fraction(1 / 3)), printed(Fraction(0.1))
    ('0.3333333333333333', '0.10000000000000001')
    """
    x = abs(float(value))
    if x >= 2**53:
        return f"{int(x)}.0"
    shortest = f"{Decimal(repr(x)):f}"
    if len(shortest.replace(".", "").lstrip("0")) >= PRINTED:
        return shortest
    return f"{Decimal(f'{x:.16e}'):f}"


def is_printed(decimal: str) -> bool:
    """Return True if a decimal without exponent was probably printed from a double.

    - Fewer than 16 digits: the result is False.
    - 16 or 17 digits: the result is True.
    - More digits: the result is True if the nearest double, rounded to the same number of digits, equals the
      decimal.

    >>> is_printed("0.3333333333333333"), is_printed("0.3333333333"), is_printed("0.333333333333333333333")
    (True, False, False)
    >>> is_printed("0.333333333333333314829616")
    True
    """
    digits = len(decimal.replace(".", "").lstrip("-+0"))
    if not PRINTED <= digits <= LONGEST or not math.isfinite(x := float(decimal)):
        return False
    return digits <= 17 or Decimal(f"{x:.{digits - 1}e}") == Decimal(decimal)
