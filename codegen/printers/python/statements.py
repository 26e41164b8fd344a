"""Statements of a step in Python: assignments, and ``for ... else`` for a fixed point."""

from __future__ import annotations

import keyword
from collections.abc import Iterator, Sequence

from codegen.ir.expr import Expr
from codegen.ir.number import Number
from codegen.kernel.schedule import Arrangement, Assignment, Beginning, Invocation, Iteration, Simple
from codegen.printers.expression import Style, spell
from codegen.printers.identifiers import Place
from codegen.printers.names import Names
from codegen.printers.precision import DOUBLE, Precision
from codegen.printers.python import loops
from codegen.printers.python.text import filled, indented

_WORDS = """
    abs all max min range float len list map sum tuple zip ArithmeticError ValueError
    sqrt sin cos exp log sinh cosh inf isfinite still close quotient signed_stumpff0 signed_stumpff1
    state statistics steps step stride trajectory run row rows sweep change scale total
    settled error failure labels count made new memory invert fabs slope2 slope3
    float32 errstate inputs _sampled copysign comb
    end now size left last taken then rtol atol limit refused before shrunk norm wish factor
    LIMIT moving vector jacobian columns column _vary _substep fraction offset enumerate k right
    OK NOT_CONVERGED NOT_FINITE BAD_STEP StepFailed Statistics
"""
RESERVED = frozenset(keyword.kwlist) | frozenset(_WORDS.split())
"""Words that no variable may take."""


class Statements:
    """Prints the statements of one arrangement at the indentation of a function body.

    In single precision constants are NumPy's float32, made once: ``constants`` maps their names, which begin
    with ``letter``, to digits. ``blocks`` say where those of the state lie.
    """

    def __init__(
        self,
        arrangement: Arrangement,
        names: Names,
        precision: Precision = DOUBLE,
        letter: str = "C",
        blocks: Sequence[Place] = (),
    ) -> None:
        self.arrangement, self.names, self.precision, self.letter = arrangement, names, precision, letter
        self.blocks = tuple(blocks)
        self.constants: dict[str, str] = {}
        self._named: dict[str, str] = {}
        self.style = Style() if precision is DOUBLE else Style(self._constant)

    def _constant(self, value: Number) -> str:
        """Return the name of a rounded constant, with its sign."""
        text = self.precision.text(self.precision.round(value))
        size = text.removeprefix("-")
        if size not in self._named:
            self._named[size] = self.names.fresh(f"{self.letter}{len(self._named) + 1}")
            self.constants[self._named[size]] = size
        return ("-" if text.startswith("-") else "") + self._named[size]

    def lines(self) -> Iterator[str]:
        """Yield the lines of every statement, in order."""
        for statement in self.arrangement.statements:
            if isinstance(statement, Iteration):
                yield from loops.iteration(self, statement)
            elif isinstance(statement, Beginning):
                yield from loops.beginning(self, statement)
            else:
                yield from self.simple(statement, 1)

    def outputs(self, symbols: tuple[str, ...]) -> tuple[list[str], tuple[str, ...]]:
        """Return the lines that name the new state, and its identifiers in state order."""
        lines: list[str] = []
        found: list[str] = []
        for symbol, value in zip(symbols, self.arrangement.outputs, strict=True):
            if value.op == "sym" and value.payload not in symbols:
                found.append(self.names.spelled[value.payload])
                continue
            found.append(self.names.fresh(f"new_{symbol}"))
            lines += self.assign(found[-1], value, 1)
        return lines, tuple(found)

    def errors(self) -> tuple[str, ...]:
        """Return the estimate of the error, component by component."""
        values = self.arrangement.errors
        return tuple(" ".join(spell(value, self.names.spelled, self.style)) for value in values)

    def assign(self, name: str, value: Expr, depth: int) -> list[str]:
        """Return the lines of name = value."""
        return indented(f"{name} = ", spell(value, self.names.spelled, self.style), depth)

    def listing(self, name: str, values: Sequence[Expr], depth: int) -> Iterator[str]:
        """Yield the lines of name = [values]."""
        spelled = [" ".join(spell(value, self.names.spelled, self.style)) for value in values]
        yield from filled(f"{name} = [", spelled, "]", depth)

    def simple(self, statement: Simple, depth: int) -> Iterator[str]:
        """Yield the lines of an assignment or joint call."""
        if isinstance(statement, Assignment):
            yield from self.assign(self.names.spelled[statement.name], statement.value, depth)
            return
        if isinstance(statement, Invocation):
            given = [" ".join(spell(x, self.names.spelled, self.style)) for x in statement.arguments]
            name = self.names.spelled[statement.name]
            yield from filled(f"{name} = _{statement.function}(", given, ")", depth)
            return
        argument = " ".join(spell(statement.argument, self.names.spelled, self.style))
        names = ", ".join(self.names.spelled[n] for n in statement.names)
        yield f"{'    ' * depth}{names} = _{statement.function}({argument})"
