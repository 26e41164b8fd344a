"""From programs to sweeps over the sites of a lattice (:mod:`codegen.ir.site_step`).

All operations of a step program act on one site alone, except the field, which reads the states of
neighbours. The point at which the field is evaluated must therefore be known at all sites before the
evaluation: it is stored by one sweep, and the next sweep evaluates the field. Sums are never stored, because
adding stored terms again costs less than storing the sum.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

from codegen.errors import MethodError
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel, Let
from codegen.ir.operations import Advance, Linear, Zero
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import Field
from codegen.ir.site_step import RESULT, STATE, WORK, Load, Row, SiteStep, Sweep
from codegen.ir.values import Kind, Var
from codegen.kernel.assignments import Assignments
from codegen.kernel.shared_angles import SharedArguments
from codegen.kernel.site_flows import flow_program
from codegen.lower import lower, lower_composed, problem_for
from codegen.lower import lowering as lowering_of
from codegen.lower.flow_words import FlowLowering
from codegen.method import Method
from codegen.passes import PassReport, optimise
from codegen.scene.problem import TIME, Problem
from codegen.scene.site_scene import with_frozen_neighbours
from codegen.scene.sites import Sites, offset_text

RECOMPUTED = (Linear, Zero, Advance)
"""Operations whose results are computed again in each sweep that reads them."""


def refused(scene: Problem, what: str, expected: str) -> MethodError:
    """Return the error for a method whose step cannot be computed by sweeps over sites."""
    hint = "use an explicit method of the family rkmk, cf, cg, rk or ambient, for example cf:cf4, "
    hint += "or a splitting if the scene has parts"
    return MethodError(what, where=scene.name, expected=expected, hint=hint)


@dataclass(frozen=True)
class SiteMethod:
    """A method on a lattice: the problem of one site, the program before and after each pass, the kernel."""

    problem: Problem
    lowered: Program
    program: Program
    trace: tuple[PassReport, ...]
    kernel: Kernel


def site_method(scene: Problem, method: Method) -> SiteMethod:
    """Return the compiled method. The passes do not read the formulas of the field, so they are verified on
    one site whose neighbours do not move.

    MethodError is raised for implicit methods and for compositions of substeps.
    """
    lowering = lowering_of(method.family)
    if isinstance(lowering, FlowLowering):
        program, kernel = flow_program(scene, method, lowering)
        return SiteMethod(scene, program, program, (), kernel)
    frozen = with_frozen_neighbours(scene)
    problem, lowered = problem_for(frozen, method), lower(frozen, method)
    program, trace = optimise(lowered, problem)
    implicit = any(not isinstance(statement, Assign) for statement in program.body)
    if implicit or lower_composed(frozen, method) is not None:
        what = "implicit stages" if implicit else "substeps"
        expected = "an explicit method that is not a composition of substeps"
        raise refused(scene, f"{method.label} has {what} and cannot be used on a lattice", expected)
    return SiteMethod(problem, lowered, program, trace, site_kernel(program, problem))


def site_kernel(program: Program, problem: Problem) -> Kernel:
    """Return the kernel of an explicit program on the problem of one site
    (:func:`codegen.scene.site_scene.with_frozen_neighbours`)."""
    assert problem.sites is not None
    step = _Planner(program, problem, problem.sites).step()
    (block,) = problem.state
    about = "state of one site; row k of an array of states contains number k of all sites"
    known = tuple(s for s in problem.runtime if s not in problem.sites.names)
    state = (StateBlock(block.name, block.symbols, about),)
    return Kernel(program.name, state, (TIME, "h", *known), (), (), sites=step)


@dataclass
class _Needs:
    """The variables that one sweep computes, loads from its own site, and reads at neighbours."""

    computed: set[Var] = field(default_factory=set)
    loaded: set[Var] = field(default_factory=set)
    around: set[Var] = field(default_factory=set)


@dataclass
class _Planner:
    """Distributes the assignments of a program among sweeps."""

    program: Program
    problem: Problem
    sites: Sites
    sweep_of: dict[Var, int] = field(default_factory=dict)
    makers: dict[Var, Assign] = field(default_factory=dict)
    rows: dict[Var, tuple[Row, ...]] = field(default_factory=dict)

    def step(self) -> SiteStep:
        """Return the step."""
        self._place()
        outputs = tuple(var for _, var in self.program.outputs)
        last = max(self.sweep_of[var] for var in outputs)
        needs = [_Needs() for _ in range(last + 1)]
        for number in range(last, -1, -1):
            roots = [v for later in needs[number + 1 :] for v in (later.loaded | later.around)]
            roots = [v for v in roots if v in self.makers and self.sweep_of[v] == number]
            self._require(number, needs[number], [*roots, *(outputs if number == last else ())])
        count = self._store(needs)
        sweeps = tuple(
            self._sweep(k, need, outputs if k == last else (), needs[k + 1 :]) for k, need in enumerate(needs)
        )
        size = len(self.problem.symbols)
        sites = self.sites
        return SiteStep(sites.dimension, sites.offsets, sites.periodic, sweeps, size, count)

    @property
    def _reads_neighbours(self) -> bool:
        names = set(self.sites.names)
        return any(n.op == "sym" and n.payload in names for n in walk(self.problem.roots))

    def _place(self) -> None:
        """Find for each variable the first sweep that can compute it."""
        for var in self.program.inputs:
            self.sweep_of[var] = 0
        coupled = self._reads_neighbours
        for assign in self.program.assigns():
            places = [self.sweep_of[arg] for arg in assign.args]
            if coupled and isinstance(assign.operation, Field):
                point = assign.args[0]
                places[0] += point in self.makers
            for target in assign.targets:
                self.sweep_of[target] = max(places, default=0)
                self.makers[target] = assign

    def _require(self, number: int, need: _Needs, roots: Iterable[Var]) -> None:
        """Find the variables that a sweep needs for ``roots``."""
        waiting = list(roots)
        while waiting:
            var = waiting.pop()
            if var in need.computed:
                continue
            maker = self.makers.get(var)
            again = maker is not None and isinstance(maker.operation, RECOMPUTED)
            if maker is None or (self.sweep_of[var] < number and not again):
                need.loaded.add(var)
                continue
            need.computed |= set(maker.targets)
            if isinstance(maker.operation, Field):
                need.around.add(maker.args[0])
            waiting += maker.args

    def _store(self, needs: list[_Needs]) -> int:
        """Assign rows of the workspace to stored variables; return the number of rows."""
        size = len(self.problem.symbols)
        for var in self.program.inputs:
            if var.kind is not Kind.REAL:
                self.rows[var] = tuple(Row(STATE, k) for k in range(size))
        used = {v: k for k, need in enumerate(needs) for v in (need.loaded | need.around)}
        around = [need.around for need in needs]
        free: list[int] = []
        count = 0
        for number, need in enumerate(needs):
            # A sweep may overwrite values that it reads for the last time, unless other sites read them too.
            done = [v for v in self.rows if used.get(v) == number and v not in around[number]]
            done += [v for v in self.rows if used.get(v) == number - 1 and v in around[number - 1]]
            ended = [r.number for v in self._ordered(done) for r in self.rows[v] if r.array == WORK]
            free = sorted({*free, *ended})
            for var in self._ordered(need.computed):
                if self.sweep_of[var] != number or used.get(var, -1) <= number:
                    continue
                width = self._width(var)
                chosen, free = free[:width], free[width:]
                chosen += range(count, count + width - len(chosen))
                count = max(count, max(chosen) + 1)
                self.rows[var] = tuple(Row(WORK, k) for k in chosen)
        return count

    def _ordered(self, variables: Iterable[Var]) -> list[Var]:
        """Return variables in the order of the program."""
        wanted = set(variables)
        listed = [*self.program.inputs, *(t for a in self.program.assigns() for t in a.targets)]
        return [v for v in listed if v in wanted]

    def _width(self, var: Var) -> int:
        if var.kind is Kind.REAL:
            return 1
        return len(self.problem.symbols) if var.kind is Kind.POINT else self._algebra(var)

    def _algebra(self, var: Var) -> int:
        if var.kind is Kind.ALG:
            return self.problem.group.dim
        if var.kind is Kind.GROUP:
            return self.problem.group.size
        raise refused(self.problem, f"the value {var.name} of the step is a momentum", "a vector field")

    def _sweep(self, number: int, need: _Needs, outputs: tuple[Var, ...], later: list[_Needs]) -> Sweep:
        read = {v for other in later for v in (other.loaded | other.around)}
        kept = [
            v
            for v in self._ordered(need.computed)
            if self.sweep_of[v] == number and v in self.rows and v in read
        ]
        executed = [a for a in self.program.assigns() if set(a.targets) & need.computed]
        run = _Execution(self.program.name, self.problem, self.sites, self.rows, self.makers)
        run.begin(self._ordered(need.loaded | need.around))
        for assign in executed:
            run.execute(assign)
        stores = [row for v in kept for row in self.rows[v]]
        size = len(self.problem.symbols)
        stores += [Row(RESULT, k) for _ in outputs for k in range(size)]
        shown = "; ".join(a.text() for a in executed if not isinstance(a.operation, RECOMPUTED))
        return run.sweep(shown, [*kept, *outputs], tuple(stores))


class _Execution:
    """The symbolic execution of one sweep."""

    def __init__(
        self,
        name: str,
        problem: Problem,
        sites: Sites,
        rows: dict[Var, tuple[Row, ...]],
        makers: dict[Var, Assign],
    ) -> None:
        self.name, self.problem, self.sites = name, problem, sites
        self.rows, self.makers = rows, makers
        self.domain = SharedArguments()
        self.env: dict[Var, Any] = {}
        self.hints: dict[int, str] = {}
        self.loads: dict[str, Load] = {}
        # Names that users have chosen are reserved, so no computed value gets one of these names.
        self.taken = {*problem.symbols, *problem.runtime, "h", TIME}
        self.ghosts: dict[str, Expr] = {}
        self.named: dict[Var, tuple[str, ...]] = {}

    def begin(self, variables: Iterable[Var]) -> None:
        """Set the values that earlier sweeps have stored, and the time."""
        for var in variables:
            if var.kind is Kind.REAL:
                self.env[var] = self.domain.space.sym(var.name)
                continue
            names = self._names(var)
            self.loads |= {s: Load(s, r) for s, r in zip(names, self.rows[var], strict=True)}
            self.env[var] = tuple(map(self.domain.space.sym, names))

    def _names(self, var: Var) -> tuple[str, ...]:
        if var not in self.makers:
            return self.problem.symbols
        if var not in self.named:
            self.named[var] = tuple(self._fresh(f"{var.name}_{k}") for k in range(len(self.rows[var])))
        return self.named[var]

    def execute(self, assign: Assign) -> None:
        """Execute an assignment."""
        args = tuple(self.env[a] for a in assign.args)
        operation = assign.operation
        if isinstance(operation, Field):
            results: tuple[Any, ...] = (self._field(assign.args[0], *args),)
        else:
            results = operation.evaluate(self.problem, self.domain, args)
        for target, value in zip(assign.targets, results, strict=True):
            self.env[target] = value
            for k, x in enumerate(flatten(target.kind, value)):
                self.hints.setdefault(x.id, target.name if target.kind is Kind.REAL else f"{target.name}_{k}")

    def _field(self, var: Var, point: tuple[Expr, ...], *time: Expr) -> tuple[Expr, ...]:
        """Return the field at a point whose values at all sites are stored."""
        values = self.problem.values(self.domain, point, *time)
        names = self._names(var)
        for number, (offset, symbols) in enumerate(zip(self.sites.offsets, self.sites.symbols, strict=True)):
            loaded = [f"{name}_{offset_text(offset)}" for name in names]
            if var in self.makers:
                loaded = [self._fresh(name) for name in loaded]
            for symbol, own, row in zip(symbols, loaded, self.rows[var], strict=True):
                values[symbol] = self.domain.space.sym(own)
                self.loads[own] = Load(own, row, number)
            if self.sites.outside:
                formulas = evaluate(list(self.sites.outside[number]), self.domain, values)
                self.ghosts |= dict(zip(loaded, formulas, strict=True))
        return tuple(evaluate(list(self.problem.roots), self.domain, values))

    def _fresh(self, base: str) -> str:
        candidate = base if base not in self.taken else base + "_"
        while candidate in self.taken:
            candidate += "_"
        self.taken.add(candidate)
        return candidate

    def sweep(self, about: str, kept: Iterable[Var], stores: tuple[Row, ...]) -> Sweep:
        """Return the sweep that stores some variables."""
        ends = [x for v in kept for x in flatten(v.kind, self.env[v])]
        kernel = self._scheduled(ends)
        read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"}
        around = [s for s in read if s in self.ghosts]
        outside = None
        if around:
            ghosts = {s: self.ghosts[s] for s in self.loads if s in around}
            outside = self._scheduled(list(ghosts.values()))
            read |= {n.payload for n in walk(outside.expressions()) if n.op == "sym"}
        loads = tuple(load for symbol, load in self.loads.items() if symbol in read)
        return Sweep(about, kernel, loads, stores, outside)

    def _scheduled(self, ends: list[Expr]) -> Kernel:
        schedule = Assignments((), ends, self.hints, self._fresh)
        body = tuple(_lets(schedule.run()))
        symbols = tuple(self.loads)
        scalars = (TIME, "h", *self.problem.runtime)
        state = (StateBlock("site", symbols, "the numbers that the sweep reads"),)
        return Kernel(self.name, state, scalars, body, schedule.outputs)


def _lets(body: Iterable[object]) -> Iterator[Let]:
    for statement in body:
        assert isinstance(statement, Let)
        yield statement
