"""Measures an emitted method with step-size control for a work-precision diagram.

The attribute ``control`` of a :class:`Row` is both the relative and the absolute tolerance. The attribute
``steps`` is the number of accepted steps. The CPU time includes rejected steps.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from codegen.integrator import Arrival, Statistics, StepFailed
from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.work_precision import MOST_STEPS, Row
from codegen.lab.runner import RunFailed
from codegen.lab.timing import span_times

TOLERANCES = tuple(10.0**-k for k in range(1, 14))
"""The tolerances of the runs, from loose to tight."""


@dataclass
class AdaptiveCandidate(EmittedCandidate):
    """An emitted method that runs with step-size control.

    MethodError is raised for a method without an error estimate.
    """

    def __post_init__(self) -> None:
        self.method = replace(self.method, adaptive=True)
        super().__post_init__()
        self.label = f"adaptive {self.method.label}"

    def controls(self) -> Iterator[float]:
        """Yield the tolerances, from loose to tight."""
        return iter(TOLERANCES)

    def enough(self, rows: Sequence[Row]) -> bool:
        """Return True if the next run would take too long, or if rounding errors dominate.

        If the last run in ``rows`` diverged, the result is False, because a smaller tolerance may give a
        useful result.
        """
        error = rows[-1].error
        diverged = error is not None and error > max(1.0, math.hypot(*map(float, self.exact.state)))
        return not diverged and super().enough(rows)

    def run(self, control: float, spans: int) -> int:
        """Run with the tolerance ``control``, and return the number of accepted steps.

        The time interval is ``spans`` times as long as the time span of the scene.
        """
        return self.arrive(control, spans=spans).accepted

    def arrive(self, tolerance: float, statistics: Statistics | None = None, spans: int = 1) -> Arrival:
        """Run with the given tolerance. The length of the run is ``spans`` times the time span of the scene.

        RunFailed is raised if a step fails.
        """
        first, last = map(float, self.scene.span)
        try:
            return self.runner.integrator.adaptive(
                self.runner.initial,
                first,
                first + spans * (last - first),
                rtol=tolerance,
                atol=tolerance,
                limit=MOST_STEPS,
                statistics=statistics,
            )
        except StepFailed as error:
            raise RunFailed(str(error)) from error

    def measure(self, control: float) -> Row:
        """Run with the tolerance ``control``, and return the error and the CPU time as a row.

        If the run fails, the row contains the reason.
        """
        first, last = map(float, self.scene.span)
        statistics = Statistics()
        try:
            arrival = self.arrive(control, statistics)
            error = self.error(arrival.state)
            if not math.isfinite(error):
                raise RunFailed("the final state is not finite")
        except ArithmeticError as failure:
            return replace(self._row(control, 0.0, 0, failure=str(failure)), h=None, steps=None)
        times = span_times(lambda n: self.run(control, n), self.overhead)
        tried, accepted = arrival.accepted + arrival.rejected, arrival.accepted
        row = self._row(control, (last - first) / accepted, tried, error, times, statistics)
        return replace(row, steps=accepted, ns_per_step=1e9 * times[0] / accepted)
