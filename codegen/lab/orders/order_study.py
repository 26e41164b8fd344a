"""Studies the order of one method on a scene: convergence for every target, differences between targets, and
run times.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from codegen.artifact import Artifact
from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import Compiled
from codegen.lab.measurement_cache import MeasurementCache
from codegen.lab.orders.convergence import Convergence, converge
from codegen.lab.orders.step_sizes import FIRST, Refinement
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference
from codegen.lab.runner import Emitted, Interpreted, RunFailed, Runner
from codegen.lab.timing import Timing, timings
from codegen.method import Method
from codegen.printers import DEFAULT, names

COMPARED = 4 * FIRST
"""The number of steps after which the final states of all targets and of the interpreter are compared.

If a run with this number of steps fails, a larger number is used.
"""

MOST_TIMED = 2560
"""The number of steps of the longest run whose CPU time is measured."""


@dataclass(frozen=True)
class OrderStudy:
    """The study of one method: its certified order, and its convergence for each target, such as C or Python.

    ``times`` and ``artifact`` belong to the default target. ``spread`` is the largest difference of a
    coordinate between the final states of all targets and of the interpreter. If every tested number of steps
    makes at least one run fail, ``spread`` is None.
    """

    method: Method
    order: CertifiedOrder
    convergences: Mapping[str, Convergence]
    times: tuple[Timing, ...]
    spread: float | None
    artifact: Artifact

    @property
    def main(self) -> Convergence:
        """The convergence in the default target."""
        return self.convergences[DEFAULT]

    @property
    def verdict(self) -> str:
        """The worst verdict among all targets."""
        verdicts = {c.verdict for c in self.convergences.values()}
        return next((v for v in ("fails", "undecided") if v in verdicts), "holds")

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON."""
        return {
            "method": self.method.label,
            "verdict": self.verdict,
            **{target: c.as_json() for target, c in self.convergences.items()},
            "spread": self.spread,
            "seconds": {str(t.steps): t.seconds for t in self.times},
        }


@dataclass(frozen=True)
class _Measured:
    """The measured part of an order study, as the cache stores it."""

    refinements: dict[str, Refinement]
    times: tuple[Timing, ...]
    spread: float | None


def order_study(
    compiled: Compiled, exact: Reference, progress: Progress, cache: MeasurementCache | None = None
) -> OrderStudy:
    """Return the study of one compiled method. Results in ``cache`` are not measured again."""
    scene, method = compiled.scene, compiled.method
    name = f"{scene.name}, {method.label}"
    progress(f"{name}: order conditions")
    order = certified_order(method, scene)
    runners = {target: Emitted(compiled, target, order) for target in names()}
    main = runners[DEFAULT]

    def refinement(runner: Emitted) -> Refinement:
        return converge(runner, order, exact, to_rounding=runner is main).refinement

    def measure() -> _Measured:
        progress(f"{name}: convergence")
        refinements = {target: refinement(runner) for target, runner in runners.items()}
        steps = [r.steps for r in refinements[DEFAULT].clean if r.steps <= MOST_TIMED]
        spread = largest_difference((*runners.values(), Interpreted(compiled)), steps)
        progress(f"{name}: times")
        return _Measured(refinements, timings(main.final, steps), spread)

    files = [(target, *sorted(runner.artifact.files.items())) for target, runner in runners.items()]
    key = ("orders", *files, exact.digits())
    measured = (cache or MeasurementCache(None)).get(key, _Measured, measure)
    convergences = {
        target: Convergence(scene.name, method.label, target, order, refinement, exact.kinks)
        for target, refinement in measured.refinements.items()
    }
    return OrderStudy(method, order, convergences, measured.times, measured.spread, main.artifact)


def largest_difference(runners: Sequence[Runner], steps: Sequence[int]) -> float | None:
    """Return the largest difference of a coordinate between the final states of several runners.

    The function uses the first number in ``steps`` that is at least :data:`COMPARED` and with which all
    runners succeed. If there is no such number, the result is None.
    """
    for n in steps:
        if n < COMPARED:
            continue
        try:
            first, *others = (runner.final(n) for runner in runners)
        except RunFailed:
            continue
        return max(float(abs(x - y)) for other in others for x, y in zip(first, other, strict=True))
    return None
