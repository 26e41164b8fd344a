"""The stability study of one method on a scene: all tests of :mod:`codegen.lab.stability`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from codegen.emitter import Compiled, compile_method
from codegen.errors import MethodError, SceneError
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference, cached_reference
from codegen.lab.runner import Emitted
from codegen.lab.stability.endurance import Endurance, endure
from codegen.lab.stability.extreme_steps import SILENT, WRONG, Answer, answer, cases
from codegen.lab.stability.largest_step import Limit, largest_step
from codegen.lab.stability.linear_stability import Region, region
from codegen.lab.stability.order_reduction import OrderReduction, order_reduction
from codegen.method import Method
from codegen.scene.problem import Problem
from codegen.scene.stiff_variant import StiffVariant
from codegen.scenes import stiff_variants
from orderconds.errors import InputError


@dataclass(frozen=True)
class Findings:
    """The results of the stability tests that execute steps of the method.

    - ``limit``: the largest usable step size.
    - ``answers``: for each step with extreme input, the verdict on the result of the step, and the relative
      error of this result.
    - ``stiff``: for each stiff variant of the scene, the errors of the runs and the observed order.
    - ``endurance``: the results of the runs of many steps.
    - ``notes``: for each stiff variant that was not tested, the reason.
    """

    limit: Limit
    answers: tuple[Answer, ...]
    stiff: tuple[OrderReduction, ...]
    endurance: tuple[Endurance, ...]
    notes: tuple[str, ...] = field(default=())


@dataclass(frozen=True)
class Stability:
    """The results of all stability tests of one method on one scene.

    ``region`` contains the stability function and the stability intervals of the tableau. If the stability
    function is not known, ``region`` is None.
    """

    scene: str
    method: str
    region: Region | None
    findings: Findings

    @property
    def wrong(self) -> tuple[Answer, ...]:
        """The entries of ``findings.answers`` with a wrong result.

        A result is wrong if rounding errors cannot explain its error.
        """
        return tuple(a for a in self.findings.answers if a.verdict.startswith(WRONG))

    @property
    def honest(self) -> bool:
        """True if every endurance run passed, and no step with extreme input has a wrong result."""
        return not self.wrong and all(e.held for e in self.findings.endurance)

    @property
    def held(self) -> bool:
        """True if every endurance run passed, and no step with extreme input has a wrong or undetermined
        result.

        A result is undetermined if rounding errors leave too few correct digits.
        """
        return self.honest and not any(a.verdict == SILENT for a in self.findings.answers)

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON."""
        results = self.findings
        return {
            "scene": self.scene,
            "method": self.method,
            "verdict": "holds" if self.held else "fails",
            "failure": "",
            "linear": None if self.region is None else self.region.as_json(),
            "largest_step": results.limit.as_json(),
            "cases": [a.as_json() for a in results.answers],
            "stiff": [s.as_json() for s in results.stiff],
            "endurance": [e.as_json() for e in results.endurance],
            "notes": list(results.notes),
        }


@dataclass(frozen=True)
class NotTested:
    """The name of a method that could not be tested, the name of the scene, and the reason (``failure``)."""

    scene: str
    method: str
    failure: str
    held = False

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON."""
        return {"scene": self.scene, "method": self.method, "verdict": "fails", "failure": self.failure}


@dataclass(frozen=True)
class StiffScenes:
    """The stiff variants of a scene with their reference solutions.

    For each variant without a reference solution, ``notes`` contains the reason.
    """

    variants: tuple[tuple[StiffVariant, Reference], ...] = ()
    notes: tuple[str, ...] = ()


def stability(
    scene: Problem, methods: Sequence[Method], progress: Progress, *, endurance: bool = True
) -> Iterator[Stability | NotTested]:
    """Test the stability of each method on a scene, and yield the results of one method at a time.

    If ``endurance`` is True, runs of many steps are included. For a method that cannot be tested, the result
    is a :class:`NotTested` with the reason.
    """
    progress(f"{scene.name}: reference solution")
    exact = reference_or_reason(scene)
    stiff = stiff_scenes(scene, progress)
    for method in methods:
        progress(f"{scene.name}, {method.label}: emitting")
        try:
            compiled = compile_method(scene, method)
            results = findings(compiled, exact, stiff, progress, endurance=endurance)
            yield Stability(scene.name, method.label, region(method), results)
        except (InputError, ArithmeticError) as error:
            yield NotTested(scene.name, method.label, str(error))


def reference_or_reason(scene: Problem) -> Reference | str:
    """Return the reference solution of a scene, or the reason why it could not be computed."""
    try:
        return cached_reference(scene)
    except SceneError as error:
        return str(error)


def stiff_scenes(scene: Problem, progress: Progress) -> StiffScenes:
    """Return the stiff variants of a scene with their reference solutions.

    If the reference solution of a variant cannot be computed, the result contains the reason.
    """
    variants: list[tuple[StiffVariant, Reference]] = []
    notes: list[str] = []
    for variant in stiff_variants(scene):
        progress(f"{variant.name}: reference solution")
        try:
            variants.append((variant, cached_reference(variant.scene)))
        except SceneError as error:
            notes.append(f"{variant.name}: {error.found}")
    return StiffScenes(tuple(variants), tuple(notes))


def findings(
    compiled: Compiled,
    exact: Reference | str,
    stiff: StiffScenes,
    progress: Progress,
    *,
    endurance: bool = True,
) -> Findings:
    """Run the stability tests of one compiled method on its scene and on the stiff variants ``stiff``.

    ``exact`` is the reference solution of the scene, or the reason why it could not be computed.
    """
    method = compiled.method
    name = f"{compiled.scene.name}, {method.label}"
    runner = Emitted(compiled)
    answers = []
    for case in cases(compiled):
        progress(f"{name}: {case.name}")
        answers.append(answer(compiled, runner, case))
    progress(f"{name}: largest step")
    limit = (
        Limit(None, None, f"not measured: {exact}")
        if isinstance(exact, str)
        else largest_step(compiled, runner, exact)
    )
    reductions, notes = [], list(stiff.notes)
    for variant, reference in stiff.variants:
        progress(f"{name}: {variant.name}")
        try:
            reductions.append(order_reduction(variant, method, reference))
        except MethodError as error:
            notes.append(f"{variant.name}: {error.found}")
    progress(f"{name}: long runs")
    runs = endure(compiled, runner) if endurance else ()
    return Findings(limit, tuple(answers), tuple(reductions), runs, tuple(notes))
