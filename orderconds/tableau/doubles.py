"""Coefficients that are given as binary floating-point numbers (doubles).

A double is usually a rounded coefficient, such as 0.3333333333333333 for 1/3. In a tableau file, the letter
``d`` marks a double, as in ``0.3333333333333333d``. The coefficient is then a ball: an interval around the
double x with the radius ``UNITS * 2^-53 * max(1, |x|)``. The factor ``UNITS`` allows for several roundings,
because many coefficients are results of a computation.

A Python float counts as an exact number if it has at most :data:`SHORT` significant bits. Very large and very
small numbers never count as exact (:data:`LARGE`).
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction

from orderconds.errors import TableauError

UNITS = 8
"""The default factor in the radius ``UNITS * 2^-53 * max(1, |x|)`` of the ball around a double x."""

ROUNDING = Fraction(1, 2**53)
"""The largest relative error of rounding a number to a double."""

SHORT = 26
"""A double counts as an exact number only if it has at most this number of significant bits."""

PRINTED = 16
"""A decimal with at least this number of significant digits may be the printed value of a double
(:func:`is_printed`). A decimal with fewer digits is treated as an exact number or as a rounded decimal."""

LARGE = 64
"""A double counts as an exact number only if its numerator and its denominator each have at most this number
of bits."""

LONGEST = 1200
"""The exact decimal of every double has at most this number of significant digits."""

_DOUBLE = re.compile(r"-?(?:\d+\.?\d*|\.\d+)d", re.ASCII)


def radius(value: Fraction, units: Fraction | int = UNITS) -> Fraction:
    """Return the radius of the ball around the double ``value``: ``units * 2^-53 * max(1, |value|)``.

    >>> float(radius(Fraction(1, 2))) == 8 * 2.0**-53, radius(Fraction(4)) == 4 * radius(Fraction(1))
    (True, True)
    """
    return units * ROUNDING * max(Fraction(1), abs(value))


def double_text(x: float, where: str = "") -> str:
    """Return a double as the text of a coefficient. The text ends with ``d`` if :func:`is_short` returns
    False.

    Raises :class:`~orderconds.errors.TableauError` if x is not finite. The error message contains ``where``.

    >>> [double_text(x) for x in (0.5, -3.0, 0.0, 1 / 3, 0.1, 1e-05)]
    ['0.5', '-3', '0', '0.3333333333333333d', '0.1d', '0.00001d']
    """
    if not math.isfinite(x):
        raise TableauError(f"the number {x}", where=where, expected="a finite number")
    if is_short(x):
        return f"{Decimal(x):f}" if x else "0"
    return f"{Decimal(repr(x)):f}d"


def is_double(text: str | int) -> bool:
    """Return True if a coefficient is the text of a double: a decimal that ends with the letter ``d``.

    >>> is_double("-0.1d"), is_double("1/3"), is_double(1)
    (True, False, False)
    """
    return isinstance(text, str) and _DOUBLE.fullmatch(text) is not None


def decimal_text(text: str) -> str:
    """Convert the text of a double, such as ``0.1d``, to a decimal without suffix and without exponent. The
    decimal has at least :data:`PRINTED` significant digits. A program that reads the decimal obtains the same
    double.

    >>> decimal_text("-0.3333333333333333d"), decimal_text("0.1d")
    ('-0.3333333333333333', '0.10000000000000001')
    """
    x = float(text.removesuffix("d"))
    return ("-" if x < 0 else "") + printed(Fraction(x))


def is_short(x: float, bits: int = SHORT) -> bool:
    """Return True if a double counts as an exact number. An exact number has at most ``bits`` significant
    bits, and its numerator and its denominator have at most :data:`LARGE` bits each.

    >>> is_short(0.375), is_short(0.1)
    (True, False)
    """
    numerator, denominator = x.as_integer_ratio()
    if max(numerator.bit_length(), denominator.bit_length()) > LARGE:
        return False
    numerator = abs(numerator)
    return not numerator or (numerator // (numerator & -numerator)).bit_length() <= bits


def printed(value: Fraction) -> str:
    """Return the absolute value of a double as a decimal without exponent. The decimal has at least
    :data:`PRINTED` significant digits.

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
    """Return True if a decimal without exponent was probably printed from a double. Zeros at the beginning of
    the decimal do not count as digits.

    - Fewer than 16 or more than 1200 digits: the result is False.
    - 16 or 17 digits: the result is True.
    - n digits, from 18 to 1200: the result is True if the nearest double, printed with n digits, equals
      ``decimal``.

    >>> is_printed("0.3333333333333333"), is_printed("0.3333333333"), is_printed("0.333333333333333333333")
    (True, False, False)
    >>> is_printed("0.333333333333333314829616")
    True
    """
    digits = len(decimal.replace(".", "").lstrip("-+0"))
    if not PRINTED <= digits <= LONGEST or not math.isfinite(x := float(decimal)):
        return False
    return digits <= 17 or Decimal(f"{x:.{digits - 1}e}") == Decimal(decimal)
