"""Builds the program of a step from the equations of its stages."""

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
    """Builds the program of one step of a method.

    The stages are given by fixed-point equations. The program consists of three parts:

    - the initial guesses of the unknowns ("starts"),
    - the right-hand sides of the equations ("images"),
    - the update, which computes the new state from the solution of the equations.
    """

    scene: Problem
    method: Method
    inputs: tuple[Var, ...]
    builder: Builder = field(init=False)
    time: Var | None = field(init=False)

    def __post_init__(self) -> None:
        # Emitted functions have the arguments t and h, so other values must not have these names.
        self.builder = Builder({v.name for v in self.inputs} | {"t", "h"})
        # An autonomous field ignores the time, so its program has no input t.
        self.time = None if self.scene.autonomous else Var("t", Kind.REAL)

    def number(self, x: Element) -> Number:
        """Return a coefficient of the tableau as a :class:`Number`."""
        return self.method.number(x)

    def times_h(self, x: Element | Number) -> Coefficient:
        """Return the coefficient h x, where h is the step size."""
        return Coefficient(x if isinstance(x, Number) else self.number(x), 1)

    def combination(self, target: str, kind: Kind, row: Sequence[Element], values: Sequence[Var]) -> Var:
        """Append the statement target = h sum_j row_j values_j, and return its variable."""
        # A later pass of the compiler removes the terms with the coefficient zero.
        terms = [(self.times_h(x), v) for x, v in zip(row, values, strict=True)]
        return self.builder.lin(target, kind, terms)

    def at(self, c: Element | None) -> tuple[Var, ...]:
        """Return a tuple with the time t + c h.

        If ``c`` is None, the time is t. If the scene does not depend on time, the tuple is empty.
        """
        if self.time is None:
            return ()
        # For c = 0, the time is the variable t itself, so no statement is appended.
        if c is None or self.number(c).is_zero:
            return (self.time,)
        return (self.builder.advance("t_stage", self.time, self.times_h(c)),)

    def f(self, target: str, y: Var, c: Element | None) -> Var:
        """Append the evaluation of the field at ``y`` and time t + c h, and return the value."""
        time = self.at(c)
        return self.builder.field_at(target, y, *time)

    def program(
        self,
        unknowns: Sequence[Var],
        images: Callable[[], Sequence[Var]],
        starts: Callable[[], Sequence[Var]],
        update: Callable[[], dict[str, Var]],
    ) -> Program:
        """Verify and return the program of the step.

        The functions ``starts``, ``images`` and ``update`` append statements and return variables. The result
        of ``update`` is a dictionary. For example, the dictionary maps the name "y" to the variable with the
        new value of y.
        """
        # All functions append to one builder, so the order of the calls is the order of the statements.
        first = tuple(starts())
        # Initial guesses are computed once, so their statements precede the block of the equations.
        before = self.builder.take()
        last = tuple(images())
        # If the stages can be computed one after the other, a later pass splits the block.
        block = Solve("stages", tuple(unknowns), first, self.builder.take(), last)
        # The update needs the solution of the equations, so its statements follow the Solve block.
        outputs = update()
        # The inputs are the state and, if the scene depends on time, the time.
        inputs = self.inputs + (() if self.time is None else (self.time,))
        body: tuple[Statement, ...] = (*before, block, *self.builder.take())
        return verify(Program(self.method.label, inputs, body, tuple(outputs.items())))
