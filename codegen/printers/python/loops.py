"""Loops in Python: where unknowns begin, and ``for ... else`` for the sweeps."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from codegen.ir.kernel import CHORD, LOST, NEWTON, SLOWEST, VARIED, Newton
from codegen.kernel.schedule import METHODS, Beginning, Iteration
from codegen.printers.identifiers import WIDE, WIDEST
from codegen.printers.python.text import WIDTH, call, filled, indented, quoted

if TYPE_CHECKING:
    from codegen.printers.python.statements import Statements


def beginning(s: Statements, statement: Beginning) -> Iterator[str]:
    """Yield the lines that give the unknowns of all loops their first values."""
    unknowns = [s.names.spelled[u] for u in statement.start.unknowns]
    yield "    if memory.past:"
    yield from unpacked(unknowns, "memory.guess", 2)
    yield "    else:"
    for inner in statement.body:
        yield from s.simple(inner, 2)
    pairs = list(zip(unknowns, statement.values, strict=True))
    if len(unknowns) > WIDEST:
        copied = [k for k, (_, value) in enumerate(pairs) if value.op == "sym"]
        first = s.names.fresh("first")
        if copied:
            yield from filled(f"{first} = [", [s.names.spelled[pairs[k][1].payload] for k in copied], "]", 2)
            yield from unpacked([unknowns[k] for k in copied], first, 2)
        pairs = [pair for k, pair in enumerate(pairs) if k not in copied]
    for unknown, value in pairs:
        yield from s.assign(unknown, value, 2)


def unpacked(names: list[str], value: str, depth: int) -> list[str]:
    """Return the lines that give the parts of a sequence their names."""
    space, comma = "    " * depth, "," if len(names) == 1 else ""
    line = f"{space}{', '.join(names)}{comma} = {value}"
    if len(line) <= WIDTH:
        return [line]
    return filled("(", names, f") = {value}", depth)


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
    yield from indented("# ", (f"{loop.label}: {METHODS[loop.solver]} in {', '.join(now)}",), 1)
    for name, start in zip(now, statement.starts, strict=False):  # none where they begin together
        yield from s.assign(name, start, 1)
    yield f"    {previous} = 0.0"
    if not statement.starts:
        yield f"    rate_{number} = memory.rates[{number - 1}] if memory.past else 1.0"
    rows = [s.names.fresh(f"row_{number}_{i + 1}") for i in range(len(now))]
    if loop.solver == CHORD:
        yield from _matrix(s, statement, rows, 1)
    if loop.solver == NEWTON:
        yield f"    make_{number} = memory.inverses[{number - 1}] is None"
    yield f"    for sweep in range(1, {loop.limit + 1}):"
    for inner in statement.body:
        yield from s.simple(inner, 2)
    for name, image, already in zip(new, statement.images, plain, strict=True):
        yield from [] if already else s.assign(name, image, 2)
    changes = [s.names.fresh(f"change_{u}") for u in loop.unknowns]
    if loop.newton is not None and loop.newton.residuals:
        changes = [s.names.spelled[c] for c in loop.newton.changes]
    if loop.newton is None and len(now) > WIDEST:
        before, after, moved = (s.names.fresh(f"{x}_{number}") for x in ("unknowns", "images", "changes"))
        yield from filled(f"{before} = [", now, "]", 2)
        yield from filled(f"{after} = [", new, "]", 2)
        yield f"        {moved} = [abs(x - y) for x, y in zip({after}, {before})]"
        yield from _decision(s, statement, [f"sum({moved})"], [f"*{moved}", "0.0"], now, previous)
        yield f"        {previous} = change"
        yield from unpacked(now, after, 2)
    elif loop.newton is None:
        for change, x, y in zip(changes, new, now, strict=True):
            yield f"        {change} = abs({x} - {y})"
        yield from _decision(s, statement, changes, changes, now, previous)
        yield f"        {previous} = change"
        yield from (f"        {x} = {y}" for x, y in zip(now, new, strict=True))
    else:
        yield from _newton(s, statement, changes, now, new, previous, rows)
    yield "    else:"
    yield f"        raise _failed(NOT_CONVERGED, {_failure(statement)}"
    yield "    if statistics is not None:"
    yield f"        statistics.count({number - 1}, sweep)"


def _newton(
    s: Statements,
    statement: Iteration,
    changes: list[str],
    now: list[str],
    new: list[str],
    previous: str,
    rows: list[str],
) -> Iterator[str]:
    """Yield the lines that correct the unknowns by the inverse of Newton's matrix."""
    number, kept = statement.number, statement.loop.solver == NEWTON
    newton = statement.loop.newton
    compared = newton is not None and newton.residuals
    residuals = new if compared else [s.names.fresh(f"residual_{u}") for u in statement.loop.unknowns]
    for residual, x, y in zip(residuals, new, now, strict=True):
        yield from [] if compared else [f"        {residual} = {x} - {y}"]
    yield from _finite(s, statement, residuals)
    if kept:
        yield f"        if make_{number}:"
        yield from _matrix(s, statement, rows, 3)
        if len(rows) <= WIDE:
            yield from unpacked(rows, f"memory.inverses[{number - 1}]", 2)
    if len(rows) <= WIDE:
        for change, row in zip(changes, rows, strict=True):
            terms = [f"{row}[{j}] * {residual}" for j, residual in enumerate(residuals)]
            yield from indented(f"{change} = ", (terms[0], *(f"+ {t}" for t in terms[1:])), 2)
    else:
        yield from filled("right = [", residuals, "]", 2)
        inverse = f"memory.inverses[{number - 1}]" if kept else f"inverse_{number}"
        yield f"        left = [sum(x * y for x, y in zip(row, right)) for row in {inverse}]"
        yield from filled("(", changes, ") = left", 2)
    yield from (f"        {x} += {y}" for x, y in zip(now, changes, strict=True))
    yield from _decision(s, statement, [], [f"abs({c})" for c in changes], now, previous)
    if kept:
        if not compared:
            yield f"        if make_{number} and 0.0 < {previous} <= change:  # it goes astray"
            yield f"            raise _failed(NOT_CONVERGED, {_failure(statement)}"
        least = 0.25 if compared else Newton.CONTRACTION
        yield f"        make_{number} = 0.0 < {least} * {previous} < change"
    yield f"        {previous} = change"


