"""Runs of many steps: one run forward in time, and one run forward and back to the initial time."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

from codegen.emitter import Compiled
from codegen.integrator import StepFailed
from codegen.lab.distance import distance
from codegen.lab.invariants import MANIFOLD, functions
from codegen.lab.runner import Emitted

MANY = 10_000_000
BACK = 100_000
SECONDS = 3.0
"""A run forward in time takes at most about SECONDS seconds of CPU time.

If the run forward would take longer, the number of steps is reduced. In a run forward and back, the numbers
of steps in the two directions are equal.
"""

TRIAL = 1000


@dataclass(frozen=True)
class Endurance:
    """The result of a long run: a run forward, or a run forward followed by a run back to the initial time.

    - ``steps``: the number of steps in one direction. If a step of the run forward fails, ``steps`` is the
      number of completed steps forward. If a step of the run back fails, ``steps`` is the number of completed
      steps back.
    - ``defect``: the largest absolute residual of the equations of the manifold after a run forward, or None
      for a vector space. If the final state is not finite, ``defect`` is infinite.
    - ``returned``: the distance of the final state from the initial state after a run forward and back.
    - ``failure``: the error message of the integrator if a step failed.

    The property :attr:`held` is True in three cases:

    - The run stopped with an error message. The integrator then reported the failure instead of returning a
      wrong state.
    - A run forward is complete, and ``defect`` is None or at most 2^-47 times the number of steps (a bound
      for rounding errors).
    - A run forward and back is complete, and ``returned`` is finite. A large ``returned`` is permitted.
    """

    name: str
    steps: int
    defect: float | None
    returned: float | None
    failure: str = ""

    @property
    def held(self) -> bool:
        """True if the integrator returned no wrong state. The class docstring states the conditions."""
        explained = self.defect is None or self.defect <= 64 * self.steps * 2.0**-53
        return bool(self.failure) or (explained and math.isfinite(self.returned or 0.0))

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON."""
        return {
            "name": self.name,
            "steps": self.steps,
            "manifold_defect": self.defect,
            "returned": self.returned,
            "failure": self.failure,
            "verdict": "holds" if self.held else "fails",
        }


def endure(compiled: Compiled, runner: Emitted) -> tuple[Endurance, ...]:
    """Return the results of two long runs: one forward, the other forward and back to the initial time.

    The step size is a hundredth of the time span. A trial run of :data:`TRIAL` steps precedes the two runs.
    If the trial run fails, only its result is returned.
    """
    first, last = map(float, compiled.scene.span)
    h = (last - first) / 100
    start = time.process_time()
    try:
        runner.integrator.run(runner.initial, h, TRIAL, first)
    except StepFailed as failure:
        return (Endurance("forward", failure.step, None, None, str(failure)),)
    each = max((time.process_time() - start) / TRIAL, 1e-9)
    many, back = (min(n, int(SECONDS / each)) for n in (MANY, BACK))
    return (_forward(compiled, runner, h, many, first), _return(compiled, runner, h, back, first))


def _forward(compiled: Compiled, runner: Emitted, h: float, steps: int, first: float) -> Endurance:
    try:
        end = runner.integrator.run(runner.initial, h, steps, first)
    except StepFailed as failure:
        return Endurance("forward", failure.step, None, None, str(failure))
    laws = functions(compiled.scene).get(MANIFOLD)
    defect = max(map(abs, laws(end, first + steps * h))) if laws is not None else None
    if not all(map(math.isfinite, end)):
        defect = math.inf
    return Endurance("forward", steps, defect, None)


def _return(compiled: Compiled, runner: Emitted, h: float, steps: int, first: float) -> Endurance:
    try:
        end = runner.integrator.run(runner.initial, h, steps, first)
        back = runner.integrator.run(end, -h, steps, first + steps * h)
    except StepFailed as failure:
        return Endurance("forward and back", failure.step, None, None, str(failure))
    return Endurance("forward and back", steps, None, distance(compiled.scene, back, runner.initial))
