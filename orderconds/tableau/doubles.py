"""Coefficients that are given as binary floating-point numbers (doubles).

A double is usually a rounded coefficient: 0.3333333333333333 is close to the intended coefficient 1/3, but
not equal to it. The text of such a coefficient ends with ``d``, as in ``0.3333333333333333d``. It denotes a
ball: its centre is exactly the double x, its radius is ``UNITS * 2^-53 * max(1, |x|)``. Rounding a number
once changes it by at most ``2^-53 |x|``. The factor ``UNITS`` and the bound 1 make the radius large enough
for a coefficient that was computed with a few roundings. In such a computation, for example of ``1/2 -
sqrt(3)/6``, the terms may be larger than the result.

A double that needs at most :data:`SHORT` bits, such as 0.5, 3.0 or -0.375, is an exact number: a rounded
number has so few bits only with probability 2^-27.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction

from orderconds.errors import TableauError

UNITS = 8
"""The default uncertainty of a double x, in units of 2^-53 max(1, |x|)."""

ROUNDING = Fraction(1, 2**53)
"""The largest relative error of rounding a number to a double."""

SHORT = 26
"""A double with at most this number of significant bits is exact."""

PRINTED = 16
"""A decimal in a file of another program is assumed to be a printed double if it has at least this number of
digits."""

LARGE = 64
"""The largest binary exponent of doubles that are written as exact decimals. The decimals of larger numbers
would be too long."""

LONGEST = 1200
"""An upper bound of the number of significant decimal digits of a double."""

_DOUBLE = re.compile(r"-?(?:\d+\.?\d*|\.\d+)d", re.ASCII)


def radius(value: Fraction, units: Fraction | int = UNITS) -> Fraction:
    """Return the uncertainty of the coefficient that a double represents.

    >>> float(radius(Fraction(1, 2))) == 8 * 2.0**-53, radius(Fraction(4)) == 4 * radius(Fraction(1))
    (True, True)
    """
    return units * ROUNDING * max(Fraction(1), abs(value))


def double_text(x: float, where: str = "") -> str:
    """Return a double as the text of a coefficient. The text is an exact number if the double has few bits,
    otherwise it has the suffix ``d``.

    Raises :class:`~orderconds.errors.TableauError`, whose message contains ``where``, for a number that is
    not finite.

    >>> [double_text(x) for x in (0.5, -3.0, 0.0, 1 / 3, 0.1, 1e-05)]
    ['0.5', '-3', '0', '0.3333333333333333d', '0.1d', '0.00001d']
    """
    if not math.isfinite(x):
        raise TableauError(f"the number {x}", where=where, expected="a finite number")
    if is_short(x):
        return f"{Decimal(x):f}" if x else "0"
    return f"{Decimal(repr(x)):f}d"


def is_double(text: str | int) -> bool:
    """Return True if a coefficient is the text of a double.

    >>> is_double("-0.1d"), is_double("1/3"), is_double(1)
    (True, False, False)
    """
    return isinstance(text, str) and _DOUBLE.fullmatch(text) is not None


def decimal_text(text: str) -> str:
    """Return the decimal of a double, without exponent and with at least :data:`PRINTED` digits. Other
    programs convert this decimal to the same double.

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
    """Return the decimal of a double with at least :data:`PRINTED` digits, without exponent and sign.

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
    """Return True if a decimal without exponent is the text of a double. This is assumed of every decimal of
    16 or 17 digits. A decimal with more digits is the text of a double if the nearest double, rounded to the
    same number of digits, equals the decimal.

    >>> is_printed("0.3333333333333333"), is_printed("0.3333333333"), is_printed("0.333333333333333333333")
    (True, False, False)
    >>> is_printed("0.333333333333333314829616")
    True
    """
    digits = len(decimal.replace(".", "").lstrip("-+0"))
    if not PRINTED <= digits <= LONGEST or not math.isfinite(x := float(decimal)):
        return False
    return digits <= 17 or Decimal(f"{x:.{digits - 1}e}") == Decimal(decimal)
