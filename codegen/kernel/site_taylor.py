"""Taylor's method on a lattice: one sweep over all sites for each degree of the polynomial.

Coefficient n + 1 of a site depends on the coefficients 0, ..., n of the site and of its neighbours
(:mod:`codegen.ir.taylor_recurrence`). Coefficient n includes the factor h^n, where h is the step size.
At an open boundary, given formulas replace the states of missing neighbours.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from codegen.ir.domain import Value
from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Kernel
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import TaylorStep
from codegen.ir.site_step import OWN, RESULT, STATE, WORK, Load, Row, SiteStep, Sweep
from codegen.ir.taylor_recurrence import Recurrence
from codegen.ir.taylor_series import Coefficient, Series
from codegen.ir.values import Kind, Var
from codegen.kernel.assignments import unique_name
from codegen.kernel.shared_angles import SharedArguments
from codegen.kernel.site_execution import kernel_of_sweep
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import Sites, offset_text

SHORT = 3
"""An expression with at most SHORT operations is not stored. Each sweep computes it again.

If SHORT is 1 or 3, a step of taylor(8) on 4000 pendulums takes 24 ns for each pendulum. If SHORT is 10, the
time is 117 ns. On a chain of spins, the times for SHORT = 1, 3 and 10 differ by at most 3 per cent.
"""

CALL = 10
"""A call of a function counts as this number of operations."""


@dataclass
class _Stored:
    """The expressions that are stored in one sweep over all sites and read in later sweeps.

    The keys of all three dictionaries are the ids of the expressions.

    - ``writer`` contains the number of the sweep that stores the expression.
    - ``last`` contains the number of the last sweep that reads the expression.
    - ``nodes`` contains the expression itself.
    """

    writer: dict[int, int] = field(default_factory=dict)
    last: dict[int, int] = field(default_factory=dict)
    nodes: dict[int, Expr] = field(default_factory=dict)


class TaylorSweeps:
    """Builds the sweeps of one step of Taylor's method.

    ``problem`` describes one site, and the states of its neighbours are parameters. ``problem.evolution``
    contains the time derivatives of the coordinates.
    """

    def __init__(self, program: Program, problem: Problem, sites: Sites, degree: int) -> None:
        assert problem.evolution is not None
        self.program, self.problem, self.sites, self.degree = program, problem, sites, degree
        self.symbols = problem.evolution.inner.symbols
        self.domain = SharedArguments()
        self.taken = {*self.symbols, *problem.runtime, "h", TIME}
        self.loads: dict[str, Load] = {}
        self.ghosts: dict[str, Expr] = {}
        self.coefficients: list[list[Coefficient]] = []
        self.rows = 0
        # The coordinates of the site come first, followed by the coordinates of each neighbour.
        names = [self.symbols, *sites.symbols]
        self.recurrence = self._recurrence([s for own in names for s in own])
        # ``outside[i][k]`` is the Taylor series of coordinate k of neighbour i outside an open boundary.
        self.outside: list[list[Series]] = [
            list(map(self.recurrence.series, column)) for column in sites.outside
        ]

    def _recurrence(self, names: Sequence[str]) -> Recurrence:
        assert self.problem.evolution is not None
        inner, space = self.problem.evolution.inner, self.domain.space
        time = space.sym(TIME)
        values = self.problem.scalars(self.domain, time)
        state = [space.sym(name) for name in names]
        return Recurrence(inner.roots, self.domain, names, state, values, space.sym("h"))

    def step(self) -> SiteStep:
        """Return the step as a sequence of sweeps."""
        size = len(self.symbols)
        # Coefficient 0 is the old state.
        self._load([Row(STATE, k) for k in range(size)], self.symbols, self.sites.symbols, 0)
        ends: list[list[Expr]] = []
        stores: list[list[Row]] = []
        self.coefficients.append(list(map(self.domain.space.sym, self.symbols)))
        # Sweep n computes coefficient n + 1 from the coefficients 0, ..., n.
        for n in range(self.degree):
            terms = self._with_ghosts(self.recurrence.following(n), n + 1)
            if n + 1 == self.degree:
                self.coefficients.append(terms)
                ends.append(self._end())
                stores.append([Row(RESULT, k) for k in range(size)])
            else:
                ends.append([x for x in terms if x is not None])
                stores.append(self._append(terms, n + 1))
        stored = self._stored(ends)
        sweeps = tuple(self._sweeps(ends, stores, stored))
        sites = self.sites
        return SiteStep(sites.dimension, sites.offsets, sites.periodic, sweeps, size, self.rows)

    def _load(
        self, rows: Sequence[Row], own: Sequence[str], around: Sequence[Sequence[str]], degree: int
    ) -> None:
        """Record in ``loads`` where the Taylor coefficients of the given ``degree`` are stored.

        ``rows[k]`` contains the coefficient of coordinate k at each site. In expressions, the symbol
        ``own[k]`` denotes this coefficient at the site itself, and the symbol ``around[i][k]`` denotes this
        coefficient at neighbour i. Formulas for neighbours outside the lattice are added to ``ghosts``.
        """
        # Coefficients with an empty name are zero, and are not loaded.
        self.loads |= {s: Load(s, row) for s, row in zip(own, rows, strict=True) if s}
        for number, column in enumerate(around):
            self.loads |= {s: Load(s, row, number) for s, row in zip(column, rows, strict=True) if s}
            for k, s in enumerate(column):
                if self.outside and s:
                    # If a term is identically zero, ``term`` returns None.
                    ghost = self.outside[number][k].term(degree)
                    self.ghosts[s] = self.domain.space.zero if ghost is None else ghost

    def _with_ghosts(self, terms: list[Coefficient], degree: int) -> list[Coefficient]:
        """Return the Taylor coefficients ``terms`` of one site, with each None replaced by the expression 0.

        None represents a coefficient that is zero at all sites. ``degree`` is the degree of the coefficients,
        at least 1. In three cases, ``terms`` is returned unchanged:

        - The lattice has no open boundary.
        - Outside the lattice, each coordinate is a constant or a copy of the same coordinate at the boundary
          site. Then a coefficient of degree 1 or higher that is zero at all sites is also zero outside the
          lattice.
        - ``degree`` is the largest degree. No neighbour reads these coefficients.
        """
        if degree == self.degree:
            return terms
        if all(self._follows(x, k) for column in self.sites.outside for k, x in enumerate(column)):
            return terms
        return [self.domain.space.zero if x is None else x for x in terms]

    def _follows(self, ghost: Expr, k: int) -> bool:
        """Return True if ``ghost`` is a constant or the symbol ``self.symbols[k]``.

        ``ghost`` is the formula for coordinate k of a neighbour outside the lattice.
        """
        return ghost.op == "const" or (ghost.op == "sym" and ghost.payload == self.symbols[k])

    def _append(self, terms: Sequence[Coefficient], degree: int) -> list[Row]:
        """Reserve memory for the nonzero Taylor coefficients in ``terms``, and return the reserved rows.

        A row contains one number for each site.
        """
        rows: list[Row] = []
        every: list[Row] = []
        own: list[str] = []
        for s, x in zip(self.symbols, terms, strict=True):
            # A zero coefficient has the name '', so ``_load`` ignores its row, and no memory is reserved.
            own.append("" if x is None else unique_name(f"{s}_d{degree}", self.taken))
            every.append(Row(WORK, self.rows))
            if x is not None:
                rows.append(every[-1])
                self.rows += 1
        around = [
            [unique_name(f"{s}_{offset_text(offset)}", self.taken) if s else "" for s in own]
            for offset in self.sites.offsets
        ]
        names = [*own, *(s for column in around for s in column)]
        sym = self.domain.space.sym
        # The coefficients of the next degree are expressions in these symbols and in those of lower degrees.
        self.recurrence.append([sym(s) if s else None for s in names])
        self.coefficients.append([sym(s) if s else None for s in own])
        self._load(every, own, around, degree)
        return rows

    def _end(self) -> list[Expr]:
        """Execute the program symbolically, and return the expressions of the new state."""
        env: dict[Var, Value] = {}
        for var in self.program.inputs:
            names = self.symbols if var.kind is not Kind.REAL else (TIME,)
            values = tuple(map(self.domain.space.sym, names))
            env[var] = values[0] if var.kind is Kind.REAL else values
        for assign in self.program.body:
            assert isinstance(assign, Assign)
            if isinstance(assign.operation, TaylorStep):
                results: tuple[Value, ...] = (self._polynomial(),)
            else:
                args = tuple(env[a] for a in assign.args)
                results = assign.operation.evaluate(self.problem, self.domain, args)
            env |= dict(zip(assign.targets, results, strict=True))
        return [x for _, var in self.program.outputs for x in env[var]]

    def _polynomial(self) -> tuple[Expr, ...]:
        """Return the value of the Taylor polynomial of each coordinate at the end of the step.

        The old state is added last, because this reduces the rounding error.
        """
        moved = []
        for first, *further in zip(*self.coefficients, strict=True):
            change = None
            for x in further:
                change = x if change is None else change if x is None else change + x
            moved.append(first if change is None else first + change)
        return tuple(moved)

    def _stored(self, ends: Sequence[Sequence[Expr]]) -> _Stored:
        """Return the expressions that a sweep computes and that later sweeps read."""
        first: dict[int, int] = {}
        for n, roots in enumerate(ends):
            for node in walk(roots):
                # The first sweep that computes an expression also stores it.
                first.setdefault(node.id, n)
        # A value is stored in a row only if it can differ from site to site.
        local = self._local([x for roots in ends for x in roots])
        stored, work = _Stored(), dict[int, int]()
        for n, roots in enumerate(ends):

            def reused(node: Expr, n: int = n) -> bool:
                # If an earlier sweep has computed an expression, this sweep can read the value from memory.
                again = first[node.id] < n and bool(node.args) and node.id in local
                return again and (node.id in stored.writer or self._work(node, work) > SHORT)

            for node in walk(roots, reused):
                if reused(node):
                    stored.writer.setdefault(node.id, first[node.id])
                    stored.nodes[node.id] = node
                    # The sweeps are visited in order. Therefore the final value of this entry is the number
                    # of the last sweep that reads ``node`` from memory.
                    stored.last[node.id] = n
        return stored

    def _local(self, roots: Sequence[Expr]) -> set[int]:
        """Return the ids of all subexpressions of ``roots`` that contain a symbol of ``self.loads``."""
        local: set[int] = set()
        for node in walk(roots):
            if (node.op == "sym" and node.payload in self.loads) or any(a.id in local for a in node.args):
                local.add(node.id)
        return local

    def _work(self, node: Expr, known: dict[int, int]) -> int:
        """Count the operations in an expression until the count exceeds SHORT."""
        if node.id not in known:
            total = 0
            for x in walk([node]):
                total += 0 if not x.args else CALL if x.op == "call" else 1
                # The count can stop here, because the caller only compares the result with SHORT.
                if total > SHORT:
                    break
            known[node.id] = total
        return known[node.id]

    def _sweeps(
        self, ends: Sequence[Sequence[Expr]], stores: Sequence[Sequence[Row]], stored: _Stored
    ) -> list[Sweep]:
        rows: dict[int, Row] = {}
        names: dict[int, str] = {}
        free: list[int] = []
        listed = []
        for n, (roots, own) in enumerate(zip(ends, stores, strict=True)):
            # ``rows`` contains the rows of the stored expressions, with one entry for each site. At a site, a
            # sweep first reads entries of this site only, and then writes new entries of this site. Therefore
            # the last sweep that reads a row may also overwrite this row.
            free += [row.number for i, row in rows.items() if stored.last[i] == n]
            kept = [node for i, node in stored.nodes.items() if stored.writer[i] == n]
            # The values in ``names`` were stored by earlier sweeps.
            known = {i: self.domain.space.sym(name) for i, name in names.items()}
            outputs = self._replaced([*roots, *kept], known)
            for node in kept:
                # The workspace gets a new row only if no row is free.
                number = free.pop(0) if free else self.rows
                self.rows = max(self.rows, number + 1)
                rows[node.id] = Row(WORK, number)
                names[node.id] = unique_name(f"kept_{len(names) + 1}", self.taken)
                self.loads[names[node.id]] = Load(names[node.id], rows[node.id])
            places = (*own, *(rows[node.id] for node in kept))
            listed.append(self._sweep(n, outputs, places))
        return listed

    def _replaced(self, roots: Sequence[Expr], known: dict[int, Expr]) -> list[Expr]:
        """Return ``roots`` with symbols in place of stored expressions.

        ``known`` maps the id of each stored expression to a symbol.
        """
        changed = dict(known)
        for node in walk(roots, lambda x: x.id in known):
            if node.id not in changed:
                args = tuple(changed[a.id] for a in node.args)
                # ``_make`` does not simplify the node, because simplification could change the rounding
                # errors.
                changed[node.id] = node.space._make(node.op, args, node.payload) if args else node
        return [changed[root.id] for root in roots]

    def _sweep(self, n: int, ends: list[Expr], stores: tuple[Row, ...]) -> Sweep:
        kernel = self._kernel(ends)
        read = _symbols(kernel.expressions())
        around = [s for s in self.loads if s in read and self.loads[s].neighbour != OWN]
        outside = None
        if self.sites.outside and around:
            outside = self._kernel([self.ghosts[s] for s in around])
            read |= _symbols(outside.expressions())
        loads = tuple(load for s, load in self.loads.items() if s in read)
        about = f"Taylor coefficients of degree {n + 1}"
        if n + 1 == self.degree:
            about += ", the sum of all coefficients, and the new state"
        return Sweep(about, kernel, loads, stores, outside)

    def _kernel(self, ends: list[Expr]) -> Kernel:
        return kernel_of_sweep(self.program.name, self.problem, tuple(self.loads), ends, {}, self.taken)


def _symbols(expressions: Iterable[Expr]) -> set[str]:
    return {str(n.payload) for n in walk(expressions) if n.op == "sym"}
