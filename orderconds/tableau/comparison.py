"""Comparison of the coefficients of two tableaux. Rounded decimals are compared up to their uncertainty."""

from __future__ import annotations

from typing import cast

from flint import fmpq

from orderconds.ring import Balls, NumberField, Rationals
from orderconds.ring.decimals import endpoints
from orderconds.ring.protocol import Element
from orderconds.tableau.record import Tableau

COMPARED = 160
"""The precision of the comparison, in bits."""


def equal_coefficients(one: Tableau, other: Tableau) -> bool:
    """Return True if the coefficients of two tableaux are equal, including embedded methods.

    Two balls (intervals) count as equal if they intersect and neither is much wider than the other. Exact
    equality is not required, because writing a ball to a file may round the centre and the radius.

    >>> from orderconds.tableau import find
    >>> rk4, heun = (Tableau.load(find(name)) for name in ("rk4", "heun"))
    >>> equal_coefficients(rk4, rk4), equal_coefficients(rk4, heun)
    (True, False)
    """
    first, second = _coefficients(one), _coefficients(other)
    return len(first) == len(second) and all(map(_agree, first, second))


def _coefficients(tableau: Tableau) -> list[tuple[fmpq, fmpq]]:
    """Return intervals that contain the coefficients. The coefficients of the embedded method come last."""
    enclosures: list[tuple[fmpq, fmpq]] = []
    ring = cast("Rationals | NumberField | Balls", tableau.ring)

    def visit(x: Element) -> Element:
        enclosures.append(endpoints(ring.ball(x, COMPARED)))
        return x

    tableau.method.map(visit)
    if (lower := tableau.lower()) is not None:
        lower.method.map(visit)
    return enclosures


def _agree(one: tuple[fmpq, fmpq], other: tuple[fmpq, fmpq]) -> bool:
    """Return True if two enclosures intersect, and neither is much wider than the other."""
    widths = sorted(high - low for low, high in (one, other))
    meet = one[0] <= other[1] and other[0] <= one[1]
    return bool(meet and widths[1] <= 4 * widths[0] + fmpq(1, 2**100))
