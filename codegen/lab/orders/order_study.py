"""Studies the order of one method on a scene, with the code that is emitted for every target.

A target is a programming language, for example C or Python. The study contains the convergence for every
target, the differences between the results of the targets, and run times.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from codegen.artifact import Artifact
from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import Compiled
from codegen.lab.measurement_cache import MeasurementCache
from codegen.lab.orders.convergence import Convergence, converge, derived_order, visible_uncertainty
from codegen.lab.orders.end_kinks import end_limits
from codegen.lab.orders.step_sizes import FIRST, Refinement
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference
from codegen.lab.runner import Emitted, Interpreted, RunFailed, Runner
from codegen.lab.timing import Timing, timings
from codegen.method import Method
from codegen.printers import DEFAULT, names

COMPARED = 4 * FIRST
"""Final states are compared only if the runs have at least COMPARED steps (:func:`largest_difference`)."""

MOST_TIMED = 2560
"""The number of steps of the longest run whose CPU time is measured."""


@dataclass(frozen=True)
class OrderStudy:
    """The study of the order of one method.

    - ``order``: the order from the order conditions.
    - ``convergences``: for each target (programming language), the runs with different step sizes.
    - ``times``: the CPU times of runs with the default target.
    - ``spread``: the largest difference between the final state of the first target and the final states of
      the other targets and of the interpreter (:func:`largest_difference`). All compared runs have the same
      number n of steps, and n is at least :data:`COMPARED`. If no number n is found with which all runs
      succeed, ``spread`` is None.
    - ``artifact``: the emitted files for the default target.
    """

    method: Method
    order: CertifiedOrder
    convergences: Mapping[str, Convergence]
    times: tuple[Timing, ...]
    spread: float | None
    artifact: Artifact

    @property
    def main(self) -> Convergence:
        """The convergence of the code that is emitted for the default target."""
        return self.convergences[DEFAULT]

    @property
    def verdict(self) -> str:
        """The worst of the verdicts for the targets (programming languages).

        The verdicts, from worst to best, are ``fails``, ``undecided`` and ``holds``.
        """
        verdicts = {c.verdict for c in self.convergences.values()}
        return next((v for v in ("fails", "undecided") if v in verdicts), "holds")

    def as_json(self) -> dict[str, object]:
        """Return plain data for JSON."""
        return {
            "method": self.method.label,
            "verdict": self.verdict,
            **{target: c.as_json() for target, c in self.convergences.items()},
            "spread": self.spread,
            "seconds": {str(t.steps): t.seconds for t in self.times},
        }


@dataclass(frozen=True)
class _Measured:
    """The part of an :class:`OrderStudy` that is stored in the cache."""

    refinements: dict[str, Refinement]
    times: tuple[Timing, ...]
    spread: float | None


def order_study(
    compiled: Compiled, exact: Reference, progress: Progress, cache: MeasurementCache | None = None
) -> OrderStudy:
    """Return the study of the order of one compiled method.

    Results that are stored in ``cache`` are not measured again.
    """
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
    spread, ends, derived = (
        visible_uncertainty(method),
        end_limits(compiled, exact.state),
        derived_order(compiled),
    )
    convergences = {
        target: Convergence(
            scene.name, method.label, target, order, refinement, exact.kinks, spread, ends, derived
        )
        for target, refinement in measured.refinements.items()
    }
    return OrderStudy(method, order, convergences, measured.times, measured.spread, main.artifact)


def largest_difference(runners: Sequence[Runner], steps: Sequence[int]) -> float | None:
    """Compare the final state of the first runner with the final states of the other runners.

    The result is the largest absolute difference of a coordinate. All runners make the same number n of
    steps. The number n is the first entry of ``steps`` with two properties: n is at least :data:`COMPARED`,
    and no run with n steps fails. If there is no such entry, the result is None.
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
