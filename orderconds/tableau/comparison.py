"""Comparison of the coefficients of two tableaux. Rounded decimals are compared as intervals."""

from __future__ import annotations

from typing import cast

from flint import fmpq

from orderconds.ring import Balls, NumberField, Rationals
from orderconds.ring.decimals import endpoints
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.record import Tableau

COMPARED = 160
"""The precision, in bits, of the intervals that are compared."""


def equal_coefficients(one: Tableau, other: Tableau) -> bool:
    """Return True if two tableaux have equal coefficients, including the coefficients of embedded methods.

    Let w be the smaller width of two balls (intervals). The balls count as equal if they intersect, and if
    the larger width is at most 4 w + 2^-100. The balls of equal coefficients can differ, because the centre
    and the radius of a ball may be rounded in a file.

    >>> from orderconds.tableau import find
    >>> rk4, heun = (Tableau.load(find(name)) for name in ("rk4", "heun"))
    >>> equal_coefficients(rk4, rk4), equal_coefficients(rk4, heun)
    (True, False)
    """
    first, second = _coefficients(one), _coefficients(other)
    return len(first) == len(second) and all(map(_agree, first, second))


def equal_extensions(one: Tableau, other: Tableau) -> bool:
    """Return True if both tableaux have equal continuous extensions, or if both have none. Coefficients are
    compared as in :func:`equal_coefficients`.

    >>> from orderconds.tableau import find
    >>> rk4, heun = (Tableau.load(find(name)) for name in ("rk4", "heun"))
    >>> equal_extensions(rk4, rk4), equal_extensions(rk4, heun)
    (True, False)
    """
    if one.extension is None or other.extension is None:
        return one.extension is other.extension
    if (one.extension.order, one.extension.degree) != (other.extension.order, other.extension.degree):
        return False
    first, second = (
        [_enclosure(x, tableau.ring) for row in extension.rows for x in row]
        for tableau, extension in ((one, one.extension), (other, other.extension))
    )
    return len(first) == len(second) and all(map(_agree, first, second))


def _enclosure(x: Element, ring: Ring) -> tuple[fmpq, fmpq]:
    """Return the ends of an interval that contains ``x``."""
    return endpoints(cast("Rationals | NumberField | Balls", ring).ball(x, COMPARED))


def _coefficients(tableau: Tableau) -> list[tuple[fmpq, fmpq]]:
    """Return intervals that contain the coefficients. The coefficients of the embedded method come last."""
    enclosures: list[tuple[fmpq, fmpq]] = []

    def visit(x: Element) -> Element:
        enclosures.append(_enclosure(x, tableau.ring))
        return x

    tableau.method.map(visit)
    if (lower := tableau.lower()) is not None:
        lower.method.map(visit)
    return enclosures


def _agree(one: tuple[fmpq, fmpq], other: tuple[fmpq, fmpq]) -> bool:
    """Let w <= W be the widths of two intervals. Return True if the intervals intersect and
    W <= 4 w + 2^-100."""
    widths = sorted(high - low for low, high in (one, other))
    meet = one[0] <= other[1] and other[0] <= one[1]
    return bool(meet and widths[1] <= 4 * widths[0] + fmpq(1, 2**100))
