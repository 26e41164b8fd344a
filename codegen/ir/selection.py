"""Functions that select one of several formulas by a comparison, in every domain.

``choose(x, a, b)`` is a for x > 0, b for x <= 0, and NaN if x is NaN. Every condition in a formula becomes a
call of this function. ``fabs`` is the absolute value, and a :class:`codegen.ir.table.PiecewisePolynomial`
selects a polynomial. Power series raise an error at a point where the selected formula changes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from codegen.ir.table import PiecewisePolynomial, Sign

if TYPE_CHECKING:
    from codegen.ir.domain import Domain, Scalar

CHOOSE, ABSOLUTE = "choose", "fabs"

SELECTING = (CHOOSE, ABSOLUTE)
"""The selecting functions with a fixed name. Tables also select a formula, but their names are not fixed."""


class Kink(ArithmeticError):
    """The error for power series at a point where the selected formula changes."""


def selects(function: str) -> bool:
    """Return True if a function selects one of several formulas."""
    return function in SELECTING or isinstance(function, PiecewisePolynomial)


def selected(domain: Domain, function: str, args: tuple[Scalar, ...], sign: Sign) -> Scalar:
    """Return the value of a selecting function.

    ``sign`` returns the sign of a scalar. If the sign is None, as for a NaN, the first argument is returned.
    """
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
    """Return the sign of a real number, or None for a NaN or a complex number."""
    try:
        # All comparisons with a NaN are false, so a NaN gives None.
        return 1 if x > 0 else -1 if x < 0 else 0 if x == 0 else None
    except TypeError:  # Complex numbers, such as mpmath roots of negative numbers, have no order.
        return None
