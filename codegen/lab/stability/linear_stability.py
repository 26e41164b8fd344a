"""Linear stability: the stability function of a tableau and its stability intervals on both axes.

For y' = lambda y, a step of a Runge-Kutta method is y1 = R(h lambda) y0 with the stability function R. A
method on a group solves equations with a constant field exactly, by exponentials. The stability region of its
tableau therefore limits the step size only if the field varies.
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
    """A rational function of a complex number. The coefficients are in ascending order of powers."""

    numerator: tuple[float, ...]
    denominator: tuple[float, ...]

    def __call__(self, z: complex) -> complex:
        """Return the value at z, or infinity if z is a pole."""
        top, bottom = (_horner(row, z) for row in (self.numerator, self.denominator))
        return top / bottom if bottom else complex("inf")


@dataclass(frozen=True)
class Region:
    """The stability function R (``value``), and two intervals that begin at zero and on which |R| <= 1.

    ``real`` is the length of the interval on the negative real axis. ``imaginary`` is the length of the
    interval on the positive imaginary axis. A length above :data:`FARTHEST` is infinity.
    """

    label: str
    value: Callable[[complex], complex]
    real: float
    imaginary: float

    def as_json(self) -> dict[str, object]:
        """Return plain data for JSON. The length of an unbounded interval becomes None."""
        return {
            "real": None if self.real == float("inf") else self.real,
            "imaginary": None if self.imaginary == float("inf") else self.imaginary,
        }


def region(method: Method) -> Region | None:
    """Return the linear stability of a method's tableau on R^n.

    The result is None for splitting methods, and for tableaux whose coefficients are not exact.
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
    """Return the largest x such that |value(z)| <= 1 for all z between 0 and x times ``direction``.

    The result is infinity if x exceeds :data:`FARTHEST`.

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
