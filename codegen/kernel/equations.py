"""Blocks of equations on their way to loops: images, starting values, and the matrix of Newton's method.

Of a block solved by Newton's method the matrix 1 - g' is taken from the very expressions of its images g.
After it the unknowns stand for their images, and what follows is recomputed from them where that is less than
half a sweep.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from codegen.ir.expr import Expr, Space, walk
from codegen.ir.interpret import flatten
from codegen.ir.kernel import CHORD
from codegen.ir.linearise import FirstOrder, NotLinearised
from codegen.ir.normal_form import NormalForms
from codegen.ir.program import Program, Solve
from codegen.ir.values import Kind, Var
from codegen.kernel import newton
from codegen.passes.rewrite import uses

MANY = 12
"""With more unknowns than this, entries of Newton's matrix keep as it is what does not move in a step."""

LONGEST_MATRIX = 1500
"""How many operations an exact matrix of Newton's method may take: a longer one is made to first order."""

WEIGHT = {"call": 10, "div": 4, "neg": 0}
"""What operations cost, in additions or products; those that are not named cost one."""


@dataclass(frozen=True)
class Block:
    """A loop before scheduling: names of the unknowns, expressions of starts, images and Newton's matrix."""

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
        """What a sweep computes."""
        return (*self.images, *(x for _, x in self.kept))


def compared(
    block: Solve, entered: Block, env: dict[Var, Any], name: Callable[[str], str], program: Program
) -> Block | None:
    """Return the block with its residuals for images and their derivative to first order in h for a matrix.

    None where there are no residuals, or no such derivative. What the last sweep has computed is corrected,
    where it is read later, by its own derivative to first order in h times the last change, if that takes
    fewer operations than computing it anew from the unknowns.
    """
    residuals = tuple(x for v in block.residuals for x in flatten(v.kind, env[v]))
    if not residuals:
        return None
    space = residuals[0].space
    inside = {v for assign in block.body for v in assign.targets}
    known = [
        x
        for v, value in env.items()
        if v not in inside
        for x in flatten(v.kind, value)
        if x.op in ("add", "sub")
    ]
    # Few unknowns: what is kept takes registers that sweeps need. Many: what is expanded takes lines.
    many = len(entered.unknowns) > MANY
    later = _read_after(block, program) if many else frozenset()
    free = _independent(known, entered.unknowns) if many else []
    normal, linear = NormalForms(space, whole=free), FirstOrder(entered.unknowns)
    try:
        rows = linear.jacobian(residuals)
    except NotLinearised:
        return None
    changes = tuple(name(f"d_{u}") for u in entered.unknowns)
    kept: list[tuple[str, Expr]] = []
    for var in (target for assign in block.body for target in assign.targets):
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


def _read_after(block: Solve, program: Program) -> frozenset[Var]:
    """Return the variables that a program reads after a block."""
    rest = program.body[program.body.index(block) + 1 :]
    return frozenset(uses(replace(program, body=rest)))


def _independent(values: Sequence[Expr], unknowns: Sequence[str]) -> list[Expr]:
    """Return those values that depend neither on unknowns nor on h: they stand still in an expansion."""
    moving = {*unknowns, "h"}
    depends: dict[int, bool] = {}
    for node in walk(values):
        own = node.op == "sym" and node.payload in moving
        depends[node.id] = own or any(depends[a.id] for a in node.args)
    return [x for x in values if not depends[x.id]]


def _operations(roots: Iterable[Expr]) -> int:
    return sum(WEIGHT.get(n.op, 1) for n in walk(roots) if n.args)


def with_matrix(block: Block, solver: str) -> Block:
    """Return the block with the matrix of Newton's method, or of chords."""
    leading = solver == CHORD
    rows = (newton.leading_matrix if leading else newton.matrix)(block.images, block.unknowns)
    if not leading and _own(rows, block.images) > LONGEST_MATRIX:
        rows = newton.leading_matrix(block.images, block.unknowns)
    inverted = len(rows) <= newton.SMALL
    return replace(
        block, matrix=newton.inverse(rows) if inverted else rows, leading=leading, inverted=inverted
    )


def _own(rows: Iterable[Iterable[Expr]], images: Sequence[Expr]) -> int:
    """Return how many operations a matrix takes beside those of the images."""
    shared = {n.id for n in walk(images)}
    return sum(1 for n in walk([x for row in rows for x in row]) if n.args and n.id not in shared)


class Solved:
    """Rewrites expressions for what stands after a block: there its images are its unknowns."""

    def __init__(self, block: Block) -> None:
        self.space: Space = block.images[0].space
        self.known: dict[int, Expr] = {}
        for name, image in zip(block.unknowns, block.images, strict=True):
            if image.args:
                self.known[image.id] = self.space.sym(name)

    def value(self, value: Any) -> Any:
        """Return the value of a variable, rewritten."""
        return tuple(map(self._one, value)) if isinstance(value, tuple) else self._one(value)

    def _one(self, root: Expr) -> Expr:
        for node in walk([root], stop=lambda n: n.id in self.known):
            if node.id not in self.known:
                args = tuple(self.known[a.id] for a in node.args)
                same = all(a is b for a, b in zip(args, node.args, strict=True))
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
