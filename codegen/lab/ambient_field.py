"""The ambient equation y' = f(y).y of a scene as one Python function of balls.

Arb's numbers are several times faster than mpmath's, and a compiled function is faster than an interpreted
expression; a reference solution evaluates the field a million times. Radii are not used as error bounds: the
integrator takes midpoints and measures the uncertainty by a second run.
"""

from __future__ import annotations

from flint import arb

from codegen.ir.number import Number
from codegen.lab.number_types import Evaluate
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem
from orderconds.ring.precision import precision, working_bits

FUNCTIONS = {name: getattr(arb, name) for name in ("sqrt", "sin", "cos", "exp", "log")}


def ambient_field(scene: Problem) -> Evaluate:
    """Return the ambient derivative, for default parameter values, as a function (state, t) of balls.

    Constants have the working precision at the time of this call.
    """
    return velocity(scene).python(ball, FUNCTIONS)


def ball(number: Number) -> arb:
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
