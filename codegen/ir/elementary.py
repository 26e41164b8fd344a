"""The elementary functions tan, sinh, cosh, tanh, atan, asin and acos, with their derivatives.

Formulas of a user may call these functions. The table :data:`ELEMENTARY` contains the first and second
derivatives of each function.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from codegen.ir.expr import Expr


@dataclass(frozen=True)
class Elementary:
    """A function of one variable x. The value of the function at x is f.

    - ``slope(x, f)`` is the first derivative at x.
    - ``curvature(x, f)`` is the second derivative at x.
    - ``at_zero`` is the value at x = 0. If this value is not rational, ``at_zero`` is None.
    - ``raising`` is true if the function raises an exception in Python for some x.
    """

    name: str
    slope: Callable[[Expr, Expr], Expr]
    curvature: Callable[[Expr, Expr], Expr]
    at_zero: Fraction | None = Fraction(0)
    raising: bool = False


def _of_cosine(x: Expr, f: Expr) -> Expr:
    # This is the derivative of sinh.
    return x.space.call("cosh", x)


def _of_sine(x: Expr, f: Expr) -> Expr:
    # This is the derivative of cosh.
    return x.space.call("sinh", x)


def _value(x: Expr, f: Expr) -> Expr:
    # The second derivative of sinh is sinh, and the second derivative of cosh is cosh.
    return f


def _arc(x: Expr, f: Expr) -> Expr:
    # This is the derivative of atan.
    return x.space.one / (1 + x * x)


def _arcsine(x: Expr, f: Expr) -> Expr:
    # This derivative of asin is infinite at x = 1 and x = -1.
    return x.space.one / x.space.call("sqrt", 1 - x * x)


def _arccosine(x: Expr, f: Expr) -> Expr:
    # The sum asin x + acos x is constant, so the two derivatives have opposite signs.
    return -_arcsine(x, f)


def _cubed(slope: Callable[[Expr, Expr], Expr]) -> Callable[[Expr, Expr], Expr]:
    # For asin and acos, the second derivative is x s^3, where s is the first derivative.
    return lambda x, f: x * slope(x, f) ** 3


# Python raises an exception for sinh and cosh of large x, and for asin and acos of x with abs(x) > 1.
ELEMENTARY = {
    function.name: function
    for function in (
        # The derivatives of tan and tanh are polynomials in the value f, so their formulas call no function.
        Elementary("tan", lambda x, f: 1 + f * f, lambda x, f: 2 * f * (1 + f * f)),
        Elementary("sinh", _of_cosine, _value, raising=True),
        Elementary("cosh", _of_sine, _value, Fraction(1), raising=True),
        Elementary("tanh", lambda x, f: 1 - f * f, lambda x, f: -2 * f * (1 - f * f)),
        Elementary("atan", _arc, lambda x, f: -2 * x * _arc(x, f) ** 2),
        Elementary("asin", _arcsine, _cubed(_arcsine), raising=True),
        # ``at_zero`` is None, because acos(0) = pi/2 is not rational.
        Elementary("acos", _arccosine, _cubed(_arccosine), None, raising=True),
    )
}
"""The elementary functions of this module, by name."""

MATHEMATICAL = ("sqrt", "sin", "cos", "exp", "log", *ELEMENTARY)
"""Functions of one argument with the same name in C, Python, mpmath and python-flint."""

ANGLE = "atan2"
"""The function atan2(y, x): the polar angle of the point (x, y), from -pi to pi."""
