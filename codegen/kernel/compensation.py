"""Extend the steps of a method by compensated summation (Kahan summation).

The carry is the rounding error in the addition of the previous step. A step from y0 with the increment d
computes s = d + carry, y1 = y0 + s and the new carry s - (y1 - y0).

The increment of a step exp(x) y0 of a group action is (exp(x) - 1) y0, and exp(x) - 1 is computed without
cancellation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.errors import MethodError
from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import Field, Kernel, Let, Loop, Start
from codegen.ir.program import Program
from codegen.kernel.translate import to_kernel
from codegen.scene.problem import Problem

CARRY = "carry_"

Statement = Let | Start | Loop


def compensated(kernel: Kernel, program: Program, problem: Problem) -> Kernel:
    """Return the kernel with an extended state: the coordinates, then one carry for each coordinate.

    A carry is the stored rounding error of a coordinate, and is zero initially. :class:`MethodError` is
    raised if a new coordinate is not the old coordinate plus an increment, or if the step consists of loops
    over arrays.
    """
    if kernel.arrays is not None:
        raise MethodError(
            "compensated summation is not available for scenes with large matrices",
            where=problem.name,
            expected="a scene with a formula for each coordinate",
            hint="leave out --compensate",
        )
    if kernel.deferred is not None:
        kernel = to_kernel(program, problem)
    if kernel.carried is not None:
        solvers = {loop.label: loop.solver for loop in kernel.loops}
        kernel = to_kernel(program, problem, solvers, whole=True)
    return with_carries(kernel)


def with_carries(kernel: Kernel) -> Kernel:
    """Return ``kernel`` extended by the carry (rounding error) of each coordinate."""
    space = kernel.outputs[0].space
    increments = Increments(kernel)
    symbols = [s for field in kernel.state for s in field.symbols]
    body, sums, carries = list(kernel.body), [], []
    for name, output in zip(symbols, kernel.outputs, strict=True):
        old, added = space.sym(name), increments.of(output, name)
        if added is None:
            raise MethodError(
                f"the new value of {name} is not its old value plus an increment",
                expected="a method that adds an increment to each coordinate of the old state",
            )
        # The step does not change this coordinate, so the carry does not change.
        if added.is_zero:
            sums.append(old)
            carries.append(space.sym(CARRY + name))
            continue
        # The increment is small, so its sum with the carry has a small rounding error.
        body += [
            Let(f"added_{name}", added + space.sym(CARRY + name)),
            Let(f"sum_{name}", old + space.sym(f"added_{name}")),
        ]
        # A symbol is used in place of the sum, because ``total - old`` would otherwise be simplified.
        total = space.sym(f"sum_{name}")
        sums.append(total)
        # The carry is the part of the increment lost by rounding in ``total``.
        carries.append(space.sym(f"added_{name}") - (total - old))
    fields = tuple(
        Field(CARRY + f.name, tuple(CARRY + s for s in f.symbols), f"rounding errors of {f.name}")
        for f in kernel.state
    )
    return replace(
        kernel,
        state=(*kernel.state, *fields),
        body=_live(body, (*sums, *carries)),
        outputs=(*sums, *carries),
        # A flow outside of the steps would change the state without an update of the stored rounding errors.
        # Therefore the compensated kernel has no deferred flows.
        deferred=None,
        estimate=None,
        vary=None,
    )


def _live(body: Sequence[Statement], outputs: Sequence[Expr]) -> tuple[Statement, ...]:
    """Return ``body`` without the assignments that ``outputs`` do not need."""
    needed = {n.payload for n in walk(outputs) if n.op == "sym"}
    kept: list[Statement] = []
    # At each statement, ``needed`` contains all names that later statements and ``outputs`` read.
    for statement in reversed(body):
        if isinstance(statement, Let) and statement.name not in needed:
            continue
        # A statement has no method ``expressions``, so a kernel is created that contains only ``statement``.
        roots = replace(_EMPTY, body=(statement,)).expressions()
        needed |= {n.payload for n in walk(roots) if n.op == "sym"}
        kept.append(statement)
    return tuple(reversed(kept))


_EMPTY = Kernel("", (), (), (), ())


class Increments:
    """Finds the increment d in expressions of the form x + d or 1 + d, where x is a symbol.

    In floating-point arithmetic, the differences (x + d) - x and (1 + d) - 1 would lose leading digits by
    cancellation. Therefore d is found by symbolic transformations of the expression.
    """

    def __init__(self, kernel: Kernel) -> None:
        self.values = {let.name: let.value for let in kernel.lets()}
        self.space = kernel.outputs[0].space
        self.increments: dict[tuple[int, str], Expr | None] = {}
        self.factors: dict[int, Expr | None] = {}

    def of(self, e: Expr, name: str) -> Expr | None:
        """Return e minus the symbol ``name``, or None if e does not have the form symbol + increment."""
        key = (e.id, name)
        if key not in self.increments:
            self.increments[key] = self._of(e, name)
        return self.increments[key]

    def _of(self, e: Expr, name: str) -> Expr | None:
        if e.op == "sym":
            if e.payload == name:
                return self.space.zero
            return self.of(self.values[e.payload], name) if e.payload in self.values else None
        if e.op in ("add", "sub"):
            a, b = e.args
            # Here ``rest`` is the expression ``a`` minus the symbol ``name``.
            if (rest := self.of(a, name)) is not None:
                return rest + b if e.op == "add" else rest - b
            # Here ``rest`` is the expression ``b`` minus the symbol ``name``.
            if e.op == "add" and (rest := self.of(b, name)) is not None:
                return a + rest
        if e.op == "mul":
            # A product is commutative, so either argument can contain the old coordinate.
            for factor, base in (e.args, e.args[::-1]):
                # Let f be ``factor``, b ``base`` and x the symbol ``name``. The result is the product f b
                # minus the symbol x: f b - x = (f - 1) b + (b - x).
                rest, more = self.of(base, name), self.less_one(factor)
                if rest is not None and more is not None:
                    return more * base + rest
        return None

    def less_one(self, f: Expr) -> Expr | None:
        """Return an expression for f - 1 without cancellation, or None if no such expression is found."""
        if f.id not in self.factors:
            self.factors[f.id] = self._less_one(f)
        return self.factors[f.id]

    def _less_one(self, f: Expr) -> Expr | None:
        if f is self.space.one:
            return self.space.zero
        if f.op == "sym":
            return self.less_one(self.values[f.payload]) if f.payload in self.values else None
        if f.op in ("add", "sub"):
            a, b = f.args
            if (rest := self.less_one(a)) is not None:
                return rest + b if f.op == "add" else rest - b
            if f.op == "add" and (rest := self.less_one(b)) is not None:
                return a + rest
        if f.op == "mul":
            first, second = map(self.less_one, f.args)
            if first is not None and second is not None:
                # For a product of two factors f and g: f g - 1 = (f - 1) + (g - 1) + (f - 1)(g - 1).
                return first + second + first * second
        # The Stumpff functions c_0(z) = cos(sqrt(z)) and c_2 satisfy c_0(z) - 1 = -z c_2(z).
        if f.op == "call" and f.payload == "stumpff0":
            return -(f.args[0] * self.space.call("stumpff2", f.args[0]))
        return None
