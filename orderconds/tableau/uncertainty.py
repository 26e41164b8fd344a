"""The uncertainty of the coefficients of a tableau, compared with the rounding of a floating-point format."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq

from orderconds.ring.balls import Ball, Balls
from orderconds.ring.decimals import endpoints, rational_decimal
from orderconds.tableau.doubles import radius
from orderconds.tableau.record import Tableau

WIDER = fmpq(17, 8)
"""In a tableau with doubles, a coefficient is a ball: an interval from x - e to x + e. Let r be the default
radius for a double x (:func:`~orderconds.tableau.doubles.radius`). The coefficient counts as accurate if the
width 2 e is at most ``WIDER`` times r. ``WIDER`` is slightly larger than 2, because rounding can make e
slightly larger than r."""


def uncertainty(tableau: Tableau, bits: int) -> str:
    """Return the largest radius of an inaccurate coefficient, as a decimal with two digits. If all
    coefficients are accurate, the result is empty.

    A coefficient counts as accurate if the radius of its ball (interval) is at most the error of one rounding
    to ``bits`` bits. A double, such as ``0.1d``, also counts as accurate if its ball has the default radius
    (:func:`~orderconds.tableau.doubles.radius`).

    >>> from orderconds.tableau import find
    >>> uncertainty(Tableau.load(find("rk4")), 53)
    ''
    >>> text = 'name = "t"\\nfamily = "rk"\\nA = [[], ["0.5~"]]\\nb = ["0", "1"]'
    >>> uncertainty(Tableau.loads(text), 53)
    '0.10'
    """
    if not isinstance(tableau.ring, Balls):
        return ""
    widest = fmpq(0)

    def visit(x: Ball) -> Ball:
        nonlocal widest
        low, high = endpoints(x.value)
        narrow = abs(low + high) / 2**bits
        if tableau.doubles:
            middle = (low + high) / 2
            narrow = max(narrow, WIDER * _rational(radius(Fraction(int(middle.p), int(middle.q)))))
        if high - low > narrow:
            widest = max(widest, (high - low) / 2)
        return x

    tableau.method.map(visit)
    return rational_decimal(widest, 2) if widest else ""


def largest_radius(tableau: Tableau) -> float:
    """Return the largest radius of a coefficient, or 0 if the coefficients are not balls (intervals).

    >>> from orderconds.tableau import find
    >>> largest_radius(Tableau.load(find("rk4")))
    0.0
    >>> text = 'name = "t"\\nfamily = "rk"\\nA = [[], ["0.5~"]]\\nb = ["0", "1"]'
    >>> round(largest_radius(Tableau.loads(text)), 6)
    0.1
    """
    if not isinstance(tableau.ring, Balls):
        return 0.0
    widest = fmpq(0)

    def visit(x: Ball) -> Ball:
        nonlocal widest
        low, high = endpoints(x.value)
        widest = max(widest, (high - low) / 2)
        return x

    tableau.method.map(visit)
    return int(widest.p) / int(widest.q)


def _rational(x: Fraction) -> fmpq:
    return fmpq(x.numerator, x.denominator)
