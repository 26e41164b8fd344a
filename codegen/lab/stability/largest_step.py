"""The largest usable step size of a method on a scene, and the reason why longer steps are not usable.

The time span of the scene is divided into n equal steps. The run is usable if it satisfies three conditions:

- No step fails, and the final state is finite.
- The error of the final state is at most a tenth of the size of the solution (:func:`_size`).
- If the scene has a conserved energy, the energy changes by at most a tenth of its size.

Bisection finds a number n such that the run with n steps is usable and the run with n - 1 steps is not.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from codegen.emitter import Compiled
from codegen.integrator import StepFailed
from codegen.lab.distance import distance
from codegen.lab.invariants import functions
from codegen.lab.reference import Reference
from codegen.lab.runner import Emitted

USABLE = 0.1
MOST = 2**22
ENERGY = "energy"


@dataclass(frozen=True)
class Limit:
    """The largest usable step size ``h``. A run over the time span makes ``steps`` steps of this size.

    ``reason`` explains why longer steps are not usable. If no usable step size is found, ``h`` and ``steps``
    are None, and ``reason`` describes the last failure.
    """

    h: float | None
    steps: int | None
    reason: str

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON."""
        return {"h": self.h, "steps": self.steps, "reason": self.reason}


def largest_step(compiled: Compiled, runner: Emitted, exact: Reference) -> Limit:
    """Return the largest usable step size of a compiled method.

    The step size is T/n, where T is the length of the time span, and n is a positive integer. If n > 1, the
    next longer step size T/(n - 1) is not usable. All step sizes longer than T/(n - 1) count as not usable,
    although only some of them are tested.
    """
    span = compiled.scene.span[1] - compiled.scene.span[0]
    reason, failing, steps = "a longer step would exceed the time span", 0, 1
    while (failure := _failure(compiled, runner, exact, steps)) is not None:
        reason, failing, steps = failure, steps, 2 * steps
        if steps > MOST:
            return Limit(None, None, f"a run with {MOST} steps is not usable: {reason}")
    while steps - failing > 1:
        middle = (steps + failing) // 2
        failure = _failure(compiled, runner, exact, middle)
        if failure is None:
            steps = middle
        else:
            reason, failing = failure, middle
    return Limit(float(Fraction(span) / steps), steps, reason)


def _failure(compiled: Compiled, runner: Emitted, exact: Reference, steps: int) -> str | None:
    """Return the reason why a run with ``steps`` equal steps is not usable, or None if it is usable."""
    scene = compiled.scene
    first, last = scene.span
    h = float(Fraction(last - first) / steps)
    try:
        end = runner.integrator.run(runner.initial, h, steps, float(first))
    except StepFailed as failure:
        return failure.reason
    if not all(map(math.isfinite, end)):
        return "a number is not finite"
    energy = functions(scene).get(ENERGY)
    if energy is not None and scene.autonomous:
        before, after = energy(runner.initial, float(first))[0], energy(end, float(last))[0]
        if abs(after - before) > USABLE * max(abs(before), abs(after)):
            return "the energy changes by more than a tenth of its size"
    if distance(scene, end, exact.state) > USABLE * _size(runner, exact):
        return "the error is above a tenth of the state's size"
    return None


def _size(runner: Emitted, exact: Reference) -> float:
    """Return the larger norm of the initial state and of the exact final state.

    If both states are zero, return the norm of the vector ``exact.sizes``. For each coordinate, this vector
    contains the largest absolute value at the steps of the reference solution. A change of the unit of the
    state changes the size by the same factor.
    """
    ends = max(math.hypot(*runner.initial), math.hypot(*map(float, exact.state)))
    return ends or math.hypot(*exact.sizes)
