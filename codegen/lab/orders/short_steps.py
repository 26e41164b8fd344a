"""Measures the order of a method with steps that are far shorter than every time scale of the scene.

A small parameter e of the scene can hide the leading term of the error. For example, let the error of a run
be e h^p + h^(p+1), where h is the step size. If h is much larger than e, the observed order is p + 1 and not
p. If h is much smaller than e, the observed order is p. The steps are computed with 100 decimal digits,
because the error of such short steps is tiny.

If the coefficients of a method are rounded, very short steps can show the effect of the rounding instead of
the order of the method. For this case, :func:`order_of_short_steps` has the argument ``negligible``: if
coefficient errors up to ``negligible`` can explain a low order, the function returns None.

No reference solution is needed. Let the error of one step of size h be C h^(p+1) to leading order. The error
of two steps of size h/2 is then 2 C (h/2)^(p+1). Therefore the slope of log(difference of the two computed
states) against log(h) is p + 1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from codegen.emitter import Optimised
from codegen.ir.domain import PreciseDomain
from codegen.lab.number_types import Scalar
from codegen.lab.stability.extreme_steps import precise_step
from codegen.lower import problem_for

DIGITS = 100
SMALLEST = 70
"""The shortest step size h satisfies (h/T)^(p+2) = 10^-SMALLEST for the order p and the time span T.

The number 10^-SMALLEST is much larger than the rounding errors of arithmetic with 100 digits.
"""

STEPS, RATIO = 3, 8
"""The number of step sizes that are tried, and the ratio of two consecutive step sizes."""

AGREEMENT = 0.1
"""The largest permitted difference between the orders computed from two pairs of consecutive step sizes."""

SWEEPS = 400


def order_of_short_steps(compiled: Optimised, stated: int, negligible: float = 0.0) -> float | None:
    """Return the order of a method, measured with very short steps from the initial state of the scene.

    ``stated`` is the expected order. If rounding errors up to ``negligible`` in the coefficients of the
    method can explain a low order, the result is None (the last case below). Let y0 be the initial state. For
    each of the step sizes h = h1, h2 and h3, the state y1 after one step of size h is compared with the state
    y2 after two steps of size h/2. The result is None in four cases:

    - A step cannot be computed.
    - For some step size h, y1 = y2.
    - The order computed from h1 and h2 differs by more than :data:`AGREEMENT` from the order computed from
      h2 and h3.
    - The order computed from h1 and h2 is below ``stated`` - :data:`AGREEMENT`, and for some step size h,
      |y2 - y1| <= ``negligible`` |y1 - y0| in the maximum norm.
    """
    problem = problem_for(compiled.scene, compiled.method)
    first, last = problem.span
    power = -Fraction(SMALLEST, stated + 2)
    h = float(last - first) * 10.0 ** float(power)
    try:
        sizes = [h * RATIO**k for k in range(STEPS)]
        state = problem.initial(PreciseDomain(0, DIGITS))
        pairs = [_gap(compiled, state, float(first), size) for size in sizes]
        gaps = [gap for gap, _ in pairs]
        slopes = [math.log(float(b / a)) / math.log(RATIO) - 1 for a, b in pairwise(gaps)]
    except (ArithmeticError, ValueError):
        return None
    if slopes[0] < stated - AGREEMENT and any(gap <= negligible * change for gap, change in pairs):
        return None
    return slopes[0] if max(slopes) - min(slopes) <= AGREEMENT else None


def _gap(compiled: Optimised, state: Sequence[Scalar], first: float, size: float) -> tuple[Scalar, Scalar]:
    """Return the largest difference of a coordinate between a step of length ``size`` and two half steps.

    The second result is the largest change of a coordinate in the step.
    """
    context = PreciseDomain(0, DIGITS).context
    t, h = context.mpf(first), context.mpf(size)

    def step(start: Sequence[Scalar], time: Scalar, length: Scalar) -> list[Scalar]:
        return precise_step(compiled, start, time, length, limit=SWEEPS, digits=DIGITS)

    one = step(state, t, h)
    two = step(step(state, t, h / 2), t + h / 2, h / 2)
    gap = max(abs(a - b) for a, b in zip(one, two, strict=True))
    return gap, max(abs(a - b) for a, b in zip(one, state, strict=True))
