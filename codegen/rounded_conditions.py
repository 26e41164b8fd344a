"""Residuals of the order conditions for coefficients that are rounded to the precision of emitted code."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import islice
from typing import TYPE_CHECKING

from codegen.ir.precision import Precision
from codegen.method import Method
from orderconds.ring.balls import Balls
from orderconds.ring.decimals import endpoints
from orderconds.ring.protocol import Element
from orderconds.tableau import Tableau

if TYPE_CHECKING:
    from orderconds.families import Family

RING = Balls(256)
"""Interval arithmetic with 256 bits.

The terms of a residual nearly cancel, so in double precision their sum would have few correct digits.
"""

MOST = 3000
"""If an order has more conditions than this number, :func:`largest_residual` returns None."""


def rounded_residual(method: Method, family: Family, order: int, target: Precision) -> float | None:
    """Return the result of :func:`largest_residual` for the coefficients rounded to ``target``.

    Every coefficient is rounded once to the precision ``target``.

    >>> from codegen.method import parse
    >>> from codegen.ir.precision import DOUBLE, SINGLE
    >>> from orderconds.families import get
    >>> kutta = parse("rk:kutta3", ("rk",))
    >>> [f"{rounded_residual(kutta, get('rk'), 3, target):.1e}" for target in (DOUBLE, SINGLE)]
    ['5.6e-17', '3.0e-08']
    """

    def convert(x: Element) -> Element:
        return RING.constant(Fraction(target.round(method.number(x))))

    return largest_residual(method.tableau.over(RING, convert), family.converted(convert), order)


def largest_residual(tableau: Tableau, family: Family, order: int) -> float | None:
    """Return an upper bound of the absolute residuals of order conditions up to ``order``.

    A condition that follows from other conditions may be omitted. The bound does not apply to the residuals
    of omitted conditions. The bound is rounded upwards. The result is None in these cases:

    - The family cannot read the tableau.
    - An order has more than :data:`MOST` conditions.
    - A condition contains a division by a number that may be zero.
    """
    coefficients = family.read(tableau.over(RING))
    if coefficients is None:
        return None
    largest = Fraction(0)
    for n in range(1, order + 1):
        keys = tuple(islice(family.decisive_in_turn(n), MOST + 1))
        if len(keys) > MOST:
            return None
        try:
            residuals = family.residuals(coefficients, RING, tuple(condition() for _, condition in keys))
        except ZeroDivisionError:
            return None
        largest = max([largest, *(abs(_fraction(end)) for x in residuals for end in endpoints(x.value))])
    return upper(largest)


def upper(x: Fraction) -> float:
    """Return the smallest double that is not less than ``x``.

    >>> upper(Fraction(1, 4)), upper(Fraction(1, 3)) - Fraction(1, 3) > 0
    (0.25, True)
    """
    nearest = float(x)
    return nearest if nearest >= x else math.nextafter(nearest, math.inf)


def _fraction(x: Element) -> Fraction:
    return Fraction(int(x.p), int(x.q))
