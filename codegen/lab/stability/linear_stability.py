"""Linear stability: the stability function of a tableau, and its stability intervals on the real and
imaginary axes.

If a Runge-Kutta method solves y' = lambda y, each step of size h multiplies y by R(h lambda). The function R
is the stability function of the method.

A Lie group method for y' = f(y).y, where f(y) is in the Lie algebra, is exact if f is constant. If f(y)
varies along the solution, the stability intervals of the tableau limit the step size.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from codegen.method import Method
from orderconds.errors import InputError
from orderconds.families import get
from orderconds.tableau.stability import stability_function

FARTHEST = 100.0
SLACK = 1e-9


@dataclass(frozen=True)
class Quotient:
    """A rational function of a complex number z, with the coefficients in ascending powers of z."""

    numerator: tuple[float, ...]
    denominator: tuple[float, ...]

    def __call__(self, z: complex) -> complex:
        """Return the value at z, or infinity if the denominator is zero."""
        top, bottom = (_horner(row, z) for row in (self.numerator, self.denominator))
        return top / bottom if bottom else complex("inf")


@dataclass(frozen=True)
class Region:
    """The stability function of a method, and its stability intervals.

    ``label`` is the name of the method, and ``value`` is the stability function R. On a stability interval,
    which begins at zero, |R(z)| <= 1. ``real`` and ``imaginary`` are the lengths of the intervals on the
    negative real and the positive imaginary axis. If a length exceeds :data:`FARTHEST`, it is replaced by
    infinity.
    """

    label: str
    value: Callable[[complex], complex]
    real: float
    imaginary: float

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON. An infinite length becomes None."""
        return {
            "real": None if self.real == float("inf") else self.real,
            "imaginary": None if self.imaginary == float("inf") else self.imaginary,
        }


def region(method: Method) -> Region | None:
    """Return the stability function and the stability intervals of the tableau of a method.

    The result is None if the stability function is not known, for example for splitting methods and tableaux
    with inexact coefficients.
    """
    known = get(method.family_label).stability_coefficients()
    if known is not None:
        polynomial = Quotient(tuple(map(float, known)), (1.0,))
        return Region(method.label, polynomial, reach(polynomial, -1.0), reach(polynomial, 1j))
    tableau = method.tableau
    try:
        R = stability_function(tableau.abelian(), tableau.ring)
        rows = [[float(tableau.ring.approximate(x, 20)) for x in p] for p in (R.numerator, R.denominator)]
    except (InputError, TypeError, ValueError, ArithmeticError, AttributeError):
        return None

    value = Quotient(*map(tuple, rows))
    return Region(method.label, value, reach(value, -1.0), reach(value, 1j))


def _horner(row: Sequence[float], z: complex) -> complex:
    total = 0j
    for c in reversed(row):
        total = total * z + c
    return total


def reach(value: Callable[[complex], complex], direction: complex) -> float:
    """Return the largest r such that |value(s ``direction``)| <= 1 for 0 <= s <= r.

    ``direction`` is a complex number with absolute value 1. If r exceeds :data:`FARTHEST`, the result is
    infinity.

    >>> round(reach(lambda z: 1 + z, -1.0), 6), reach(lambda z: 1 / (1 - z), -1.0)
    (2.0, inf)
    """
    step, x = 1.0 / 128, 0.0
    while x < FARTHEST:
        if abs(value((x + step) * direction)) > 1.0 + SLACK:
            break
        x += step
    else:
        return float("inf")
    low, high = x, x + step
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if abs(value(middle * direction)) <= 1.0 + SLACK else (low, middle)
    return low if low > step else 0.0
