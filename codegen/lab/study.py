"""What the report shows of a scene: orders from conditions, ladders, times, and what emission left out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from codegen.artifact import Artifact
from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import Compiled, compile_method
from codegen.lab.converge import Convergence, converge
from codegen.lab.ladder import FIRST, Ladder
from codegen.lab.records import Records
from codegen.lab.reference import Reference
from codegen.lab.remembered import remembered
from codegen.lab.runner import Emitted, Interpreted, RunFailed, Runner
from codegen.lab.timing import Timing, timings
from codegen.lower import families_for
from codegen.method import Method, parse
from codegen.scene.problem import Problem

FIELD_METHODS = ("rkmk(0):euler", "cg:cg3", "rkmk(2):rk4", "cf:cf4")
HAMILTONIAN_METHODS = ("vcg:midpoint", "vcg:triple_jump", "cf:cf4", "vcg:triple_jump6")
"""What is shown where nobody chose: one method an order, of several families."""

COMPARED = 4 * FIRST
"""Steps of the run in which the executors are compared; more where that many are too few to be run."""

MOST_TIMED = 2560
"""Steps of the longest run that is timed."""

Tell = Callable[[str], object]


@dataclass(frozen=True)
class MethodStudy:
    """One method: its order, its ladders in emitted C and Python, times of the C, and the emission.

    ``spread`` is the largest difference of any coordinate between emitted C, emitted Python and the
    interpreter after :data:`COMPARED` steps, or as many as the ladder needs; None where nothing ran.
    """

    method: Method
    order: CertifiedOrder
    compiled: Convergence
    python: Convergence
    times: tuple[Timing, ...]
    spread: float | None
    emission: Artifact

    @property
    def verdict(self) -> str:
        """The worse of the two ladders' verdicts."""
        verdicts = (self.compiled.verdict, self.python.verdict)
        return next((v for v in ("fails", "undecided") if v in verdicts), "holds")

    def as_json(self) -> dict[str, Any]:
        """Return the measurements as plain data."""
        return {
            "method": self.method.label,
            "verdict": self.verdict,
            "c": self.compiled.as_json(),
            "python": self.python.as_json(),
            "spread": self.spread,
            "seconds": {str(t.steps): t.seconds for t in self.times},
        }


@dataclass(frozen=True)
class Study:
    """A scene, as ``spelled`` by the user, with its reference and what each method did on it."""

    spelled: str
    scene: Problem
    exact: Reference
    methods: tuple[MethodStudy, ...]


def methods_for(scene: Problem, spellings: Sequence[str] = ()) -> tuple[Method, ...]:
    """Return the methods of those spellings, or the usual ones of a scene of this kind."""
    usual = HAMILTONIAN_METHODS if scene.is_hamiltonian else FIELD_METHODS
    families = families_for(scene)
    return tuple(parse(spelling, families) for spelling in (spellings or usual))


def study(spelled: str, scene: Problem, methods: Sequence[Method], tell: Tell) -> Study:
    """Measure methods on a scene; ``tell`` hears what is being done."""
    tell(f"{scene.name}: reference solution")
    exact = remembered(scene)
    found = []
    for method in methods:
        tell(f"{scene.name}, {method.label}: compiling")
        found.append(study_method(compile_method(scene, method), exact, tell))
    return Study(spelled, scene, exact, tuple(found))


@dataclass(frozen=True)
class Measured:
    """What is measured of one method for its order: the ladders of C and Python, times, and the spread."""

    compiled: Ladder
    python: Ladder
    times: tuple[Timing, ...]
    spread: float | None


def study_method(
    compiled: Compiled, exact: Reference, tell: Tell, records: Records | None = None
) -> MethodStudy:
    """Return the study of one method; what was measured before is taken from ``records``."""
    scene, method = compiled.scene, compiled.method
    name = f"{scene.name}, {method.label}"
    tell(f"{name}: order conditions")
    order = certified_order(method, scene)
    c, python = Emitted(compiled, "c", order), Emitted(compiled, "python", order)

    def measure() -> Measured:
        tell(f"{name}: convergence")
        ladder = converge(c, order, exact, to_rounding=True).ladder
        observed = converge(python, order, exact).ladder
        steps = [r.steps for r in ladder.clean if r.steps <= MOST_TIMED]
        spread = _spread((c, python, Interpreted(compiled)), steps)
        tell(f"{name}: times")
        return Measured(ladder, observed, timings(c.final, steps), spread)

    key = ("orders", *sorted({**c.emission.files, **python.emission.files}.items()), exact.digits())
    found = (records or Records(None)).of(key, Measured, measure)
    ladders = {"c": found.compiled, "python": found.python}
    seen = {t: Convergence(scene.name, method.label, t, order, ladder) for t, ladder in ladders.items()}
    return MethodStudy(method, order, seen["c"], seen["python"], found.times, found.spread, c.emission)


def _spread(runners: Sequence[Runner], steps: Sequence[int]) -> float | None:
    """Return how far the runners' ends are apart after the first of ``steps`` from COMPARED on that all make.

    Steps that Newton's method makes in emitted code may be too long for the interpreter.
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
