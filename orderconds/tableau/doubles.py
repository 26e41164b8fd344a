"""Doubles: coefficients that were given as binary floating-point numbers.

The text of a double is a hexadecimal number such as ``0x1.5555555555555p-2``, which is exact. A double denotes
the ball around its value whose radius is a few rounding errors, :data:`ROUNDING` times the size of the number
and at least of the number 1: a coefficient such as ``1/4 - sqrt(3)/6``, computed in doubles, has an error of
this size. A double that is a rational number with a small denominator, such as 0.5, is this rational number.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction

from orderconds.errors import TableauError
from orderconds.tableau.grammar import Constant

SMALL = 1024
"""A double whose denominator is at most this number is an exact rational number."""

ROUNDING = Fraction(1, 2**51)
"""The radius of the ball of a double, relative to the larger of 1 and the size of the number."""

_HEXADECIMAL = re.compile(r"-?0x[01]\.[0-9a-f]{1,13}p[+-]\d{1,4}")


def double_text(x: float, where: str = "") -> str:
    """Return the coefficient that a float denotes: a fraction or a hexadecimal number.

    :class:`~orderconds.errors.TableauError` is raised for infinities and NaN.

    >>> double_text(0.5), double_text(-3.0), double_text(1 / 3)
    ('1/2', '-3', '0x1.5555555555555p-2')
    """
    if not math.isfinite(x):
        raise TableauError(f"the number {x}", where=where, expected="a finite number")
    value = Fraction(x)
    return str(value) if value.denominator <= SMALL else float(x).hex()


def is_double(text: str | int) -> bool:
    """Whether a coefficient is the text of a double.

    >>> is_double("0x1.5555555555555p-2"), is_double("1/3"), is_double(1)
    (True, False, False)
    """
    return isinstance(text, str) and _HEXADECIMAL.fullmatch(text) is not None


def ball(text: str) -> Constant:
    """Return the ball that the text of a double denotes.

    >>> ball("0x1.8p+1")
    Constant(value=Fraction(3, 1), unit=Fraction(3, 2251799813685248))
    """
    value = Fraction(float.fromhex(text))
    return Constant(value, ROUNDING * max(Fraction(1), abs(value)))


def decimal_text(text: str) -> str:
    """Return the shortest decimal that is read as the same double, without an exponent.

    >>> decimal_text("0x1.5555555555555p-2"), decimal_text((1e-7 / 3).hex())
    ('0.3333333333333333', '0.000000033333333333333334')
    """
    digits, _, exponent = repr(float.fromhex(text)).partition("e")
    if not exponent:
        return digits
    sign, figures = ("-" if digits.startswith("-") else ""), digits.lstrip("-").replace(".", "")
    shift = int(exponent)
    return f"{sign}0.{'0' * (-shift - 1)}{figures}" if shift < 0 else f"{sign}{figures.ljust(shift + 1, '0')}"
