"""The right-hand side of the differential equation y' = f(y).y of a scene, as a Python function of Arb balls.

A ball is a number with an error radius. A reference solution uses Arb balls because they are several times
faster than mpmath numbers. The integration of a reference solution ignores the radii. A second integration
measures the uncertainty (:mod:`codegen.lab.reference`).
"""

from __future__ import annotations

from flint import arb

from codegen.ir.number import Number
from codegen.lab.number_functions import of_scalars
from codegen.lab.number_types import Evaluate
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem
from orderconds.ring.precision import precision, working_bits

FUNCTIONS = of_scalars(arb)


def ambient_field(scene: Problem) -> Evaluate:
    """Return the right-hand side f(y).y as a function (state, t) -> tuple of balls.

    Parameters have their default values. Constants are rounded to the current working precision.
    """
    return velocity(scene).python(ball, FUNCTIONS)


def ball(number: Number) -> arb:
    """Return a ball that contains an exact number. The ball has at least the working precision.

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
