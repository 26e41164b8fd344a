"""Loops in Python: where unknowns begin, and ``for ... else`` for the sweeps."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from codegen.ir.kernel import Newton
from codegen.printers.arrange import Beginning, Iteration
from codegen.printers.python.text import WIDTH, call, indented, quoted

if TYPE_CHECKING:
    from codegen.printers.python.statements import Statements


def beginning(s: Statements, statement: Beginning) -> Iterator[str]:
    """Yield the lines that give the unknowns of all loops their first values."""
    unknowns = [s.names.spelled[u] for u in statement.start.unknowns]
    yield "    if memory.past:"
    yield from unpacked(unknowns, "memory.extrapolated()", 2)
    yield "    else:"
    for inner in statement.body:
        yield from s.simple(inner, 2)
    for unknown, value in zip(unknowns, statement.values, strict=True):
        yield from s.assign(unknown, value, 2)


def unpacked(names: list[str], value: str, depth: int) -> list[str]:
    """Return the lines that give the parts of a sequence their names."""
    space, comma = "    " * depth, "," if len(names) == 1 else ""
    line = f"{space}{', '.join(names)}{comma} = {value}"
    if len(line) <= WIDTH:
        return [line]
    return [f"{space}(", *(f"{space}    {name}," for name in names), f"{space}) = {value}"]


def iteration(s: Statements, statement: Iteration) -> Iterator[str]:
    """Yield the lines of one loop."""
    loop, number = statement.loop, statement.number
    now = [s.names.spelled[u] for u in loop.unknowns]
    plain = [x.op == "sym" and x.payload not in loop.unknowns for x in statement.images]
    new = [
        s.names.spelled[x.payload] if already else s.names.fresh(f"next_{u}")
        for u, x, already in zip(loop.unknowns, statement.images, plain, strict=True)
    ]
    previous = s.names.fresh(f"previous_{number}")
    how = "fixed point" if loop.newton is None else "Newton's method"
    yield from indented("# ", (f"{loop.label}: {how} in {', '.join(now)}",), 1)
    for name, start in zip(now, statement.starts, strict=False):  # none where they begin together
        yield from s.assign(name, start, 1)
    yield f"    {previous} = 0.0"
    if loop.newton is not None:
        yield f"    make_{number} = memory.inverses[{number - 1}] is None"
    yield f"    for sweep in range(1, {loop.limit + 1}):"
    for inner in statement.body:
        yield from s.simple(inner, 2)
    for name, image, already in zip(new, statement.images, plain, strict=True):
        yield from [] if already else s.assign(name, image, 2)
    changes = [s.names.fresh(f"change_{u}") for u in loop.unknowns]
    if loop.newton is None:
        for change, x, y in zip(changes, new, now, strict=True):
            yield f"        {change} = abs({x} - {y})"
        yield from _decision(s, statement, changes, changes, now, previous)
        yield f"        {previous} = change"
        yield from (f"        {x} = {y}" for x, y in zip(now, new, strict=True))
    else:
        yield from _newton(s, statement, changes, now, new, previous)
    yield "    else:"
    yield f"        raise _failed(NOT_CONVERGED, {_failure(statement)}"
    yield "    if statistics is not None:"
    yield f"        statistics.count({number - 1}, sweep)"


def _newton(
    s: Statements, statement: Iteration, changes: list[str], now: list[str], new: list[str], previous: str
) -> Iterator[str]:
    """Yield the lines that correct the unknowns by the inverse of Newton's matrix."""
    number, n = statement.number, len(now)
    residuals = [s.names.fresh(f"residual_{u}") for u in statement.loop.unknowns]
    rows = [s.names.fresh(f"row_{number}_{i + 1}") for i in range(n)]
    for residual, x, y in zip(residuals, new, now, strict=True):
        yield f"        {residual} = {x} - {y}"
    yield from _finite(s, statement, residuals)
    yield f"        if make_{number}:"
    for inner in statement.newton:
        yield from s.simple(inner, 3)
    for i, row in enumerate(rows):
        entries = statement.matrix[i * n : i * n + n]
        yield from s.listing(row, entries, 3)
    yield f"            memory.inverses[{number - 1}] = invert([{', '.join(rows)}])"
    yield "            if statistics is not None:"
    yield "                statistics.matrices += 1"
    yield f"            if memory.inverses[{number - 1}] is None:"
    yield f"                raise _failed(NOT_CONVERGED, {_failure(statement)}"
    yield from unpacked(rows, f"memory.inverses[{number - 1}]", 2)
    for change, row in zip(changes, rows, strict=True):
        terms = [f"{row}[{j}] * {residual}" for j, residual in enumerate(residuals)]
        yield from indented(f"{change} = ", (terms[0], *(f"+ {t}" for t in terms[1:])), 2)
    yield from (f"        {x} += {y}" for x, y in zip(now, changes, strict=True))
    yield from _decision(s, statement, [], [f"abs({c})" for c in changes], now, previous)
    yield f"        make_{number} = 0.0 < {Newton.CONTRACTION} * {previous} < change"
    yield f"        {previous} = change"


def _failure(statement: Iteration) -> str:
    return f"{quoted(statement.loop.label)}, {statement.number - 1}, sweep, statistics)"


def _finite(s: Statements, statement: Iteration, terms: list[str]) -> Iterator[str]:
    yield from indented("total = ", (terms[0], *(f"+ {x}" for x in terms[1:])), 2)
    yield "        if not isfinite(total):"
    yield f"            raise _failed(NOT_FINITE, {_failure(statement)}"


def _decision(
    s: Statements, statement: Iteration, finite: list[str], changes: list[str], now: list[str], previous: str
) -> Iterator[str]:
    """Yield the lines that end the loop: ``changes`` are absolute values, ``finite`` is yet to be checked."""
    loop, precision = statement.loop, s.precision
    close, tolerance = (precision.text(precision.scaled(x)) for x in (loop.close, loop.tolerance))
    unit = precision.text(precision.unit)
    yield from call("change = max", changes, 2)
    yield from call("scale = max", ["1.0", *(f"abs({x})" for x in now)], 2)
    yield from _finite(s, statement, finite) if finite else ()
    yield f"        still = 0.0 < {previous} <= change <= {tolerance} * scale"
    yield f"        close = change * change <= {unit} * scale * {previous}"
    yield f"        if still or (close and change <= {close} * scale):"
    yield "            break"
