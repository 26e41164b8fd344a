"""A method that chooses its steps by its embedded row, over a ladder of tolerances, as a contestant.

Its rows stand beside those of equal steps and of peers: ``control`` is the tolerance, relative and absolute
alike, ``steps`` counts the steps made; those refused are paid for in evaluations and in time.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from codegen.lab.contest import MOST_STEPS, EmittedContestant, Row
from codegen.lab.distance import distance
from codegen.lab.runner import RunFailed
from codegen.lab.timing import samples
from codegen.loader import Arrival, Statistics, StepFailed

TOLERANCES = tuple(10.0**-k for k in range(1, 14))
"""From loose to tight, and looser than those of peers: a row of low order steers a method of high order."""


@dataclass
class AdaptiveContestant(EmittedContestant):
    """A method with an embedded row, emitted to a target, that runs over the span in steps of its own choice.

    MethodError for a method without an estimate of its error.
    """

    def __post_init__(self) -> None:
        self.method = replace(self.method, adaptive=True)
        super().__post_init__()
        self.label = f"adaptive {self.method.label}"

    def controls(self) -> Iterator[float]:
        """Tighten the tolerance."""
        yield from TOLERANCES

    def enough(self, rows: Sequence[Row]) -> bool:
        """Stop as others do, but not where a loose tolerance let the run go astray: that takes many steps."""
        error = rows[-1].error
        astray = error is not None and error > max(1.0, math.hypot(*map(float, self.exact.state)))
        return not astray and super().enough(rows)

    def arrive(self, tolerance: float, statistics: Statistics | None = None) -> Arrival:
        """Return where a run with that tolerance ends; a tolerance of infinity ends where it begins."""
        first, last = map(float, self.scene.span)
        if math.isinf(tolerance):
            last, tolerance = first, 1.0
        try:
            return self.runner.integrator.adaptive(
                self.runner.initial,
                first,
                last,
                rtol=tolerance,
                atol=tolerance,
                limit=MOST_STEPS,
                statistics=statistics,
            )
        except StepFailed as error:
            raise RunFailed(str(error)) from error

    def measure(self, control: float) -> Row:
        """Run over the span with the tolerance ``control``."""
        first, last = map(float, self.scene.span)
        statistics = Statistics()
        try:
            found = self.arrive(control, statistics)
            error = distance(self.scene, found.state, self.exact.state)
            if not math.isfinite(error):
                raise RunFailed("the final state is not finite")
        except RunFailed as failure:
            return replace(self._row(control, 0.0, 0, failure=str(failure)), h=None, steps=None)
        times = self._net(samples(lambda: self.arrive(control)), lambda: self.arrive(math.inf))
        tried, made = found.accepted + found.rejected, found.accepted
        row = self._row(control, (last - first) / made, tried, error, times, statistics)
        return replace(row, steps=made, ns_per_step=1e9 * times[0] / made)
