"""The symbolic execution of one sweep over the sites of a lattice."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate

from codegen.ir.domain import Value
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel, Let
from codegen.ir.operations import Advance, Linear, Zero
from codegen.ir.program import Assign
from codegen.ir.scene_operations import Field, HamiltonianDerivatives
from codegen.ir.site_step import OWN, Load, Row, Sweep
from codegen.ir.values import Kind, Var
from codegen.kernel.assignments import Assignments, unique_name
from codegen.kernel.shared_angles import SharedArguments
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import Sites, offset_text

RECOMPUTED = (Linear, Zero, Advance)
"""Operations whose results are usually not stored: each sweep that reads such a result computes it again.
Only sums that :mod:`codegen.kernel.site_plan` selects are stored."""

EVALUATED = (Field, HamiltonianDerivatives)
"""Operations that read the states of neighbours."""


@dataclass(frozen=True)
class Content:
    """The content of a sweep: the description ``about``, and the pairs ``stored``. Each pair contains rows,
    and the variable whose value is stored in these rows. ``unknowns`` are the unknowns that the sweep
    replaces by their images. In the rows ``measured`` the sweep stores how much the unknowns change."""

    about: str
    stored: tuple[tuple[tuple[Row, ...], Var], ...]
    unknowns: tuple[Var, ...] = ()
    measured: tuple[Row, ...] = ()


def blocks_of(problem: Problem) -> tuple[slice, ...]:
    """Return, for each block of a state, the slice of its coordinates among all coordinates."""
    ends = tuple(accumulate(len(block.symbols) for block in problem.state))
    return tuple(slice(first, last) for first, last in zip((0, *ends), ends, strict=False))


class Execution:
    """The symbolic execution of one sweep. ``rows`` maps each stored variable to its rows in the arrays of
    the lattice, and ``given`` are the variables of the old state. ``coupled`` are the indices of those blocks
    of the state that the field reads at neighbours."""

    def __init__(
        self,
        name: str,
        problem: Problem,
        sites: Sites,
        rows: Mapping[Var, tuple[Row, ...]],
        given: Sequence[Var],
        coupled: Sequence[int],
    ) -> None:
        self.name, self.problem, self.sites = name, problem, sites
        self.rows, self.given, self.coupled = rows, given, coupled
        self.domain = SharedArguments()
        self.env: dict[Var, Value] = {}
        self.hints: dict[int, str] = {}
        self.loads: dict[str, Load] = {}
        # Names that users have chosen are reserved, so no computed value gets one of these names.
        self.taken = {*problem.symbols, *problem.runtime, "h", TIME}
        self.ghosts: dict[str, Expr] = {}
        self.named: dict[Var, tuple[str, ...]] = {}

    def begin(self, variables: Iterable[Var]) -> None:
        """Set the values of variables that the sweep reads. Scalars such as the time become symbols. For the
        other variables, the numbers that earlier sweeps have stored become symbols."""
        for var in variables:
            if var.kind is Kind.REAL:
                self.env[var] = self.domain.space.sym(var.name)
                continue
            names = self._names(var)
            self.loads |= {s: Load(s, r) for s, r in zip(names, self.rows[var], strict=True)}
            self.env[var] = tuple(map(self.domain.space.sym, names))

    def _names(self, var: Var) -> tuple[str, ...]:
        if var in self.given:
            return next(block.symbols for block in self.problem.state if block.name == var.name)
        if var not in self.named:
            self.named[var] = tuple(self._fresh(f"{var.name}_{k}") for k in range(len(self.rows[var])))
        return self.named[var]

    def execute(self, assign: Assign) -> None:
        """Execute an assignment on symbols, and record names for the expressions of its results."""
        args = tuple(self.env[a] for a in assign.args)
        operation = assign.operation
        results: tuple[Value, ...]
        if isinstance(operation, EVALUATED):
            f, dim = self._field(assign.args, args), self.problem.group.dim
            results = (f[:dim], f[dim:]) if self.problem.paired else (f,)
        else:
            results = operation.evaluate(self.problem, self.domain, args)
        for target, value in zip(assign.targets, results, strict=True):
            self.env[target] = value
            for k, x in enumerate(flatten(target.kind, value)):
                self.hints.setdefault(x.id, target.name if target.kind is Kind.REAL else f"{target.name}_{k}")

    def _field(self, variables: tuple[Var, ...], args: tuple[Value, ...]) -> tuple[Expr, ...]:
        """Return the field at a point. The field also reads this point at neighbours; an earlier sweep has
        stored these values for all sites."""
        number = len(self.problem.state)
        point = tuple(x for block in args[:number] for x in block)
        values = self.problem.values(self.domain, point, *args[number:])
        for offset in range(len(self.sites.offsets)):
            ghosts: list[Expr] = []
            if self.sites.outside:
                ghosts = evaluate(list(self.sites.outside[offset]), self.domain, values)
            for k, place in enumerate(blocks_of(self.problem)):
                if k in self.coupled:
                    loaded = self._neighbour(variables[k], offset)
                    symbols = self.sites.symbols[offset][place]
                    values |= dict(zip(symbols, map(self.domain.space.sym, loaded), strict=True))
                    self.ghosts |= dict(zip(loaded, ghosts[place], strict=False))
        return tuple(evaluate(list(self.problem.roots), self.domain, values))

    def _neighbour(self, var: Var, offset: int) -> list[str]:
        """Return the symbols of a variable at a neighbour, and record their loads."""
        loaded = [f"{name}_{offset_text(self.sites.offsets[offset])}" for name in self._names(var)]
        if var not in self.given:
            loaded = [self._fresh(name) for name in loaded]
        self.loads |= {s: Load(s, row, offset) for s, row in zip(loaded, self.rows[var], strict=True)}
        return loaded

    def _fresh(self, base: str) -> str:
        return unique_name(base, self.taken)

    def sweep(self, content: Content) -> Sweep:
        """Return the sweep with the given content."""
        ends = [x for _, var in content.stored for x in flatten(var.kind, self.env[var])]
        stores = tuple(row for rows, _ in content.stored for row in rows)
        unknowns = tuple(s for var in content.unknowns for s in self._names(var))
        kernel = self._scheduled(ends)
        # The sweep needs the old values of the unknowns even if the kernel does not read them, because it
        # also measures how much the unknowns change.
        read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"} | set(unknowns)
        around = [s for s in read if s in self.ghosts]
        outside = None
        if around:
            ghosts = {s: self.ghosts[s] for s in self.loads if s in around}
            outside = self._scheduled(list(ghosts.values()))
            read |= {n.payload for n in walk(outside.expressions()) if n.op == "sym"}
        loads = tuple(load for symbol, load in self.loads.items() if symbol in read)
        own = (unknowns, content.measured)
        return Sweep(content.about, kernel, loads, stores, outside, OWN, *own)

    def _scheduled(self, ends: list[Expr]) -> Kernel:
        return kernel_of_sweep(self.name, self.problem, tuple(self.loads), ends, self.hints, self.taken)


def kernel_of_sweep(
    name: str,
    problem: Problem,
    symbols: tuple[str, ...],
    ends: list[Expr],
    hints: dict[int, str],
    taken: set[str],
) -> Kernel:
    """Return the kernel that computes expressions from the numbers ``symbols`` that a sweep reads.

    ``hints`` are names for the values of expressions, and ``taken`` are the names that are used already; the
    names of new values are added to them.
    """
    schedule = Assignments((), ends, hints, lambda base: unique_name(base, taken))
    body = tuple(_lets(schedule.run()))
    scalars = (TIME, "h", *problem.runtime)
    state = (StateBlock("site", symbols, "the numbers that the sweep reads"),)
    return Kernel(name, state, scalars, body, schedule.outputs)


def _lets(body: Iterable[object]) -> Iterator[Let]:
    for statement in body:
        assert isinstance(statement, Let)
        yield statement
