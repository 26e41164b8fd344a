"""Functions that select one of several formulas by a comparison, in every domain.

``choose(x, a, b)`` is a for x > 0 and b for x <= 0; for a NaN it is a NaN. Every comparison and every
condition of a formula is a combination of this function. ``fabs`` is the absolute value, and a
:class:`codegen.ir.table.PiecewisePolynomial` selects a polynomial. The formulas are not smooth where a
selection changes; a domain of power series refuses these points.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from codegen.ir.table import PiecewisePolynomial, Sign

if TYPE_CHECKING:
    from codegen.ir.domain import Domain, Scalar

CHOOSE, ABSOLUTE = "choose", "fabs"

SELECTING = (CHOOSE, ABSOLUTE)
"""The functions of this module, besides tables."""


class Kink(ArithmeticError):
    """The error of a power series at a point where the selected formula changes."""


def selects(function: str) -> bool:
    """Whether a function selects one of several formulas."""
    return function in SELECTING or isinstance(function, PiecewisePolynomial)


def selected(domain: Domain, function: str, args: tuple[Scalar, ...], sign: Sign) -> Scalar:
    """Return the value of a function for which :func:`selects` is true."""
    x = args[0]
    if isinstance(function, PiecewisePolynomial):
        return function.value(domain, x, sign)
    order = sign(x)
    if order is None:
        return x
    if function == ABSOLUTE:
        return -x if order < 0 else x
    return args[1] if order > 0 else args[2]


def sign_of_number(x: Scalar) -> int | None:
    """Return the sign of a real number; None for a NaN or a complex number."""
    try:
        return 1 if x > 0 else -1 if x < 0 else 0 if x == 0 else None
    except TypeError:  # a root of a negative number in mpmath
        return None
