"""Functions that select one of several formulas by a comparison.

- ``choose(x, a, b)`` is ``a`` for x > 0, and ``b`` for x <= 0. If x is a NaN, the value is a NaN.
- ``fabs(x)`` is the absolute value of x.
- A :class:`codegen.ir.table.PiecewisePolynomial` at x selects the polynomial of the interval that contains x.

The argument x may be a power series in the step size. :class:`Kink` is raised if the constant term of the
series is a boundary between two formulas, or if this cannot be decided.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from codegen.ir.table import PiecewisePolynomial, Sign

if TYPE_CHECKING:
    from codegen.ir.domain import Domain, Scalar

CHOOSE, ABSOLUTE = "choose", "fabs"

SELECTING = (CHOOSE, ABSOLUTE)
"""The names of the functions that select a formula by the sign of their first argument."""


class Kink(ArithmeticError):
    """Raised if ``choose``, ``fabs`` or a piecewise polynomial cannot select a formula for a power series.

    The constant term of the power series is a boundary between two formulas, or the program cannot decide
    whether the constant term is a boundary.
    """


def selects(function: str) -> bool:
    """Return True if ``function`` is ``choose``, ``fabs`` or a piecewise polynomial."""
    return function in SELECTING or isinstance(function, PiecewisePolynomial)


def selected(domain: Domain, function: str, args: tuple[Scalar, ...], sign: Sign) -> Scalar:
    """Return the value of ``choose``, ``fabs`` or a piecewise polynomial for the arguments ``args``.

    ``sign`` returns the sign of a scalar: -1, 0, 1, or None for a NaN. If the first argument is a NaN, the
    result is the first argument.
    """
    x = args[0]
    if isinstance(function, PiecewisePolynomial):
        return function.value(domain, x, sign)
    order = sign(x)
    # A NaN argument must give a NaN.
    if order is None:
        return x
    if function == ABSOLUTE:
        return -x if order < 0 else x
    # ``order`` is the sign of ``args[0]``. The function ``choose`` selects ``args[1]`` for the sign 1, and
    # ``args[2]`` for the signs 0 and -1.
    return args[1] if order > 0 else args[2]


def sign_of_number(x: Scalar) -> int | None:
    """Return the sign of a real number, or None for a NaN or a complex number."""
    try:
        # For a NaN the result is None, because all comparisons are false.
        return 1 if x > 0 else -1 if x < 0 else 0 if x == 0 else None
    except TypeError:  # Complex numbers, such as mpmath roots of negative numbers, have no order.
        return None
