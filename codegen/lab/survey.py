"""A survey of a scene: orders, error against run time, stability and long runs of one set of methods.

Each method is compiled once for all parts. How much is measured is an :class:`Effort`.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

from codegen.certify import certified_order
from codegen.emitter import Compiled, compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.lab.adaptive import AdaptiveContestant
from codegen.lab.bench import Bench, Result
from codegen.lab.contest import Contestant, EmittedContestant, PeerContestant
from codegen.lab.journal import Journal
from codegen.lab.longrun import LongRun, longrun
from codegen.lab.needs import Advice, Features, advise, features
from codegen.lab.peers import find, installed
from codegen.lab.records import Records
from codegen.lab.reference import Reference
from codegen.lab.remembered import remembered
from codegen.lab.stability.endurance import Endurance
from codegen.lab.stability.extremes import Answer
from codegen.lab.stability.limits import Limit
from codegen.lab.stability.regions import region
from codegen.lab.stability.stiff import Stiff
from codegen.lab.stability.study import Stability, harsh_variants
from codegen.lab.stability.study import study_method as try_method
from codegen.lab.study import MethodStudy, Tell, study_method
from codegen.lower import families_for
from codegen.method import Method, parse
from codegen.scene.problem import Problem

ORDERS, COST, STABILITY, LONG = PARTS = ("orders", "cost", "stability", "long")
"""The parts of a report, in the order of its pages."""

OF_FIELDS = {"rkmk(0):euler": 1, "cg:cg3": 3, "rkmk(2):rk4": 4, "cf:cf4": 4, "rkmk:butcher6": 6}
OF_HAMILTONIANS = {
    "vcg:midpoint": 2,
    "vcg:triple_jump": 4,
    "vrkmk(2):gauss2": 4,
    "vcf:vcf_gauss2": 4,
    "cf:cf4": 4,
    "splitting:blanes_moan4": 4,
    "splitting:blanes_moan_rkn6a": 6,
}
"""What a report shows where nobody chose: methods that have this order on the scene."""

CHOOSING = ("ambient:dop853", "rkmk(3):dormand_prince5", "cf:cf43")
"""Beside them, by embedded rows; on Hamiltonian scenes the first, so that ten colours serve for all."""


@dataclass(frozen=True)
class Effort:
    """How much is measured.

    ``budget`` are CPU seconds that one run of the bench may take, ``steps`` those of a long run, ``back``
    asks for its way back, ``rounding`` for how rounding grows, ``harsh`` for harsh variants of the scene,
    ``endurance`` for runs of ten million steps.
    """

    budget: float
    peers: tuple[str, ...]
    steps: int
    back: bool
    rounding: bool
    harsh: bool
    endurance: bool


QUICK = Effort(0.002, ("c-dop853",), 10_000, back=False, rounding=False, harsh=False, endurance=False)
USUAL = Effort(0.05, ("c-dop853", "heyoka"), 100_000, back=True, rounding=True, harsh=True, endurance=False)
FULL = Effort(0.5, ("all",), 1_000_000, back=True, rounding=True, harsh=True, endurance=True)


@dataclass(frozen=True)
class Plan:
    """What is to be measured of which scene, all of it read and found to fit."""

    spelled: str
    scene: Problem
    methods: tuple[Method, ...]
    peers: tuple[str, ...]
    effort: Effort
    parts: tuple[str, ...] = PARTS
    adaptive: tuple[Method, ...] = ()


@dataclass(frozen=True)
class Survey:
    """What was found; a part that was not asked for is empty, or None."""

    plan: Plan
    exact: Reference
    features: tuple[Features, ...]
    orders: tuple[MethodStudy, ...]
    cost: Result | None
    advice: tuple[Advice, ...]
    stability: tuple[Stability, ...]
    longruns: tuple[LongRun, ...]

    @property
    def scene(self) -> Problem:
        """The scene."""
        return self.plan.scene

    @property
    def held(self) -> bool:
        """Whether observed orders are the computed ones and no extreme case was answered wrongly."""
        return all(m.verdict == "holds" for m in self.orders) and all(s.honest for s in self.stability)

    def as_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "scene": self.scene.name,
            "methods": [m.as_json() for m in self.orders],
            "cost": [row.as_json() for row in self.cost.rows] if self.cost else [],
            "advice": [
                {"need": a.need, "best": [b and {"method": b[0], "seconds": b[1]} for b in a.best]}
                for a in self.advice
            ],
            "stability": [s.as_json() for s in self.stability],
            "longruns": [run.as_json() for run in self.longruns],
        }


def plan(
    spelled: str,
    scene: Problem,
    methods: Sequence[str] = (),
    peers: Sequence[str] = (),
    effort: Effort = USUAL,
    parts: Sequence[str] = PARTS,
    adaptive: Sequence[str] = (),
) -> Plan:
    """Return the plan of a survey; errors of names and spellings as :func:`codegen.method.parse`.

    Without methods the usual ones are chosen (:func:`usual`), without peers those of the effort that are
    installed. ``adaptive`` are methods that run once more, in steps chosen by their embedded rows.
    """
    families = families_for(scene)
    chosen = tuple(parse(m, families) for m in methods)
    choosing = tuple(replace(parse(m, families), adaptive=True) for m in adaptive)
    for method in choosing:
        method.embedded()
    if not methods and not adaptive:
        chosen, choosing = usual(scene)
    others = tuple(peers) if peers else tuple(p for p in effort.peers if p != "heyoka" or installed(p))
    find(others)
    asked = tuple(p for p in PARTS if p in parts)
    return Plan(spelled, scene, chosen, others, effort, asked, choosing)


def usual(scene: Problem) -> tuple[tuple[Method, ...], tuple[Method, ...]]:
    """Return the methods that are shown where nobody chose, and those that choose their steps.

    Of the list those that the scene can take and that have their order there: a splitting may find no exact
    flow, or parts for which its conditions say less.
    """
    families, found = families_for(scene), []
    for spelling, order in (OF_HAMILTONIANS if scene.is_hamiltonian else OF_FIELDS).items():
        if spelling.partition(":")[0].partition("(")[0] not in families:
            continue
        try:
            method = parse(spelling, families)
            if certified_order(method, scene).order == order:
                found.append(method)
        except MethodError:
            continue
    count = 1 if scene.is_hamiltonian else len(CHOOSING)
    choosing = (replace(parse(spelling, families), adaptive=True) for spelling in CHOOSING[:count])
    return tuple(found), tuple(choosing)


def survey(plan: Plan, tell: Tell, records: Records | None = None) -> Survey:
    """Measure what is planned, but for what is on record; ``tell`` hears what is being done."""
    scene, effort = plan.scene, plan.effort
    records = records or Records(None)
    tell(f"{scene.name}: reference solution")
    exact = remembered(scene)
    made: list[tuple[Compiled, float]] = []
    for method in plan.methods:
        tell(f"{scene.name}, {method.label}: compiling")
        start = time.perf_counter()
        made.append((compile_method(scene, method), time.perf_counter() - start))
    compiled = [c for c, _ in made]
    emissions = [emit_compiled(c, "c", order=certified_order(c.method, scene)) for c in compiled]
    known = list(map(features, compiled, emissions))
    orders: tuple[MethodStudy, ...] = ()
    if ORDERS in plan.parts:
        orders = tuple(study_method(c, exact, tell, records) for c in compiled)
    cost = None
    if COST in plan.parts:
        choosing = [AdaptiveContestant(scene, m, exact, "c", effort.budget) for m in plan.adaptive]
        known += [features(c.compiled, c.runner.emission, c.label) for c in choosing]
        cost = _cost(plan, exact, made, choosing, tell, records)
    advice = advise(cost.entries, known) if cost else ()
    stability: tuple[Stability, ...] = ()
    if STABILITY in plan.parts:
        stability = _stability(plan, exact, compiled, tell, records)
    longruns: list[LongRun] = []
    for c, emission in zip(compiled, emissions, strict=True) if LONG in plan.parts else ():
        tell(f"{scene.name}, {c.method.label}: {effort.steps} steps")
        h = float((scene.span[1] - scene.span[0]) / 100)
        key = ("long", sorted(emission.files.items()), h, effort.steps, effort.back, effort.rounding)

        def measure(c: Compiled = c, h: float = h) -> LongRun:
            return longrun(c, h, effort.steps, back=effort.back, rounding=effort.rounding)

        longruns.append(records.of(key, LongRun, measure))
    return Survey(plan, exact, tuple(known), orders, cost, advice, stability, tuple(longruns))


def _cost(
    plan: Plan,
    exact: Reference,
    made: Sequence[tuple[Compiled, float]],
    choosing: Sequence[AdaptiveContestant],
    tell: Tell,
    records: Records,
) -> Result:
    """Return the bench of all methods, those that choose their steps, and the peers."""
    scene, budget = plan.scene, plan.effort.budget
    contestants: list[Contestant] = []
    for compiled, seconds in made:
        contestant = EmittedContestant(scene, compiled.method, exact, "c", budget, compiled)
        contestant.emission_seconds += seconds
        contestants.append(contestant)
    contestants += choosing
    contestants += [PeerContestant(scene, peer, exact, budget) for peer in find(plan.peers)]
    folder = records.folder
    journal = Journal(folder / f"{scene.name}.journal" if folder else None)
    return Bench(scene, exact, tuple(contestants), None).run(
        lambda row: tell(
            f"{scene.name}, {row.method}: {row.control:g} {'' if row.steps is None else 'steps'}"
        ),
        journal,
    )


@dataclass(frozen=True)
class _Tried:
    """What is put on record of a method's stability: all but the region, which costs nothing."""

    limit: Limit
    answers: tuple[Answer, ...]
    stiff: tuple[Stiff, ...]
    endurance: tuple[Endurance, ...]
    notes: tuple[str, ...]


def _stability(
    plan: Plan, exact: Reference, compiled: Sequence[Compiled], tell: Tell, records: Records
) -> tuple[Stability, ...]:
    scene, effort = plan.scene, plan.effort
    variants, notes = harsh_variants(scene, tell) if effort.harsh else ((), ())
    found = []
    for c in compiled:

        def measure(c: Compiled = c) -> _Tried:
            result = try_method(c, exact, variants, notes, tell, long=effort.endurance)
            return _Tried(*(getattr(result, field.name) for field in fields(_Tried)))

        files = sorted(emit_compiled(c, "c", order=certified_order(c.method, scene)).files.items())
        tried = records.of(
            ("stability", files, exact.digits(), effort.harsh, effort.endurance), _Tried, measure
        )
        found.append(
            Stability(
                scene.name,
                c.method.label,
                region(c.method),
                *(getattr(tried, field.name) for field in fields(_Tried)),
            )
        )
    return tuple(found)
