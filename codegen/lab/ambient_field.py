"""The right-hand side of the differential equation of a scene, as a Python function of Arb balls.

A ball is a number with an error radius. The radii are not used. Arb is used because it is several times
faster than mpmath.
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
    """Return the right-hand side of the differential equation of a scene, as a function of (state, t).

    The parameters of the scene have their default values. Constants are rounded in the call of
    ``ambient_field``, to the working precision at that time.
    """
    return velocity(scene).python(ball, FUNCTIONS)


def ball(number: Number) -> arb:
    """Return an exact number as a ball with at least the working precision.

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
