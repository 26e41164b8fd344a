"""Statements of a step in Python: assignments, and ``for ... else`` for a fixed point."""

from __future__ import annotations

import json
import keyword
from collections.abc import Iterator, Sequence

from codegen.ir.expr import Expr
from codegen.ir.number import Number
from codegen.printers.arrange import Arrangement, Assignment, Iteration, Joint
from codegen.printers.expression import Style, spell
from codegen.printers.names import Names
from codegen.printers.precision import DOUBLE, Precision

WIDTH = 88

_WORDS = """
    abs all max range float len list map sum tuple zip ArithmeticError ValueError
    sqrt sin cos exp log sinh cosh inf isfinite still close quotient signed_stumpff0 signed_stumpff1
    state statistics steps step stride trajectory run row rows sweep change scale total
    settled error failure labels count made new
    float32 errstate inputs _sampled copysign
    end now size left last taken then rtol atol limit refused before shrunk norm wish factor
    LIMIT
    OK NOT_CONVERGED NOT_FINITE BAD_STEP StepFailed Statistics
"""
RESERVED = frozenset(keyword.kwlist) | frozenset(_WORDS.split())
"""Words that no variable may take."""


class Statements:
    """Prints the statements of one arrangement at the indentation of a function body.

    In single precision constants are NumPy's float32, made once: ``constants`` maps their names, which begin
    with ``letter``, to digits.
    """

    def __init__(
        self, arrangement: Arrangement, names: Names, precision: Precision = DOUBLE, letter: str = "C"
    ) -> None:
        self.arrangement, self.names, self.precision, self.letter = arrangement, names, precision, letter
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
                yield from self._iteration(statement)
            else:
                yield from self._simple(statement, 1)

    def outputs(self, symbols: tuple[str, ...]) -> tuple[list[str], tuple[str, ...]]:
        """Return the lines that name the new state, and its identifiers in state order."""
        lines: list[str] = []
        found: list[str] = []
        for symbol, value in zip(symbols, self.arrangement.outputs, strict=True):
            if value.op == "sym" and value.payload not in symbols:
                found.append(self.names.spelled[value.payload])
                continue
            found.append(self.names.fresh(f"new_{symbol}"))
            lines += self._assign(found[-1], value, 1)
        return lines, tuple(found)

    def errors(self) -> tuple[str, ...]:
        """Return the estimate of the error, component by component."""
        values = self.arrangement.errors
        return tuple(" ".join(spell(value, self.names.spelled, self.style)) for value in values)

    def _assign(self, name: str, value: Expr, depth: int) -> list[str]:
        return indented(f"{name} = ", spell(value, self.names.spelled, self.style), depth)

    def _simple(self, statement: Assignment | Joint, depth: int) -> Iterator[str]:
        if isinstance(statement, Assignment):
            yield from self._assign(self.names.spelled[statement.name], statement.value, depth)
            return
        argument = " ".join(spell(statement.argument, self.names.spelled, self.style))
        names = ", ".join(self.names.spelled[n] for n in statement.names)
        yield f"{'    ' * depth}{names} = _{statement.function}({argument})"

    def _limit(self, tolerance: float) -> str:
        """Spell a tolerance for doubles as one of this precision."""
        return self.precision.text(self.precision.scaled(tolerance))

    def _iteration(self, statement: Iteration) -> Iterator[str]:
        loop, number = statement.loop, statement.number
        now = [self.names.spelled[u] for u in loop.unknowns]
        plain = [x.op == "sym" and x.payload not in loop.unknowns for x in statement.images]
        new = [
            self.names.spelled[x.payload] if already else self.names.fresh(f"next_{u}")
            for u, x, already in zip(loop.unknowns, statement.images, plain, strict=True)
        ]
        differences = [self.names.fresh(f"change_{u}") for u in loop.unknowns]
        previous = self.names.fresh(f"previous_{number}")
        close, tolerance = (self._limit(x) for x in (loop.close, loop.tolerance))
        unit = self.precision.text(self.precision.unit)
        failure = f"{quoted(loop.label)}, {number - 1}, sweep, statistics)"
        yield from indented("# ", (f"{loop.label}: fixed point in {', '.join(now)}",), 1)
        for name, start in zip(now, statement.starts, strict=True):
            yield from self._assign(name, start, 1)
        yield f"    {previous} = 0.0"
        yield f"    for sweep in range(1, {loop.limit + 1}):"
        for inner in statement.body:
            yield from self._simple(inner, 2)
        for name, image, already in zip(new, statement.images, plain, strict=True):
            yield from [] if already else self._assign(name, image, 2)
        for difference, x, y in zip(differences, new, now, strict=True):
            yield f"        {difference} = abs({x} - {y})"
        yield from call("change = max", differences, 2)
        yield from call("scale = max", ["1.0", *(f"abs({x})" for x in now)], 2)
        pieces = (differences[0], *(f"+ {x}" for x in differences[1:]))
        yield from indented("total = ", pieces, 2)
        yield "        if not isfinite(total):"
        yield f"            raise _failed(NOT_FINITE, {failure}"
        yield f"        still = 0.0 < {previous} <= change <= {tolerance} * scale"
        yield f"        close = change * change <= {unit} * scale * {previous}"
        yield f"        if still or (close and change <= {close} * scale):"
        yield "            break"
        yield f"        {previous} = change"
        for x, y in zip(now, new, strict=True):
            yield f"        {x} = {y}"
        yield "    else:"
        yield f"        raise _failed(NOT_CONVERGED, {failure}"
        yield "    if statistics is not None:"
        yield f"        statistics.count({number - 1}, sweep)"


def quoted(text: str) -> str:
    """Spell a string with double quotes."""
    return json.dumps(text, ensure_ascii=False)


def call(start: str, terms: list[str], depth: int) -> list[str]:
    """Return a call of a function of several terms; of one term, the term itself."""
    space = "    " * depth
    if len(terms) == 1:
        return [f"{space}{start.rpartition(' ')[0]} {terms[0]}"]
    line = f"{space}{start}({', '.join(terms)})"
    if len(line) <= WIDTH:
        return [line]
    return [f"{space}{start}(", *(f"{space}    {term}," for term in terms), f"{space})"]


def indented(start: str, pieces: tuple[str, ...], depth: int) -> list[str]:
    """Return start and pieces on one line, or in parentheses with a piece a line where that is too long.

    >>> indented("x = ", ("a", "+ b"), 1)
    ['    x = a + b']
    """
    space = "    " * depth
    line = f"{space}{start}{' '.join(pieces)}"
    if len(line) <= WIDTH or len(pieces) == 1:
        return [line]
    inner = f"{space}    {' '.join(pieces)}"
    lines = [inner] if len(inner) <= WIDTH else [f"{space}    {piece}" for piece in pieces]
    return [f"{space}{start}(", *lines, f"{space})"]


def listed(start: str, terms: Sequence[str], depth: int) -> list[str]:
    """Return start and a tuple of terms: bare on one line, else in parentheses with a term a line."""
    space = "    " * depth
    line = f"{space}{start}{', '.join(terms)}{',' if len(terms) == 1 else ''}"
    if len(line) <= WIDTH:
        return [line]
    return [f"{space}{start}(", *(f"{space}    {term}," for term in terms), f"{space})"]
