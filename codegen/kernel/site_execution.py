"""Derives the formulas of one sweep over the sites of a lattice, by execution of a program on symbols."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate

from codegen.ir.domain import ExprDomain, Value
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel, Let
from codegen.ir.operations import Advance, Linear, Operation, Zero
from codegen.ir.program import Assign
from codegen.ir.scene_operations import Differential, Energy, Field, HamiltonianDerivatives
from codegen.ir.site_step import EXISTS, OWN, Load, Row, Sweep
from codegen.ir.values import Kind, Var
from codegen.kernel.assignments import Assignments, unique_name
from codegen.kernel.shared_angles import SharedArguments
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import Sites, offset_text
from codegen.scene.values import Bindings

RECOMPUTED = (Linear, Zero, Advance)
"""Cheap operations: each sweep that needs their results computes the results again.

Exception: some linear combinations are stored in rows (:mod:`codegen.kernel.site_plan`).
"""

EVALUATED = (Field, HamiltonianDerivatives, Energy, Differential)
"""Operations that evaluate formulas of the scene. The formulas may contain states of neighbouring sites."""


@dataclass(frozen=True)
class Content:
    """The content of a sweep over the sites.

    - ``about`` describes the sweep.
    - ``stored`` contains pairs (rows, variable). The sweep stores the variable in these rows.
    - ``unknowns`` are the unknowns u of equations u = g(u). In fixed-point iteration, the sweep replaces u by
      g(u).
    - ``measured`` is empty or contains two rows. For each site, the first row contains the largest change of
      the unknowns of this site. The second row contains the largest absolute value of these unknowns.
    """

    about: str
    stored: tuple[tuple[tuple[Row, ...], Var], ...]
    unknowns: tuple[Var, ...] = ()
    measured: tuple[Row, ...] = ()


def blocks_of(problem: Problem) -> tuple[slice, ...]:
    """Return one slice for each block of a state. The slice selects the coordinates of the block."""
    ends = tuple(accumulate(len(block.symbols) for block in problem.state))
    return tuple(slice(first, last) for first, last in zip((0, *ends), ends, strict=False))


class Execution:
    """Executes the assignments of one sweep symbolically.

    - ``rows`` maps each stored variable to its rows in the arrays of the lattice.
    - ``given`` contains the variables of the state at the beginning of the step.
    - ``coupled`` contains indices of blocks of ``problem.state``. The field reads these blocks also at
      neighbouring sites.
    - ``totals`` maps variables to names. Each of these variables is a sum over all sites.
    """

    def __init__(
        self,
        name: str,
        problem: Problem,
        sites: Sites,
        rows: Mapping[Var, tuple[Row, ...]],
        given: Sequence[Var],
        coupled: Sequence[int],
        totals: Mapping[Var, str],
    ) -> None:
        self.name, self.problem, self.sites = name, problem, sites
        self.rows, self.given, self.coupled, self.totals = rows, given, coupled, totals
        self.domain = SharedArguments()
        self.env: dict[Var, Value] = {}
        self.hints: dict[int, str] = {}
        self.loads: dict[str, Load] = {}
        # The names in ``taken`` are in use, so computed values get other names.
        self.taken = {*problem.symbols, *problem.runtime, "h", TIME, *totals.values()}
        self.ghosts: dict[str, Expr] = {}
        self.named: dict[Var, tuple[str, ...]] = {}

    def begin(self, variables: Iterable[Var]) -> None:
        """Create symbols for the variables that the sweep reads."""
        for var in variables:
            # A variable without rows has one value for all sites: the time, or a sum over all sites.
            if var not in self.rows:
                self.env[var] = self.domain.space.sym(self.totals.get(var, var.name))
                continue
            names = self._names(var)
            self.loads |= {s: Load(s, r) for s, r in zip(names, self.rows[var], strict=True)}
            values = tuple(map(self.domain.space.sym, names))
            self.env[var] = values[0] if var.kind is Kind.REAL else values

    def _names(self, var: Var) -> tuple[str, ...]:
        # The coordinates of the old state keep the names that they have in the scene.
        if var in self.given:
            return next(block.symbols for block in self.problem.state if block.name == var.name)
        if var not in self.named:
            self.named[var] = tuple(self._fresh(f"{var.name}_{k}") for k in range(len(self.rows[var])))
        return self.named[var]

    def execute(self, assign: Assign) -> None:
        """Compute expressions for the results of ``assign``, and record a name for each expression."""
        args = tuple(self.env[a] for a in assign.args)
        operation = assign.operation
        results: tuple[Value, ...]
        if isinstance(operation, EVALUATED):
            results = self._evaluated(operation, assign.args, args)
        else:
            results = operation.evaluate(self.problem, self.domain, args)
        for target, value in zip(assign.targets, results, strict=True):
            self.env[target] = value
            for k, x in enumerate(flatten(target.kind, value)):
                # If several variables share an expression, the expression is named after the first variable.
                self.hints.setdefault(x.id, target.name if target.kind is Kind.REAL else f"{target.name}_{k}")

    def _evaluated(
        self, operation: Operation, variables: tuple[Var, ...], args: tuple[Value, ...]
    ) -> tuple[Value, ...]:
        """Return the results of an operation that evaluates formulas of the scene."""
        roots, dim = self._roots(operation), self.problem.group.dim
        values = evaluate(roots, self.domain, self._around(variables, args))
        if isinstance(operation, Energy):
            return (values[0],)
        f = tuple(values)
        # On T*G, ``f`` contains two vectors with ``dim`` components each.
        return (f[:dim], f[dim:]) if self.problem.paired else (f,)

    def _roots(self, operation: Operation) -> list[Expr]:
        """Return the formulas that ``operation`` evaluates."""
        if isinstance(operation, Energy):
            # ``share`` returns the contribution of one site to the energy of the lattice. This contribution
            # depends on which neighbours of the site exist.
            return [self.sites.share([self._exists(k) for k in range(len(self.sites.offsets))])]
        # The differential is evaluated at a point whose coordinates are symbols. This evaluation gives the
        # formulas for the components of the differential.
        if isinstance(operation, Differential):
            domain = ExprDomain(self.problem.roots[0].space)
            point = tuple(map(domain.space.sym, self.problem.symbols))
            return list(operation.evaluate(self.problem, domain, (point,))[0])
        return list(self.problem.roots)

    def _exists(self, offset: int) -> Expr:
        """Return an expression that is 1 if the neighbour ``offset`` of a site exists, and 0 otherwise."""
        space = self.problem.roots[0].space
        # In a periodic lattice every neighbour exists, so no test is needed at run time.
        if self.sites.periodic:
            return space.one
        name = f"exists_{offset_text(self.sites.offsets[offset])}"
        while name in self.problem.symbols or name in self.problem.runtime:
            name += "_"
        self.loads[name] = Load(name, Row(EXISTS, offset))
        return space.sym(name)

    def _around(self, variables: tuple[Var, ...], args: tuple[Value, ...]) -> Bindings:
        """Return the values of all symbols in the formulas of the scene, at one site and at its neighbours.

        ``args`` are the values of ``variables`` at the site: the blocks of the state, and possibly the time.
        """
        number = len(self.problem.state)
        point = tuple(x for block in args[:number] for x in block)
        values = self.problem.values(self.domain, point, *args[number:])
        # The flags of ``EXISTS`` remain symbols, because their values are known only at run time.
        values |= {s: self.domain.space.sym(s) for s, x in self.loads.items() if x.row.array == EXISTS}
        for offset in range(len(self.sites.offsets)):
            # A ghost is a value that replaces the value of a neighbour outside the lattice.
            ghosts: list[Expr] = []
            if self.sites.outside:
                ghosts = evaluate(list(self.sites.outside[offset]), self.domain, values)
            for k, place in enumerate(blocks_of(self.problem)):
                if k in self.coupled:
                    loaded = self._neighbour(variables[k], offset, ghosts[place])
                    symbols = self.sites.symbols[offset][place]
                    values |= dict(zip(symbols, map(self.domain.space.sym, loaded), strict=True))
                    self.ghosts |= dict(zip(loaded, ghosts[place], strict=False))
        return values

    def _neighbour(self, var: Var, offset: int, ghosts: Sequence[Expr]) -> list[str]:
        """Return names for the components of ``var`` at a neighbour of a site.

        The neighbour has the position ``self.sites.offsets[offset]`` relative to the site.
        The names are added to the dictionary ``self.loads``. ``ghosts`` contains the values to be used if the
        neighbour is outside the lattice.
        """
        loaded = [f"{name}_{offset_text(self.sites.offsets[offset])}" for name in self._names(var)]
        pairs = zip(loaded, ghosts, strict=False)
        # ``self.ghosts`` can store only one value for each name in ``loaded``. If one of these names already
        # has a different value there, all components of ``var`` get new names. If ``var`` is not in
        # ``self.given``, its components always get new names.
        if var not in self.given or any(self.ghosts.get(s, x) is not x for s, x in pairs):
            loaded = [self._fresh(name) for name in loaded]
        self.loads |= {s: Load(s, row, offset) for s, row in zip(loaded, self.rows[var], strict=True)}
        return loaded

    def _fresh(self, base: str) -> str:
        return unique_name(base, self.taken)

    def sweep(self, content: Content, sums: tuple[tuple[str, Row], ...]) -> Sweep:
        """Return the sweep that ``content`` describes.

        ``sums`` contains a pair (name of the sum, row) for each sum over all sites. The row contains one term
        of the sum for each site.
        """
        # The outputs of the kernel and the rows in ``stores`` have the same order.
        ends = [x for _, var in content.stored for x in flatten(var.kind, self.env[var])]
        stores = tuple(row for rows, _ in content.stored for row in rows)
        unknowns = tuple(s for var in content.unknowns for s in self._names(var))
        kernel = self._scheduled(ends)
        # The sweep measures how much the unknowns change, so it reads their old values.
        read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"} | set(unknowns)
        # A ghost replaces the value of a neighbour outside the lattice. Only the ghosts that ``kernel`` reads
        # are computed.
        around = [s for s in read if s in self.ghosts]
        outside = None
        if around:
            # ``ghosts`` must have the same order as ``self.loads`` (:class:`codegen.ir.site_step.Sweep`).
            ghosts = {s: self.ghosts[s] for s in self.loads if s in around}
            outside = self._scheduled(list(ghosts.values()))
            # ``outside`` computes the values of neighbours outside the lattice. The sweep must also load the
            # numbers that ``outside`` reads.
            read |= {n.payload for n in walk(outside.expressions()) if n.op == "sym"}
        loads = tuple(load for symbol, load in self.loads.items() if symbol in read)
        own = (unknowns, content.measured)
        return Sweep(content.about, kernel, loads, stores, outside, OWN, *own, sums)

    def _scheduled(self, ends: list[Expr]) -> Kernel:
        totals = tuple(self.totals.values())
        return kernel_of_sweep(
            self.name, self.problem, tuple(self.loads), ends, self.hints, self.taken, totals
        )


def kernel_of_sweep(
    name: str,
    problem: Problem,
    symbols: tuple[str, ...],
    ends: list[Expr],
    hints: dict[int, str],
    taken: set[str],
    totals: tuple[str, ...] = (),
) -> Kernel:
    """Return the kernel that computes the expressions ``ends`` at one site.

    ``symbols`` are the names of the numbers that the sweep reads at each site. ``totals`` are the names of
    the sums over all sites. ``hints`` maps the ids of expressions to preferred names. This function adds the
    names of new variables to ``taken``.
    """
    schedule = Assignments((), ends, hints, lambda base: unique_name(base, taken))
    body = tuple(_lets(schedule.run()))
    scalars = (TIME, "h", *totals, *problem.runtime)
    state = (StateBlock("site", symbols, "the numbers that the sweep reads"),)
    return Kernel(name, state, scalars, body, schedule.outputs)


def _lets(body: Iterable[object]) -> Iterator[Let]:
    for statement in body:
        assert isinstance(statement, Let)
        yield statement
