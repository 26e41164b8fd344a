"""Implicit equations u = g(u) of a step, and the matrix of Newton's method.

The values g(u) are called images, and Newton's matrix is 1 - g'(u). For equations r(u) = 0 with
the residual r(u), Newton's matrix is -r'(u). One iteration of a solver is called a sweep.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import SIMPLIFIED_NEWTON
from codegen.ir.linearise import FirstOrder, NotLinearised
from codegen.ir.normal_form import NormalForms
from codegen.ir.program import Program, Solve
from codegen.ir.values import Kind, Var
from codegen.kernel import newton
from codegen.passes.rewrite import uses

MANY = 12
"""For at most MANY unknowns, each product a (b + c) in Newton's matrix is expanded to a b + a c.

For more unknowns, the product is kept if the sum b + c is computed outside the loop of the solver and
contains neither h nor unknowns. All other products are expanded.
"""

LONGEST_MATRIX = 1500
"""The largest number of operations for the exact matrix of Newton's method. A matrix with more operations is
replaced by its expansion to first order in h.

The value is not critical: the limits 1500 and 6000 give the same emitted kernels.
"""

WEIGHT = {"call": 10, "div": 4, "neg": 0}
"""Costs of operations, as rough latencies. Operations that are not listed have the cost 1."""


@dataclass(frozen=True)
class Block:
    """A block of equations u = g(u) as expressions.

    - ``unknowns`` are the names of the unknowns u, and ``starts`` are their starting values.
    - ``images`` are the values g(u), or the residuals r(u) if the equations are r(u) = 0.
    - ``matrix`` is Newton's matrix, or its inverse if ``inverted`` is true.
    - ``leading`` is true for the simplified Newton method, which computes the matrix before the first sweep.
    - ``changes`` contains names, or is empty. Each sweep assigns the changes of the unknowns to these names.
    - ``kept`` contains pairs (name, expression). Each sweep assigns the expression to the name. Statements
      after the loop read the name.
    """

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    images: tuple[Expr, ...]
    matrix: tuple[tuple[Expr, ...], ...] = ()
    leading: bool = False
    inverted: bool = False
    changes: tuple[str, ...] = ()
    kept: tuple[tuple[str, Expr], ...] = ()

    def targets(self) -> tuple[Expr, ...]:
        """Return the expressions that each sweep (iteration) computes.

        These are ``images`` (the values g(u) or r(u)), followed by the expressions in ``kept``.
        """
        return (*self.images, *(x for _, x in self.kept))


def compared(
    block: Solve, entered: Block, env: dict[Var, Any], name: Callable[[str], str], program: Program
) -> Block | None:
    """Return a copy of ``entered`` with Newton's matrix. The ``images`` of the copy are the residuals r(u).

    ``block`` and ``entered`` describe the same equations. The matrix is -r'(u), expanded to first order in h.
    The result is None if ``block`` has no residuals, or if the residuals cannot be expanded in h.

    The function also replaces some values in ``env`` by cheaper approximations. If a sweep (one iteration)
    changes the unknowns from u to u + d, the approximation of a value v(u + d) is v(u) + J d. The matrix J is
    v'(u) to first order in h. Only elements of a Lie algebra or of its dual space are replaced.
    """
    residuals = tuple(x for v in block.residuals for x in flatten(v.kind, env[v]))
    if not residuals:
        return None
    space = residuals[0].space
    inside = {v for assign in block.body for v in assign.targets}
    known = _sums_outside(env, inside)
    many = len(entered.unknowns) > MANY
    later = _read_after(block, program) if many else frozenset()
    # The sums in ``free`` are not multiplied out: ``NormalForms`` treats each sum as a single symbol.
    free = _independent(known, entered.unknowns) if many else []
    normal, linear = NormalForms(space, whole=free), FirstOrder(entered.unknowns)
    try:
        rows = linear.jacobian(residuals)
    # A residual with a pole or a branch point at h = 0 cannot be expanded.
    except NotLinearised:
        return None
    changes = tuple(name(f"d_{u}") for u in entered.unknowns)
    kept: list[tuple[str, Expr]] = []
    for var in (target for assign in block.body for target in assign.targets):
        # Only values in vector spaces are corrected, because the correction is an addition.
        if var.kind not in (Kind.ALG, Kind.DUAL) or (many and var not in later):
            continue
        try:
            slopes = linear.jacobian(env[var])
        except NotLinearised:
            continue
        symbols = tuple(space.sym(name(f"{var.name}_{k}_seen")) for k in range(len(env[var])))
        moved = []
        for symbol, row in zip(symbols, slopes, strict=True):
            total = symbol
            for slope, change in zip(row, changes, strict=True):
                total = total + normal(slope) * space.sym(change)
            moved.append(total)
        if 2 * _operations(moved) < _operations(env[var]):
            kept += [(s.payload, x) for s, x in zip(symbols, env[var], strict=True)]
            env[var] = tuple(moved)
    # One step of Newton's method for r(u) = 0 adds (-r')^{-1} r to u.
    matrix = tuple(tuple(-normal(x) for x in row) for row in rows)
    inverted = len(matrix) <= newton.SMALL
    return replace(
        entered,
        images=residuals,
        matrix=newton.inverse(matrix) if inverted else matrix,
        inverted=inverted,
        changes=changes,
        kept=tuple(kept),
    )


def _sums_outside(env: dict[Var, Any], inside: set[Var]) -> list[Expr]:
    """Return the sums and differences in ``env``. The variables in ``inside`` are skipped."""
    values = (x for v, value in env.items() if v not in inside for x in flatten(v.kind, value))
    return [x for x in values if x.op in ("add", "sub")]


def _read_after(block: Solve, program: Program) -> frozenset[Var]:
    """Return the variables that the statements after ``block`` read."""
    rest = program.body[program.body.index(block) + 1 :]
    return frozenset(uses(replace(program, body=rest)))


def _independent(values: Sequence[Expr], unknowns: Sequence[str]) -> list[Expr]:
    """Return the values that contain neither h nor an unknown."""
    moving = {*unknowns, "h"}
    # ``walk`` yields the arguments of a node before the node.
    depends: dict[int, bool] = {}
    for node in walk(values):
        own = node.op == "sym" and node.payload in moving
        depends[node.id] = own or any(depends[a.id] for a in node.args)
    return [x for x in values if not depends[x.id]]


def _operations(roots: Iterable[Expr]) -> int:
    return sum(WEIGHT.get(n.op, 1) for n in walk(roots) if n.args)


def with_matrix(block: Block, solver: str) -> Block:
    """Return the block with the matrix of Newton's method.

    The matrix is expanded to first order in h if ``solver`` is SIMPLIFIED_NEWTON, or if the exact matrix has
    more than LONGEST_MATRIX operations. Operations in ``block.images`` are not counted.
    """
    leading = solver == SIMPLIFIED_NEWTON
    rows = (newton.leading_matrix if leading else newton.matrix)(block.images, block.unknowns)
    # The first-order matrix needs more sweeps than the exact matrix, but less work in each sweep.
    if not leading and _own(rows, block.images) > LONGEST_MATRIX:
        rows = newton.leading_matrix(block.images, block.unknowns)
    # A small matrix is inverted by formulas, and a larger matrix by elimination at run time.
    inverted = len(rows) <= newton.SMALL
    return replace(
        block, matrix=newton.inverse(rows) if inverted else rows, leading=leading, inverted=inverted
    )


def _own(rows: Iterable[Iterable[Expr]], images: Sequence[Expr]) -> int:
    """Count the operations that occur in the matrix ``rows``, but not in ``images``."""
    # Each sweep computes the images g(u) anyway, so their operations are not counted.
    shared = {n.id for n in walk(images)}
    return sum(1 for n in walk([x for row in rows for x in row]) if n.args and n.id not in shared)


class Solved:
    """Replaces expressions g_i(u) by the unknowns u_i. This is correct for the solution of u = g(u)."""

    def __init__(self, block: Block) -> None:
        self.space: Space = block.images[0].space
        self.known: dict[int, Expr] = {}
        for name, image in zip(block.unknowns, block.images, strict=True):
            # ``image`` is an expression g_i(u). A symbol or a number costs nothing, so it is not replaced.
            if image.args:
                self.known[image.id] = self.space.sym(name)

    def value(self, value: Any) -> Any:
        """Return ``value`` with the unknown u_i in place of each expression g_i(u).

        The equations are u_i = g_i(u).
        """
        return tuple(map(self._one, value)) if isinstance(value, tuple) else self._one(value)

    def _one(self, root: Expr) -> Expr:
        # ``walk`` stops at nodes with a known replacement.
        for node in walk([root], stop=lambda n: n.id in self.known):
            if node.id not in self.known:
                args = tuple(self.known[a.id] for a in node.args)
                same = all(a is b for a, b in zip(args, node.args, strict=True))
                # If no argument changes, the old node is used, because other expressions share it.
                self.known[node.id] = node if same else self._rebuilt(node, args)
        return self.known[root.id]

    def _rebuilt(self, node: Expr, args: tuple[Expr, ...]) -> Expr:
        match node.op:
            case "pow":
                return self.space.pow(args[0], node.payload)
            case "call":
                return self.space.call(node.payload, *args)
            case op:
                rebuilt: Expr = getattr(self.space, op)(*args)
                return rebuilt