def _matrix(s: Statements, statement: Iteration, rows: list[str], depth: int) -> Iterator[str]:
    """Yield the lines that make and invert the matrix, by rows."""
    number, n, newton = statement.number, len(rows), statement.loop.newton
    assert newton is not None
    space = "    " * depth
    for inner in statement.newton:
        yield from s.simple(inner, depth)
    for i, row in enumerate(rows):
        yield from s.listing(row, statement.matrix[i * n : i * n + n], depth)
    listed = f"[{', '.join(rows)}]"
    made = listed if newton.inverted else f"invert({listed})"
    if newton.leading and newton.inverted:
        return
    place = f"inverse_{number}" if newton.leading else f"memory.inverses[{number - 1}]"
    yield f"{space}{place} = {made}"
    if not newton.leading:
        yield f"{space}if statistics is not None:"
        yield f"{space}    statistics.matrices += 1"
    if not newton.inverted:
        sweep = "0" if newton.leading else "sweep"
        yield f"{space}if {place} is None:"
        yield f"{space}    raise _failed(NOT_CONVERGED, {_failure(statement).replace('sweep', sweep)}"
    if newton.leading and n <= WIDE:
        yield from unpacked(rows, place, depth)


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
    sizes = [f"abs({x})" for x in now]
    yield from call("scale = max", ["0.0", *sizes], 2)
    yield from _finite(s, statement, finite) if finite else ()
    varied, bound = loop.label.startswith(VARIED), precision.text(precision.scaled(LOST))
    lost = [
        f"max(map(abs, {name}[{start}:{start + size}]))"
        for name, start, size in s.blocks
        if varied == (name == "vector")
    ]
    felt = f"{bound} * " + (f"min({', '.join(lost)})" if len(lost) > 1 else lost[0])
    yield f"        still = 0.0 < {previous} <= change and ("
    yield f"            change <= {tolerance} * scale"
    yield f"            or change * abs(h) <= {felt}"
    yield "        )"
    small = f"change * change <= {unit} * scale * {previous}"
    if not statement.starts:
        rate = f"rate_{statement.number}"
        yield "        if sweep == 1:"
        yield "            memory.first = max(memory.first, change)"
        yield f"        if {previous} > 0.0:"
        yield f"            {rate} = max(change / {previous}, {SLOWEST})"
        small = f"change * {rate} <= {unit} * scale"
    yield f"        close = {small}"
    yield f"        if still or (close and change <= {close} * scale):"
    if not statement.starts:
        yield f"            memory.rates[{statement.number - 1}] = {rate} if sweep > 1 else 2.0 * {rate}"
    yield "            break"
