"""A survey of a scene: orders, error against run time, stability and long runs of one set of methods.

Each method is compiled once for all parts. How much is measured is an :class:`Effort`.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

from codegen.certify import certified_order
from codegen.emit import Compiled, compile_method, emit_compiled
from codegen.errors import MethodError
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
from codegen.setting import Setting

ORDERS, COST, STABILITY, LONG = PARTS = ("orders", "cost", "stability", "long")
"""The parts of a report, in the order of its pages."""

OF_FIELDS = ("rkmk(0):euler", "cg:cg3", "rkmk(2):rk4", "cf:cf4", "rkmk:butcher6")
OF_HAMILTONIANS = (
    *("vcg:midpoint", "vcg:triple_jump", "vrkmk(2):gauss2", "vcf:vcf_gauss2", "cf:cf4"),
    *("splitting:blanes_moan_rkn6a", "splitting:blanes_moan4"),
)
"""What a report shows where nobody chose; of these what the scene can take."""


@dataclass(frozen=True)
class Effort:
    """How much is measured.

    ``budget`` are CPU seconds that one run of the bench may take, ``steps`` those of a long run, ``back``
    asks for its way back, ``harsh`` for harsh variants of the scene, ``endurance`` for runs of ten million
    steps.
    """

    budget: float
    peers: tuple[str, ...]
    steps: int
    back: bool
    harsh: bool
    endurance: bool


QUICK = Effort(0.002, ("c",), 10_000, back=False, harsh=False, endurance=False)
USUAL = Effort(0.05, ("c", "heyoka"), 100_000, back=True, harsh=True, endurance=False)
FULL = Effort(0.5, ("all",), 1_000_000, back=True, harsh=True, endurance=True)


@dataclass(frozen=True)
class Plan:
    """What is to be measured of which scene, all of it read and found to fit."""

    spelled: str
    scene: Setting
    methods: tuple[Method, ...]
    peers: tuple[str, ...]
    effort: Effort
    parts: tuple[str, ...] = PARTS


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
    def scene(self) -> Setting:
        """The scene."""
        return self.plan.scene

    @property
    def held(self) -> bool:
        """Whether observed orders are the computed ones and every extreme case was answered honestly."""
        return all(m.verdict == "holds" for m in self.orders) and all(s.held for s in self.stability)

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
    scene: Setting,
    methods: Sequence[str] = (),
    peers: Sequence[str] = (),
    effort: Effort = USUAL,
    parts: Sequence[str] = PARTS,
) -> Plan:
    """Return the plan of a survey; errors of names and spellings as :func:`codegen.method.parse`.

    Without methods those of the usual ones that the scene can take are chosen, without peers those of the
    effort that are installed.
    """
    families = families_for(scene)
    chosen = tuple(parse(m, families) for m in methods) if methods else usual(scene)
    others = tuple(peers) if peers else tuple(p for p in effort.peers if p != "heyoka" or installed(p))
    find(others)
    return Plan(spelled, scene, chosen, others, effort, tuple(p for p in PARTS if p in parts))


def usual(scene: Setting) -> tuple[Method, ...]:
    """Return the methods that are shown where nobody chose: those that the scene can take."""
    families, found = families_for(scene), []
    for spelling in OF_HAMILTONIANS if scene.is_hamiltonian else OF_FIELDS:
        if spelling.partition(":")[0].partition("(")[0] not in families:
            continue
        try:
            method = parse(spelling, families)
            certified_order(method, scene)
        except MethodError:
            continue  # a splitting whose condition on the parts does not hold, or without exact flows
        found.append(method)
    return tuple(found)


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
    known = tuple(map(features, compiled, emissions))
    orders: tuple[MethodStudy, ...] = ()
    if ORDERS in plan.parts:
        orders = tuple(study_method(c, exact, tell, records) for c in compiled)
    cost = _cost(plan, exact, made, tell, records) if COST in plan.parts else None
    advice = advise(cost.entries, known) if cost else ()
    stability: tuple[Stability, ...] = ()
    if STABILITY in plan.parts:
        stability = _stability(plan, exact, compiled, tell, records)
    longruns: list[LongRun] = []
    for c, emission in zip(compiled, emissions, strict=True) if LONG in plan.parts else ():
        tell(f"{scene.name}, {c.method.label}: {effort.steps} steps")
        h = float((scene.span[1] - scene.span[0]) / 100)
        key = ("long", sorted(emission.files.items()), h, effort.steps, effort.back)
        longruns.append(
            records.of(key, LongRun, lambda c=c, h=h: longrun(c, h, effort.steps, back=effort.back))  # type: ignore[misc]
        )
    return Survey(plan, exact, known, orders, cost, advice, stability, tuple(longruns))


def _cost(
    plan: Plan, exact: Reference, made: Sequence[tuple[Compiled, float]], tell: Tell, records: Records
) -> Result:
    """Return the bench of all methods and the peers."""
    scene, budget = plan.scene, plan.effort.budget
    contestants: list[Contestant] = []
    for compiled, seconds in made:
        contestant = EmittedContestant(scene, compiled.method, exact, "c", budget, compiled)
        contestant.emission_seconds += seconds
        contestants.append(contestant)
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
