"""Distributes the assignments of a program among sweeps over the sites of a lattice.

A sweep is a loop over all sites. If the field reads a value at neighbours, one sweep stores the value at all
sites, and a later sweep evaluates the field. An implicit method solves equations u = g(u) by iteration, and
every iteration executes the same sweeps. The value g(u) is called the image of the unknown u.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice

from codegen.errors import MethodError
from codegen.ir.expr import walk
from codegen.ir.operations import Linear
from codegen.ir.program import Assign, Program, Solve
from codegen.ir.site_operations import Total
from codegen.ir.site_step import RESULT, STATE, WORK, Row, SiteBlock, SiteStep, Sweep
from codegen.ir.values import Kind, Var
from codegen.kernel.assignments import unique_name
from codegen.kernel.site_execution import EVALUATED, RECOMPUTED, Content, Execution, blocks_of
from codegen.kernel.site_newton import Linearisation
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import Sites

MEASURED = 2
"""The stopping rule uses this number of rows of the workspace.

Each of the rows has one entry for each site. In one row, the entry is the largest change of the unknowns of
the site. In the other row, the entry is the largest absolute value of these unknowns.
"""


@dataclass
class _Needs:
    """Three sets of variables: those that a sweep computes (``computed``), those that it reads at the site
    itself (``loaded``), and those that it reads at neighbours (``around``).
    """

    computed: set[Var] = field(default_factory=set)
    loaded: set[Var] = field(default_factory=set)
    around: set[Var] = field(default_factory=set)


@dataclass(frozen=True)
class _Block:
    """A system of implicit equations that is solved by iteration.

    Each iteration executes the sweeps (loops over all sites) with the indices ``first`` to ``last``.
    """

    solve: Solve
    first: int
    last: int

    def copies(self, number: int) -> tuple[tuple[Var, Var], ...]:
        """Return pairs (unknown, new value) for the sweep with the index ``number``.

        A sweep is a loop over all sites. Each iteration of the solver executes the sweeps with the indices
        ``first`` to ``last``. Before the first iteration, the sweep with the index ``first`` - 1 sets the
        unknowns to the starting values ``solve.starts``. In each iteration, the sweep with the index ``last``
        sets the unknowns to ``solve.images``. For all other sweeps, the result is empty.
        """
        values = {self.first - 1: self.solve.starts, self.last: self.solve.images}.get(number, ())
        return tuple(zip(self.solve.unknowns, values, strict=True)) if values else ()


@dataclass
class Planner:
    """Distributes the assignments of a program among sweeps (loops over all sites)."""

    program: Program
    problem: Problem
    sites: Sites
    sweep_of: dict[Var, int] = field(default_factory=dict)
    makers: dict[Var, Assign] = field(default_factory=dict)
    rows: dict[Var, tuple[Row, ...]] = field(default_factory=dict)
    blocks: list[_Block] = field(default_factory=list)
    order: list[Assign] = field(default_factory=list)
    renamed: dict[Var, Var] = field(default_factory=dict)
    sums: set[Var] = field(default_factory=set)
    totals: dict[Var, Assign] = field(default_factory=dict)
    newton: bool = False

    def step(self) -> SiteStep:
        """Return the step of the program as a sequence of sweeps."""
        self._place()
        self._choose_sums()
        outputs = tuple(self.renamed.get(var, var) for _, var in self.program.outputs)
        # The outputs are computed after the last iteration, when all unknowns are known.
        least = max((block.last + 1 for block in self.blocks), default=0)
        last = max([least, *(self.sweep_of[var] for var in outputs)])
        needs = [_Needs() for _ in range(last + 1)]
        # The sweeps are planned backwards, because a sweep must store what later sweeps read.
        for number in range(last, -1, -1):
            roots = [v for later in needs[number + 1 :] for v in (later.loaded | later.around)]
            roots = [v for v in roots if v in self.makers and self.sweep_of[v] == number]
            roots += self._terms(number)
            roots += [value for block in self.blocks for _, value in block.copies(number)]
            need = needs[number]
            self._require(number, need, [*roots, *(outputs if number == last else ())])
            # The last sweep of an iteration compares the new values of the unknowns with the old values, so
            # it also reads the old values.
            need.loaded |= {u for b in self.blocks if b.last == number for u in b.solve.unknowns}
        count = self._store(needs)
        # The first ``count`` rows of the workspace store variables for later sweeps. The stopping rule of
        # fixed-point iteration needs additional rows.
        measured = MEASURED if self.blocks and not self.newton else 0
        sweeps = tuple(
            self._sweep(k, need, outputs if k == last else (), needs[k + 1 :], count)
            for k, need in enumerate(needs)
        )
        size, sites = len(self.problem.symbols), self.sites
        step = SiteStep(sites.dimension, sites.offsets, sites.periodic, sweeps, size, count + measured)
        blocks = tuple(
            SiteBlock(b.solve.label, tuple(u.name for u in b.solve.unknowns), b.first, b.last)
            for b in self.blocks
        )
        step = replace(step, blocks=blocks)
        return self._with_newton(step, count) if self.newton else step

    def _with_newton(self, step: SiteStep, count: int) -> SiteStep:
        """Return the step with a Newton matrix for each system of implicit equations.

        The variables of ``step`` occupy the first ``count`` rows of the workspace. MethodError is raised if
        the equations contain sums over all sites.
        """
        sizes = [sum(map(self._width, block.solve.unknowns)) for block in self.blocks]
        most = max(sizes, default=0)
        # The workspace contains variables, residuals, the border and the matrix, in this order
        # (:class:`codegen.ir.site_step.SiteNewton`). The border begins at row ``border``, and the matrix
        # begins at row ``matrix``.
        border = count + most
        # An open chain has no border. In a periodic chain, the border contains the columns of Newton's matrix
        # for the unknowns of the last site. For a block with n unknowns at each site, the border has n
        # columns, and each column has n entries for each site. A row of the workspace has one entry for each
        # site, so the border needs n * n rows. All blocks share these rows, and ``most`` is the largest n.
        matrix = border + (most * most if self.sites.periodic else 0)
        blocks = []
        for own, block, size in zip(step.blocks, self.blocks, sizes, strict=True):
            stored = (self.rows, self._given(), self.coupled, self.makers)
            # A sum over all sites couples all unknowns, so Newton's matrix would be dense.
            if self.totals:
                raise MethodError(
                    f"Newton's method cannot solve equations that contain sums over all sites, such as the "
                    f"equations of {self.program.name}",
                    where=self.problem.name,
                    expected="a method whose equations at a site read only this site and its neighbours",
                    hint="use the option --solver fixed-point",
                )
            linear = Linearisation(self.problem, self.sites, *stored)
            newton = linear.newton(self.program.name, block.solve, (size, count, border, matrix))
            blocks.append(replace(own, newton=newton))
        # At each site, the Newton matrix of a system of equations has three square blocks. The systems are
        # solved one after the other, so all Newton matrices use the same rows of the workspace.
        return replace(step, blocks=tuple(blocks), rows=matrix + 3 * most * most)

    @cached_property
    def coupled(self) -> tuple[int, ...]:
        """The indices of the coupled blocks in ``problem.state``.

        A block is coupled if the field at a site reads the values of this block at neighbouring sites.
        """
        read = {n.payload for n in walk(self.problem.roots) if n.op == "sym"}
        return tuple(
            k
            for k, block in enumerate(blocks_of(self.problem))
            if any(read.intersection(column[block]) for column in self.sites.symbols)
        )

    def _points(self, assign: Assign) -> tuple[Var, ...]:
        """Return the arguments that an assignment reads both at its own site and at neighbours."""
        if not isinstance(assign.operation, EVALUATED):
            return ()
        return tuple(assign.args[k] for k in self.coupled)

    def _place(self) -> None:
        """For each variable, find the index of the first sweep that can compute this variable."""
        least = 0
        for var in self.program.inputs:
            self.sweep_of[var] = 0
        for statement in self.program.body:
            if isinstance(statement, Assign):
                self._place_one(statement, least)
                continue
            solve = self._without_renamed(statement)
            inside = {t for assign in solve.body for t in assign.targets} | set(solve.unknowns)
            read = {v for assign in solve.body for v in assign.args} - inside
            # Sweeps (loops over all sites) that store values for the equations must come before ``first``.
            first = 1 + max([least, *(self.sweep_of[v] for v in (*solve.starts, *read))])
            self.sweep_of |= dict.fromkeys(solve.unknowns, first)
            for assign in solve.body:
                self._place_one(assign, first)
            last = max(first, *(self.sweep_of[v] for v in solve.images))
            points = {v for a in solve.body for v in self._points(a)}
            if points & set(solve.unknowns):
                # The field reads unknowns at neighbours. A sweep that evaluates the field must not change
                # these unknowns. Therefore a separate sweep is added at the end of each iteration, and only
                # this added sweep changes the unknowns.
                last += 1
            self.blocks.append(_Block(solve, first, last))
            # The solution satisfies u = g(u), so the rest of the program reads u in place of g(u).
            self.renamed |= dict(zip(solve.images, solve.unknowns, strict=True))
            least = last + 1

    def _without_renamed(self, solve: Solve) -> Solve:
        starts = tuple(self.renamed.get(v, v) for v in solve.starts)
        return replace(solve, starts=starts, body=tuple(map(self._rename, solve.body)))

    def _rename(self, assign: Assign) -> Assign:
        return replace(assign, args=tuple(self.renamed.get(v, v) for v in assign.args))

    def _place_one(self, statement: Assign, least: int) -> None:
        assign = self._rename(statement)
        self.order.append(assign)
        places = [self.sweep_of[arg] for arg in assign.args]
        # Variables of neighbours are read from memory, so an earlier sweep must store them.
        points = [v for v in self._points(assign) if v in self.makers]
        places += [self.sweep_of[v] + 1 for v in points if self.sweep_of[v] >= least]
        if isinstance(assign.operation, Total):
            # The sum is known only after the sweep that stores the terms of all sites.
            ((target,), (term,)) = assign.targets, assign.args
            self.sweep_of[target] = max(least, self.sweep_of[term]) + 1
            self.totals[target] = assign
            return
        for target in assign.targets:
            self.sweep_of[target] = max([least, *places])
            self.makers[target] = assign

    def _terms(self, number: int) -> list[Var]:
        """Return the variables that are summed over all sites after the sweep ``number``."""
        return [a.args[0] for v, a in self.totals.items() if self.sweep_of[v] == number + 1]

    @cached_property
    def names(self) -> dict[Var, str]:
        """The name of each variable in ``totals`` (sums over all sites)."""
        problem = self.problem
        taken = {*problem.symbols, *problem.runtime, *self.sites.names, "h", TIME}
        return {v: unique_name(v.name, taken) for v in self.totals}

    def _choose_sums(self) -> None:
        """Choose which linear combinations of vectors are stored.

        A combination can be stored in place of one of its terms, if no other operation reads this term. A 2N
        scheme (a low-storage Runge-Kutta method) then stores only one element of the Lie algebra for each
        site.
        """
        readers = Counter(arg for assign in self.order for arg in assign.args)
        for assign in self.order:
            if self.blocks or not isinstance(assign.operation, Linear):
                continue
            (target,) = assign.targets
            if any(
                readers[arg] == 1
                and self.sweep_of[arg] == self.sweep_of[target]
                and arg in self.makers
                and not isinstance(self.makers[arg].operation, RECOMPUTED)
                for arg in assign.args
            ):
                self.sums.add(target)

    def _require(self, number: int, need: _Needs, roots: Iterable[Var]) -> None:
        """Find all variables that the sweep ``number`` needs for ``roots``, and add them to ``need``."""
        waiting = list(roots)
        while waiting:
            var = waiting.pop()
            if var in need.computed:
                continue
            maker = self.makers.get(var)
            # Each sweep computes the results of cheap operations again, except the results in ``sums``.
            again = maker is not None and isinstance(maker.operation, RECOMPUTED) and var not in self.sums
            if maker is None or (self.sweep_of[var] < number and not again):
                need.loaded.add(var)
                continue
            need.computed |= set(maker.targets)
            need.around |= set(self._points(maker))
            waiting += maker.args

    def _last_uses(self, needs: list[_Needs]) -> dict[Var, int]:
        """Return, for each variable, the index of the last sweep that needs this variable."""
        used = {v: k for k, need in enumerate(needs) for v in (need.loaded | need.around)}
        for number in range(len(needs)):
            for var in self._terms(number):
                # The variable ``var`` is a term of a sum over all sites. The sweep with the index ``number``
                # stores this term. The sum is computed between this sweep and the next sweep. Until then, the
                # term must not be overwritten.
                used[var] = max(used.get(var, 0), number + 1)
        for block in self.blocks:
            repeated = needs[block.first : block.last + 1]
            defined = {v for need in repeated for v in need.computed}
            for var in {v for need in repeated for v in (need.loaded | need.around)} - defined:
                # Each iteration reads ``var``. Therefore no iteration may overwrite ``var``.
                used[var] = max(used[var], block.last + 1)
        return used

    def _store(self, needs: list[_Needs]) -> int:
        """Assign rows of the workspace to all stored variables, and return the number of rows."""
        for var in self._given():
            self.rows[var] = tuple(Row(STATE, k) for k in self._numbers(var.name))
        used = self._last_uses(needs)
        around = [need.around for need in needs]
        free: list[int] = []
        count = 0
        for number, need in enumerate(needs):
            # If a sweep reads a value at neighbours, this sweep must not overwrite the value.
            done = [v for v in self.rows if used.get(v) == number and v not in around[number]]
            done += [v for v in self.rows if used.get(v) == number - 1 and v in around[number - 1]]
            ended = [r.number for v in done for r in self.rows[v] if r.array == WORK]
            # A set has no fixed order, but the workspace layout must be the same in every compilation.
            free = sorted({*free, *ended})
            # The sweep with the index ``block.first`` - 1 stores the starting values of the unknowns. So the
            # unknowns need rows of the workspace from this sweep on.
            begun = [u for block in self.blocks if block.first - 1 == number for u in block.solve.unknowns]
            stored = [v for v in self._ordered(need.computed) if self.sweep_of[v] == number]
            for var in [*begun, *(v for v in stored if used.get(v, -1) > number)]:
                width = self._width(var)
                chosen, free = free[:width], free[width:]
                # If too few rows are free, new rows are appended to the workspace.
                chosen += range(count, count + width - len(chosen))
                count = max(count, max(chosen) + 1)
                self.rows[var] = tuple(Row(WORK, k) for k in chosen)
        return count

    def _given(self) -> tuple[Var, ...]:
        """Return the variables of the old state."""
        return tuple(var for var in self.program.inputs if var.kind is not Kind.REAL)

    def _numbers(self, name: str) -> range:
        """Return the indices of the coordinates that belong to the block ``name`` of the state."""
        places = zip(self.problem.state, blocks_of(self.problem), strict=True)
        return next(range(place.start, place.stop) for block, place in places if block.name == name)

    def _ordered(self, variables: Iterable[Var]) -> list[Var]:
        """Return the variables in a fixed order: inputs, unknowns, and then all computed variables."""
        wanted = set(variables)
        unknowns = [u for block in self.blocks for u in block.solve.unknowns]
        listed = [*self.program.inputs, *unknowns, *(t for a in self.order for t in a.targets)]
        return [v for v in listed if v in wanted]

    def _width(self, var: Var) -> int:
        if var.kind is Kind.REAL:
            return 1
        if var.kind is Kind.POINT:
            return len(self.problem.symbols)
        return self.problem.group.size if var.kind is Kind.GROUP else self.problem.group.dim

    def _sweep(
        self,
        number: int,
        need: _Needs,
        outputs: tuple[Var, ...],
        later: list[_Needs],
        count: int,
    ) -> Sweep:
        read = {v for other in later for v in (other.loaded | other.around)} | set(self._terms(number))
        kept = [
            v
            for v in self._ordered(need.computed)
            if self.sweep_of[v] == number and v in self.rows and v in read
        ]
        executed = [a for a in self.order if set(a.targets) & need.computed]
        run = Execution(
            self.program.name, self.problem, self.sites, self.rows, self._given(), self.coupled, self.names
        )
        # A set has no fixed order, so the variables are put into the order of the program.
        run.begin(self._ordered(need.loaded | need.around))
        for assign in executed:
            run.execute(assign)
        copies = [pair for block in self.blocks for pair in block.copies(number)]
        ending = tuple(u for block in self.blocks if block.last == number for u in block.solve.unknowns)
        stored = [(self.rows[unknown], value) for unknown, value in copies]
        measured = tuple(Row(WORK, count + k) for k in range(MEASURED)) if ending and not self.newton else ()
        if ending and self.newton:
            # In fixed-point iteration, this sweep replaces the unknowns by their new values. In Newton's
            # method, the solver changes the unknowns, and this sweep stores the residuals in free rows.
            free = (Row(WORK, k) for k in itertools.count(count))
            stored = [(tuple(islice(free, len(rows))), value) for rows, value in stored]
        stored += [(self.rows[v], v) for v in kept]
        named = zip((name for name, _ in self.program.outputs), outputs, strict=False)
        # For all sweeps except the last, ``outputs`` is empty.
        stored += [(tuple(Row(RESULT, k) for k in self._numbers(name)), v) for name, v in named]
        shown = [a.text() for a in executed if not isinstance(a.operation, RECOMPUTED)]
        shown += [f"{unknown.name} = {value.name}" for unknown, value in copies]
        sums = tuple(
            (self.names[v], self.rows[a.args[0]][0])
            for v, a in self.totals.items()
            if self.sweep_of[v] == number + 1
        )
        return run.sweep(Content("; ".join(shown), tuple(stored), ending, measured), sums)
