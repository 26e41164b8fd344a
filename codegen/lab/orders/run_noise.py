"""Estimates of the rounding errors of a run, relative to the size of each coordinate.

A run is used to measure an order only if its error is much larger than these estimates.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from codegen.ir.domain import FloatDomain
from codegen.lab.number_types import Vector
from codegen.lab.orders.step_sizes import rounding
from codegen.lab.reference import Reference
from codegen.scene.problem import Problem
from orderconds.errors import InputError

LATE = "rounding of the time"
"""The reason to exclude a run whose error can come from the rounding of the time (:attr:`Noise.late`)."""


@dataclass(frozen=True)
class Noise:
    """The data that determine the rounding errors of runs of a scene.

    - ``epsilon``: the machine epsilon.
    - ``time``: the largest absolute value of the time, or 0 if the field does not depend on the time.
    - ``speeds``: for each coordinate, the largest absolute value of its velocity at the two ends of the time
      span and at the steps of the reference solution.
    - ``sizes``: for each coordinate, the larger of two numbers. The first number is the largest absolute
      value of the coordinate at the two ends and at the steps of the reference solution. The second number is
      the largest absolute value of its velocity at the two ends, times the length of the span.
    """

    epsilon: float
    time: float
    sizes: tuple[float, ...]
    speeds: tuple[float, ...]

    @classmethod
    def of(cls, scene: Problem, exact: Reference, epsilon: float) -> Noise:
        """Return the data for runs of ``scene`` with the reference solution ``exact``."""
        first, last = map(float, scene.span)
        ends = [(tuple(scene.initial(FloatDomain(0.0))), first), (tuple(map(float, exact.state)), last)]
        values = [max(abs(state[k]) for state, _ in ends) for k in range(len(exact.state))]
        values = list(map(max, values, exact.sizes or values))
        speeds = [0.0] * len(values)
        for state, t in ends:
            speeds = [max(a, b) for a, b in zip(speeds, _speeds(scene, state, t), strict=True)]
        sizes = [max(x, v * abs(last - first)) for x, v in zip(values, speeds, strict=True)]
        speeds = list(map(max, speeds, exact.speeds or speeds))
        time = 0.0 if scene.autonomous else max(abs(first), abs(last))
        return cls(epsilon, time, tuple(sizes), tuple(speeds))

    @property
    def late(self) -> str:
        """The reason to exclude a run: its error can come from rounding errors of the time t."""
        return (
            f"{LATE}: near t = {self.time:g}, neighbouring floating-point numbers differ by "
            f"{self.epsilon * self.time:.1e}"
        )

    def of_state(self, steps: int, gaps: Sequence[float]) -> float:
        """Return an estimate of the rounding errors of the state after ``steps`` steps.

        ``gaps`` contains the error of each coordinate. For each coordinate, the function takes the smaller of
        two numbers: an estimate of the rounding error, and the error in ``gaps``. The result is the Euclidean
        norm of the smaller numbers. The norm of the estimates alone is not used, because the estimate for a
        large coordinate is large even if this coordinate has no error. This estimate could exceed the errors
        of the small coordinates, and these errors would then be mistaken for rounding errors.
        """
        return math.hypot(
            *(min(gap, rounding(steps, self.epsilon, x)) for gap, x in zip(gaps, self.sizes, strict=True))
        )

    def of_time(self, gaps: Sequence[float]) -> float:
        """Return an estimate of the errors that the rounding of the time causes.

        Rounding can change the time by about s = ``epsilon`` * ``time``. A change of the time by s changes a
        coordinate with the velocity v by about s v. ``gaps`` contains the error of each coordinate. For each
        coordinate, the function takes the smaller of two numbers: s abs(v), and the error in ``gaps``. The
        result is the Euclidean norm of the smaller numbers.
        """
        shift = self.epsilon * self.time
        return math.hypot(*(min(gap, shift * v) for gap, v in zip(gaps, self.speeds, strict=True)))


def _speeds(scene: Problem, state: Vector, t: float) -> list[float]:
    """Return the absolute values of the velocities of the coordinates, or 0 where they are not defined."""
    try:
        velocity = [abs(float(v)) for v in scene.velocity(FloatDomain(0.0), state, t)]
    except (ArithmeticError, ValueError, InputError):
        return [0.0] * len(state)
    return [v if math.isfinite(v) else 0.0 for v in velocity]
