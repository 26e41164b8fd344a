"""A scene's ambient equation y' = f(y).y as one Python function of balls.

Arb's numbers are several times faster than mpmath's and a compiled function than an interpreted expression;
a reference evaluates the field a million times. Radii are not used as bounds here: whoever integrates takes
midpoints, and measures the uncertainty by a second run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from flint import arb

from codegen.ir.number import Number
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem
from orderconds.ring.precision import precision, working_bits

Vector = Sequence[Any]
Field = Callable[[Vector, Any], tuple[Any, ...]]
"""From the coordinates of a state and the time, as balls, to the derivative of the coordinates."""

FUNCTIONS = {name: getattr(arb, name) for name in ("sqrt", "sin", "cos", "exp", "log")}


def ambient_field(scene: Problem) -> Field:
    """Return the function of a scene, its parameters at their defaults, for the working precision at hand."""
    return velocity(scene).python(ball, FUNCTIONS)


def ball(number: Number) -> Any:
    """Return a ball of the working precision around an exact number.

    >>> from orderconds.ring.precision import precision
    >>> with precision(53):
    ...     print(ball(Number.rational(1, 4)))
    0.250000000000000
    """
    if number.is_rational:
        fraction = number.fraction()
        return arb(fraction.numerator) / fraction.denominator
    bits = working_bits()
    with precision(bits + 16):
        return arb(number.ring.approximate(number.element, bits // 3 + 5))
