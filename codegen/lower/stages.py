"""Stages of a step: inputs, stage times, evaluations of the scene, and one block that contains all stages."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from codegen.ir.number import Number
from codegen.ir.program import Builder, Program, Solve, Statement
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring.protocol import Element


@dataclass
class Stages:
    """Collects the stages of a method into a program.

    The program consists of initial guesses of the unknowns ("starts"), one block with the right-hand sides of
    the fixed-point equations ("images"), and the update.
    """

    scene: Problem
    method: Method
    inputs: tuple[Var, ...]
    builder: Builder = field(init=False)
    time: Var | None = field(init=False)

    def __post_init__(self) -> None:
        # t and h are arguments of emitted code, so no value may have these names.
        self.builder = Builder({v.name for v in self.inputs} | {"t", "h"})
        self.time = None if self.scene.autonomous else Var("t", Kind.REAL)

    def number(self, x: Element) -> Number:
        """Return a coefficient of the tableau as a number. A rational coefficient becomes an element of QQ in
        every case, even if the ring of the tableau is larger."""
        return self.method.number(x)

    def times_h(self, x: Element | Number) -> Coefficient:
        """Return the coefficient h x."""
        return Coefficient(x if isinstance(x, Number) else self.number(x), 1)

    def combination(self, target: str, kind: Kind, row: Sequence[Element], values: Sequence[Var]) -> Var:
        """Append target = h sum_j row_j values_j."""
        terms = [(self.times_h(x), v) for x, v in zip(row, values, strict=True)]
        return self.builder.lin(target, kind, terms)

    def at(self, c: Element | None) -> tuple[Var, ...]:
        """Return the time argument (t + c h,), or () if the scene does not depend on time; None means c =
        0."""
        if self.time is None:
            return ()
        # A stage at the beginning of the step reads t itself and not a copy of t. Otherwise equal evaluations
        # would have different arguments.
        if c is None or self.number(c).is_zero:
            return (self.time,)
        return (self.builder.advance("t_stage", self.time, self.times_h(c)),)

    def f(self, target: str, y: Var, c: Element | None) -> Var:
        """Append target = f(y, t + c h)."""
        time = self.at(c)
        return self.builder.field_at(target, y, *time)

    def program(
        self,
        unknowns: Sequence[Var],
        images: Callable[[], Sequence[Var]],
        starts: Callable[[], Sequence[Var]],
        update: Callable[[], dict[str, Var]],
    ) -> Program:
        """Return the verified program: the starts, one block with the equations, and the update.

        The arguments ``images``, ``starts`` and ``update`` are functions that append statements and return
        variables. ``update`` returns each output under the name of the input that the output replaces.
        """
        # The statements are appended in the order of the program: starts, body of the block, update.
        first = tuple(starts())
        before = self.builder.take()
        last = tuple(images())
        # All stages are put into one block, even if the tableau is explicit. A lowering only states the
        # equations. Later passes find an order in which the stages can be computed.
        block = Solve("stages", tuple(unknowns), first, self.builder.take(), last)
        # The statements of the update follow the block, because they read values that the body of the block
        # computes at the solution.
        outputs = update()
        # The time is the last input, so that the state has the same position with and without time.
        inputs = self.inputs + (() if self.time is None else (self.time,))
        body: tuple[Statement, ...] = (*before, block, *self.builder.take())
        return verify(Program(self.method.label, inputs, body, tuple(outputs.items())))
