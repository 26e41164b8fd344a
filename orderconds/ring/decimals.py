"""Conversion of exact numbers to correctly rounded decimals and doubles.

An irrational number is given by a function that computes an enclosing ball at any precision. The precision is
increased until both end points of the ball are rounded to equal decimals or doubles.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from flint import arb, fmpq, fmpz

Rounded = TypeVar("Rounded", str, float)
Enclosure = Callable[[int], arb]
"""A function from a precision in bits to a ball (interval) that contains a fixed real number."""


def endpoints(ball: arb) -> tuple[fmpq, fmpq]:
    """Return the exact lower and upper end points of a finite ball.

    >>> endpoints(arb("0.75"))
    (3/4, 3/4)
    """
    middle, radius = _dyadic(ball.mid()), _dyadic(ball.rad())
    return middle - radius, middle + radius


def _dyadic(x: arb) -> fmpq:
    mantissa, exponent = x.man_exp()
    power = fmpq(2) ** int(exponent)
    return fmpq(mantissa) * power


def rational_decimal(x: fmpq, digits: int) -> str:
    """Return x as a decimal with ``digits`` significant digits. Ties are rounded to even. If the result is
    exact, trailing zeros are removed.

    >>> rational_decimal(fmpq(2, 3), 5), rational_decimal(fmpq(-1, 8), 20)
    ('0.66667', '-0.125')
    >>> rational_decimal(fmpq(1, 3 * 10**9), 4)
    '3.333e-10'
    """
    p, q = abs(int(x.p)), int(x.q)
    if p == 0:
        return "0"
    # If p has m digits and q has n digits, then 10^(m-n-1) < p/q < 10^(m-n+1).
    exponent = len(_figures(p)) - len(_figures(q))
    if p * 10 ** max(-exponent, 0) < q * 10 ** max(exponent, 0):
        exponent -= 1
    shift = digits - 1 - exponent
    scaled, rest = divmod(p * 10 ** max(shift, 0), divisor := q * 10 ** max(-shift, 0))
    if 2 * rest > divisor or (2 * rest == divisor and scaled % 2):
        scaled += 1
        if scaled == 10**digits:
            scaled, exponent = scaled // 10, exponent + 1
    figures = _figures(scaled)
    if rest == 0:
        figures = figures.rstrip("0")
    return ("-" if x < 0 else "") + _place_point(figures, exponent)


def _figures(n: int) -> str:
    """Return the decimal digits of n. The function has no limit of 4300 digits, unlike ``str``."""
    return str(fmpz(n))


def _place_point(figures: str, exponent: int) -> str:
    """Return a decimal number as text. The digits of the number are ``figures``. The place value of the first
    digit is 10^exponent."""
    if -5 <= exponent < 0:
        return "0." + "0" * (-exponent - 1) + figures
    if 0 <= exponent < 25:
        figures = figures.ljust(exponent + 1, "0")
        whole, part = figures[: exponent + 1], figures[exponent + 1 :]
        return f"{whole}.{part}" if part else whole
    part = figures[1:]
    return f"{figures[0]}{'.' + part if part else ''}e{exponent:+03d}"


def decimal(enclosure: Enclosure, digits: int) -> str:
    """Return an irrational number as a decimal that is correctly rounded to ``digits`` significant digits.
    The ball ``enclosure(bits)`` contains the number.

    >>> from orderconds.ring.precision import precision
    >>> def root(bits):
    ...     with precision(bits):
    ...         return arb(2).sqrt()
    ...
    >>> decimal(root, 12)
    '1.41421356237'
    """
    return _agreed(enclosure, lambda x: rational_decimal(x, digits), 4 * digits + 32)


def nearest_float(enclosure: Enclosure) -> float:
    """Return the double nearest to an irrational number. The ball ``enclosure(bits)`` contains the number.

    >>> from orderconds.ring.precision import precision
    >>> def root(bits):
    ...     with precision(bits):
    ...         return arb(2).sqrt()
    ...
    >>> nearest_float(root) == 2**0.5
    True
    """
    return _agreed(enclosure, rational_float, 96)


def rational_float(x: fmpq) -> float:
    """Return the double nearest to the fraction x.

    >>> rational_float(fmpq(1, 3))
    0.3333333333333333
    """
    return int(x.p) / int(x.q)  # Python rounds the quotient of two integers correctly.


def _agreed(enclosure: Enclosure, rounding: Callable[[fmpq], Rounded], bits: int) -> Rounded:
    while True:
        low, high = endpoints(enclosure(bits))
        if (answer := rounding(low)) == rounding(high):
            return answer
        bits *= 2
