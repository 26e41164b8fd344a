"""Conversion of floats in a user's formulas to exact fractions.

A float becomes the shortest decimal that rounds to this float, so 0.1 becomes 1/10.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import sympy

DIGITS_OF_BITS = 0.30103
"""The number of decimal digits for each bit: log10(2)."""


def decimal(value: sympy.Float) -> Fraction:
    """Return the shortest decimal number that rounds to ``value`` in the precision of ``value``.

    >>> import sympy
    >>> decimal(sympy.Float(0.1)), decimal(sympy.Float("1e-5", 30))
    (Fraction(1, 10), Fraction(1, 100000))
    """
    from mpmath.libmp import from_str, to_str

    bits = int(value._prec)
    # The loop always ends with ``break``, because the largest value of ``digits`` is sufficient for every
    # float with ``bits`` bits.
    for digits in range(1, int(bits * DIGITS_OF_BITS) + 3):
        text = to_str(value._mpf_, digits)
        if from_str(text, bits, "n") == value._mpf_:
            break
    return Fraction(text)


def exact(value: object) -> Fraction | None:
    """Convert a number from the user's input to a fraction. If ``value`` is not a rational number,
    return None.

    ``value`` is a number of Python, NumPy or sympy, or a text such as "1/10". A float becomes the shortest
    decimal that rounds to this float.

    >>> exact(0.1), exact("1/3"), exact("x")
    (Fraction(1, 10), Fraction(1, 3), None)
    """
    # Integers and fractions need no sympy, so the slow import is avoided.
    if isinstance(value, int | Fraction):
        return Fraction(value)
    import sympy

    try:
        # With ``strict=True``, ``sympify`` rejects objects that are not numbers.
        number = sympy.Rational(value) if isinstance(value, str) else sympy.sympify(value, strict=True)
    except (sympy.SympifyError, TypeError, ValueError):
        return None
    # ``sympify`` converts a float of Python to a ``Float`` of sympy.
    if isinstance(number, sympy.Float):
        return decimal(number)
    if not getattr(number, "is_Rational", False):
        return None
    return Fraction(int(number.p), int(number.q))
