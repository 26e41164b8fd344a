"""The matrix of Newton's method for implicit equations u = g(u) on a chain, a one-dimensional lattice.

The matrix is the derivative of u - g(u) with respect to u, to first order in the step size h. At a site, g(u)
depends on the unknowns of the site and of its two neighbours. The values g(u) are called images.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from codegen.errors import MethodError
from codegen.ir.domain import Value
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.interpret import flatten
from codegen.ir.jacobian import jacobian
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel, Let
from codegen.ir.program import Assign, Solve
from codegen.ir.site_step import OWN, Load, Row, SiteNewton
from codegen.ir.values import Kind, Var
from codegen.kernel.assignments import Assignments, unique_name
from codegen.kernel.newton import leading_terms
from codegen.kernel.shared_angles import SharedArguments
from codegen.kernel.site_execution import EVALUATED, RECOMPUTED, blocks_of
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import Sites

LEFT, RIGHT = (-1,), (1,)
"""The offsets of the neighbours in a chain."""


@dataclass
class Linearisation:
    """Differentiates g in u = g(u) with respect to the unknowns of a site and of its left and right
    neighbours.

    - ``rows`` maps each stored variable to its rows in the arrays of the lattice.
    - ``given`` contains the variables of the state at the beginning of the step.
    - ``makers`` maps each computed variable to its assignment.
    - ``coupled`` contains indices of blocks in ``problem.state``. The vector field at a site
      also reads these blocks of the neighbours.
    """

    problem: Problem
    sites: Sites
    rows: Mapping[Var, tuple[Row, ...]]
    given: Sequence[Var]
    coupled: Sequence[int]
    makers: Mapping[Var, Assign]
    domain: SharedArguments = field(default_factory=SharedArguments)
    values: dict[tuple[int, Var], Value] = field(default_factory=dict)
    loads: dict[str, Load] = field(default_factory=dict)
    taken: set[str] = field(default_factory=set)
    inside: set[Var] = field(default_factory=set)

    def newton(self, label: str, solve: Solve, places: tuple[int, int, int, int]) -> SiteNewton:
        """Return the matrix of Newton's method for the equations ``solve``.

        ``places`` contains the values of the attributes ``size``, ``residual``, ``border`` and ``matrix`` of
        the result, in this order.

        MethodError is raised if the lattice is not a chain of nearest neighbours, or if the equations contain
        nested evaluations of the field.
        """
        # Only couplings of nearest neighbours give a block-tridiagonal matrix.
        if not set(self.sites.offsets) <= {LEFT, RIGHT}:
            raise MethodError(
                f"Newton's method cannot be used on a {self.sites.text()}",
                where=self.problem.name,
                expected="a chain whose field reads the nearest neighbours only",
                hint="use the option --solver fixed-point",
            )
        self.taken = {*self.problem.symbols, *self.problem.runtime, "h", TIME}
        # These variables depend on the unknowns, so ``value`` must return expressions in the unknowns.
        self.inside = {t for assign in solve.body for t in assign.targets}
        # ``images`` contains the expressions g(u) at one site.
        images = [x for v in solve.images for x in flatten(v.kind, self.value(v, OWN))]
        # The columns belong to the unknowns of the left neighbour, the site and the right neighbour.
        rows = jacobian(leading_terms(images), [s for k in self._columns() for s in self._unknowns(solve, k)])
        space = self.domain.space
        size, *first = places
        blocks: list[list[Expr]] = [[], [], []]
        for i, row in enumerate(rows):
            # If the field does not read a neighbour, ``row`` has no entries for this neighbour.
            parts = iter(row)
            for block, there in zip(blocks, self._columns(), strict=True):
                for j in range(size):
                    slope = space.zero if there is None else next(parts)
                    # The matrix is 1 - g'(u). The unit matrix occurs only in the columns of the site itself.
                    block.append((space.one if there == OWN and i == j else space.zero) - slope)
        # Every neighbour in a periodic chain exists, so the kernel needs no flags.
        exists = () if self.sites.periodic else tuple(map(self._exists, range(len(self.sites.offsets))))
        kernel = self._kernel(label, [x for block in blocks for x in block])
        # Only the numbers that occur in the matrix are loaded.
        read = {n.payload for n in walk(kernel.expressions()) if n.op == "sym"}
        loads = tuple(load for load in self.loads.values() if load.symbol in read)
        residual, border, matrix = first
        return SiteNewton(kernel, loads, exists, size, residual, border, matrix)

    def _columns(self) -> tuple[int | None, int, int | None]:
        """Return the indices of the left neighbour, of the site itself, and of the right neighbour.

        The index of a neighbour is None if the field does not read this neighbour.
        """
        offsets = self.sites.offsets
        left, right = (offsets.index(x) if x in offsets else None for x in (LEFT, RIGHT))
        return left, OWN, right

    def _unknowns(self, solve: Solve, site: int | None) -> list[str]:
        if site is None:
            return []
        listed = [x for u in solve.unknowns for x in flatten(u.kind, self.value(u, site))]
        return [str(x.payload) for x in listed]

    def _exists(self, neighbour: int) -> str:
        name = f"exists_{neighbour}"
        while name in self.problem.symbols or name in self.problem.runtime:
            name += "_"
        return name

    def value(self, var: Var, site: int) -> Value:
        """Return an expression for the value of a variable at a site.

        ``site`` is :data:`OWN` for the site itself, or the index of a neighbour.
        """
        # The same variable has different values at the site and at its neighbours.
        key = (site, var)
        if key not in self.values:
            maker = self.makers.get(var)
            # Values computed before the iteration are read from memory if they are expensive. Cheap values
            # are computed again.
            if maker is None or (var not in self.inside and not isinstance(maker.operation, RECOMPUTED)):
                self.values[key] = self._stored(var, site)
                return self.values[key]
            if isinstance(maker.operation, EVALUATED):
                results = self._field(maker, site)
            else:
                args = tuple(self.value(a, site) for a in maker.args)
                results = maker.operation.evaluate(self.problem, self.domain, args)
            for target, result in zip(maker.targets, results, strict=True):
                self.values[site, target] = result
        return self.values[key]

    def _stored(self, var: Var, site: int) -> Value:
        if var.kind is Kind.REAL:
            return self.domain.space.sym(var.name)
        blocks = {block.name: block.symbols for block in self.problem.state}
        # A variable is stored in rows of the lattice arrays, one row for each coordinate.
        rows = self.rows[var]
        names = blocks[var.name] if var in self.given else [f"{var.name}_{k}" for k in range(len(rows))]
        if site != OWN:
            names = [f"{name}_near_{site}" for name in names]
        if site != OWN or var not in self.given:
            names = [self._fresh(name) for name in names]
        self.loads |= {s: Load(s, row, site) for s, row in zip(names, rows, strict=True)}
        return tuple(map(self.domain.space.sym, names))

    def _field(self, maker: Assign, site: int) -> tuple[Value, ...]:
        """Return the field at a site, computed from the stage values of the site and of its neighbours."""
        # In nested evaluations, one evaluation of the field reads the result of another evaluation. For
        # example, the field at site i reads the field at site i + 1, and the field at site i + 1 reads values
        # at site i + 2. Then the equations at site i depend on values at site i + 2, and Newton's matrix is
        # not block-tridiagonal.
        if site != OWN:
            raise MethodError(
                "Newton's method for a chain of sites cannot solve equations with nested evaluations of the "
                "field",
                where=self.problem.name,
                expected="a method whose implicit equations contain no nested evaluations of the field",
                hint="use the option --solver fixed-point",
            )
        domain, number = self.domain, len(self.problem.state)
        args = [self.value(a, OWN) for a in maker.args]
        point = tuple(x for block in args[:number] for x in block)
        values = self.problem.values(domain, point, *args[number:])
        for k, column in enumerate(self.sites.symbols):
            outside = list(self.sites.outside[k]) if self.sites.outside else []
            ghosts = evaluate(outside, domain, values) if outside else []
            for index, place in enumerate(blocks_of(self.problem)):
                if index not in self.coupled:
                    continue
                there = self.value(maker.args[index], k)
                if outside:
                    exists = domain.space.sym(self._exists(k))
                    # The result is the value x of the neighbour (``exists`` is 1) or the ghost g (``exists``
                    # is 0).
                    there = tuple(g + exists * (x - g) for x, g in zip(there, ghosts[place], strict=True))
                # The tuple ``there`` contains the values of neighbour k.
                values |= dict(zip(column[place], there, strict=True))
        f, dim = tuple(evaluate(list(self.problem.roots), domain, values)), self.problem.group.dim
        return (f[:dim], f[dim:]) if self.problem.paired else (f,)

    def _fresh(self, base: str) -> str:
        return unique_name(base, self.taken)

    def _kernel(self, label: str, ends: list[Expr]) -> Kernel:
        self.taken |= {*self.loads, *(self._exists(k) for k in range(len(self.sites.offsets)))}
        schedule = Assignments((), ends, {}, self._fresh)
        body = tuple(x for x in schedule.run() if isinstance(x, Let))
        block = StateBlock("site", tuple(self.loads), "the numbers that Newton's matrix depends on")
        return Kernel(label, (block,), (TIME, "h", *self.problem.runtime), body, schedule.outputs)
