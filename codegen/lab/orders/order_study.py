"""The order of one method on a scene: convergence of emitted C and Python, their agreement, and times."""

from __future__ import annotations

from collections.abc import Sequence
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

COMPARED = 4 * FIRST
"""Number of steps after which C, Python and the interpreter are compared; larger if a run with it fails."""

MOST_TIMED = 2560
"""Number of steps of the longest run that is timed."""


@dataclass(frozen=True)
class OrderStudy:
    """One method: its certified order, convergence in C and Python, times of the C, and the artifact.

    ``spread`` is the largest difference of a coordinate between emitted C, emitted Python and the interpreter
    after at least :data:`COMPARED` steps; None if no such run succeeds.
    """

    method: Method
    order: CertifiedOrder
    compiled: Convergence
    python: Convergence
    times: tuple[Timing, ...]
    spread: float | None
    artifact: Artifact

    @property
    def verdict(self) -> str:
        """The worse of the verdicts in C and Python."""
        verdicts = (self.compiled.verdict, self.python.verdict)
        return next((v for v in ("fails", "undecided") if v in verdicts), "holds")

    def as_json(self) -> dict[str, object]:
        """Return plain data."""
        return {
            "method": self.method.label,
            "verdict": self.verdict,
            "c": self.compiled.as_json(),
            "python": self.python.as_json(),
            "spread": self.spread,
            "seconds": {str(t.steps): t.seconds for t in self.times},
        }


@dataclass(frozen=True)
class _Measured:
    """The part of a study that is cached."""

    compiled: Refinement
    python: Refinement
    times: tuple[Timing, ...]
    spread: float | None


def order_study(
    compiled: Compiled, exact: Reference, progress: Progress, cache: MeasurementCache | None = None
) -> OrderStudy:
    """Return the study of one compiled method; results that ``cache`` holds are not measured again."""
    scene, method = compiled.scene, compiled.method
    name = f"{scene.name}, {method.label}"
    progress(f"{name}: order conditions")
    order = certified_order(method, scene)
    c, python = Emitted(compiled, "c", order), Emitted(compiled, "python", order)

    def measure() -> _Measured:
        progress(f"{name}: convergence")
        in_c = converge(c, order, exact, to_rounding=True).refinement
        in_python = converge(python, order, exact).refinement
        steps = [r.steps for r in in_c.clean if r.steps <= MOST_TIMED]
        spread = largest_difference((c, python, Interpreted(compiled)), steps)
        progress(f"{name}: times")
        return _Measured(in_c, in_python, timings(c.final, steps), spread)

    key = ("orders", *sorted({**c.artifact.files, **python.artifact.files}.items()), exact.digits())
    measured = (cache or MeasurementCache(None)).get(key, _Measured, measure)
    refinements = {"c": measured.compiled, "python": measured.python}
    results = {t: Convergence(scene.name, method.label, t, order, r) for t, r in refinements.items()}
    return OrderStudy(
        method, order, results["c"], results["python"], measured.times, measured.spread, c.artifact
    )


def largest_difference(runners: Sequence[Runner], steps: Sequence[int]) -> float | None:
    """Return the largest difference of a coordinate between the final states of several runners.

    The number of steps is the first of ``steps``, from :data:`COMPARED` on, that every runner completes. The
    runners may differ here: Newton's method of emitted code solves some steps that are too long for the
    interpreter. None if no number of steps is completed by all runners.
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
