"""The stability of methods on a scene: all tables, from the questions of this package."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from codegen.emitter import Compiled, compile_method
from codegen.errors import MethodError, SceneError
from codegen.lab.reference import Reference
from codegen.lab.remembered import remembered
from codegen.lab.runner import Emitted
from codegen.lab.stability.endurance import Endurance, endure
from codegen.lab.stability.extremes import SILENT, WRONG, Answer, answer, cases
from codegen.lab.stability.harsh import VARIANTS, Harsh
from codegen.lab.stability.limits import Limit, largest_step
from codegen.lab.stability.regions import Region, region
from codegen.lab.stability.stiff import Stiff, order_left
from codegen.method import Method
from codegen.scene.problem import Problem

Tell = Callable[[str], object]


@dataclass(frozen=True)
class Stability:
    """What held and what failed of one method on one scene."""

    scene: str
    method: str
    region: Region | None
    limit: Limit
    answers: tuple[Answer, ...]
    stiff: tuple[Stiff, ...]
    endurance: tuple[Endurance, ...]
    notes: tuple[str, ...] = field(default=())

    @property
    def wrong(self) -> tuple[Answer, ...]:
        """The answers that rounding does not explain."""
        return tuple(a for a in self.answers if a.verdict.startswith(WRONG))

    @property
    def honest(self) -> bool:
        """Whether no answer is wrong, and long runs ended well or with a status."""
        return not self.wrong and all(e.held for e in self.endurance)

    @property
    def held(self) -> bool:
        """Whether it is honest and every answer is accurate or a status: none is undetermined."""
        return self.honest and not any(a.verdict == SILENT for a in self.answers)

    def as_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "scene": self.scene,
            "method": self.method,
            "verdict": "holds" if self.held else "fails",
            "linear": None if self.region is None else self.region.as_json(),
            "largest_step": self.limit.as_json(),
            "cases": [a.as_json() for a in self.answers],
            "stiff": [s.as_json() for s in self.stiff],
            "endurance": [e.as_json() for e in self.endurance],
            "notes": list(self.notes),
        }


def study(scene: Problem, methods: Sequence[Method], tell: Tell, *, long: bool = True) -> Iterator[Stability]:
    """Yield the stability of each method on a scene; ``tell`` hears what is being done.

    ``long`` asks for the runs of many steps as well.
    """
    tell(f"{scene.name}: reference solution")
    exact = remembered(scene)
    variants, notes = harsh_variants(scene, tell)
    for method in methods:
        tell(f"{scene.name}, {method.label}: emitting")
        yield study_method(compile_method(scene, method), exact, variants, notes, tell, long=long)


def harsh_variants(scene: Problem, tell: Tell) -> tuple[tuple[tuple[Harsh, Reference], ...], tuple[str, ...]]:
    """Return the harsh variants of a scene with their references, and notes on those that have none."""
    variants: list[tuple[Harsh, Reference]] = []
    notes: list[str] = []
    for make in VARIANTS.get(scene.name, ()):
        harsh = make()
        tell(f"{harsh.name}: reference solution")
        try:
            variants.append((harsh, remembered(harsh.scene)))
        except SceneError as error:
            notes.append(f"{harsh.name}: {error.found}")
    return tuple(variants), tuple(notes)


def study_method(
    compiled: Compiled,
    exact: Reference,
    variants: Sequence[tuple[Harsh, Reference]],
    notes: tuple[str, ...],
    tell: Tell,
    *,
    long: bool = True,
) -> Stability:
    """Return the stability of one compiled method, on its scene and on the harsh variants given."""
    scene, method = compiled.scene, compiled.method
    name = f"{scene.name}, {method.label}"
    runner = Emitted(compiled, "c")
    answers = []
    for case in cases(compiled):
        tell(f"{name}: {case.name}")
        answers.append(answer(compiled, runner, case))
    tell(f"{name}: largest step")
    limit = largest_step(compiled, runner, exact)
    stiff, said = [], list(notes)
    for harsh, reference in variants:
        tell(f"{name}: {harsh.name}")
        try:
            stiff.append(order_left(harsh, method, reference))
        except MethodError as error:
            said.append(f"{harsh.name}: {error.found}")
    tell(f"{name}: long runs")
    endurance = endure(compiled, runner) if long else ()
    return Stability(
        scene.name, method.label, region(method), limit, tuple(answers), tuple(stiff), endurance, tuple(said)
    )
