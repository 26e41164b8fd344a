"""Loops in C: where unknowns begin, sweeps, the change of the unknowns, and when it ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from codegen.ir.kernel import Newton
from codegen.printers.arrange import Beginning, Iteration
from codegen.printers.c.text import broken, comment, fill, greatest

if TYPE_CHECKING:
    from codegen.printers.c.statements import Statements


def beginning(s: Statements, statement: Beginning) -> Iterator[str]:
    """Yield the lines that give the unknowns of all loops their first values."""
    unknowns = [s.names.spelled[u] for u in statement.start.unknowns]
    yield from fill(s.real, (*(f"{u}," for u in unknowns[:-1]), unknowns[-1]), ";")
    yield "if (memory->known > 0) {"
    for place, unknown in enumerate(unknowns):
        yield f"    {unknown} = extrapolated(memory, {place});"
    yield "} else {"
    for inner in statement.body:
        yield from (f"    {line}" for line in s.simple(inner))
    for unknown, value in zip(unknowns, statement.values, strict=True):
        yield from (f"    {line}" for line in s.declare(unknown, value, ""))
    yield "}"


def iteration(s: Statements, statement: Iteration) -> Iterator[str]:
    """Yield the lines of one loop."""
    loop, number = statement.loop, statement.number
    now = [s.names.spelled[u] for u in loop.unknowns]
    previous = s.names.fresh(f"previous_{number}")
    how = "fixed point" if loop.newton is None else "Newton's method"
    yield f"/* {comment(loop.label)}: {how} in {', '.join(now)} */"
    for name, start in zip(now, statement.starts, strict=False):  # none where they begin together
        yield from s.declare(name, start, f"{s.real} ")
    if statement.kept:
        kept = [s.names.spelled[n] for n in statement.kept]
        yield from fill(s.real, (*(f"{n}," for n in kept[:-1]), kept[-1]), ";")
    yield f"{s.real} {previous} = {s.literal(0.0)};"
    if loop.newton is not None:
        yield f"int {_fresh(number)} = !memory->made_{number};"
    yield "for (size_t sweep = 1;; sweep++) {"
    yield from (f"    {line}" for line in _sweep(s, statement, now, previous))
    yield "}"


def _fresh(number: int) -> str:
    return f"make_{number}"


def _sweep(s: Statements, statement: Iteration, now: list[str], previous: str) -> Iterator[str]:
    loop = statement.loop
    for inner in statement.body:
        yield from s.simple(inner, statement.kept)
    plain = [x.op == "sym" and x.payload not in loop.unknowns for x in statement.images]
    new = [
        s.names.spelled[x.payload] if already else s.names.fresh(f"next_{u}")
        for u, x, already in zip(loop.unknowns, statement.images, plain, strict=True)
    ]
    for name, image, already in zip(new, statement.images, plain, strict=True):
        yield from [] if already else s.declare(name, image)
    absolute = s.style.function("fabs")
    changes = [s.names.fresh(f"change_{u}") for u in loop.unknowns]
    if loop.newton is None:
        for change, x, y in zip(changes, new, now, strict=True):
            yield f"const {s.real} {change} = {absolute}({x} - {y});"
        yield from _decision(s, statement, changes, changes, now, previous)
        yield f"{previous} = change;"
        yield from (f"{x} = {y};" for x, y in zip(now, new, strict=True))
        return
    residuals = [s.names.fresh(f"residual_{u}") for u in loop.unknowns]
    for residual, x, y in zip(residuals, new, now, strict=True):
        yield f"const {s.real} {residual} = {x} - {y};"
    yield from _not_finite(s, statement, residuals)
    yield from _matrix(s, statement)
    n, inverse = len(now), f"memory->inverse_{statement.number}"
    for row, change in enumerate(changes):
        terms = [f"{inverse}[{row * n + column}] * {r}" for column, r in enumerate(residuals)]
        yield from fill(f"const {s.real} {change} =", (terms[0], *(f"+ {t}" for t in terms[1:])), ";")
    sizes = [f"{absolute}({change})" for change in changes]
    yield from _decision(s, statement, [], sizes, now, previous, tuple(zip(now, changes, strict=True)))
    limit = f"{s.literal(Newton.CONTRACTION)} * {previous}"
    yield f"{_fresh(statement.number)} = {limit} > {s.literal(0.0)} && change > {limit};"
    yield f"{previous} = change;"


def _matrix(s: Statements, statement: Iteration) -> Iterator[str]:
    """Yield the lines that make and invert the matrix where that is due."""
    number, n = statement.number, len(statement.loop.unknowns)
    inverse, order = f"memory->inverse_{number}", s.names.fresh(f"order_{number}")
    yield f"if ({_fresh(number)}) {{"
    for inner in statement.newton:
        yield from (f"    {line}" for line in s.simple(inner))
    for place, entry in enumerate(statement.matrix):
        yield from (f"    {line}" for line in s.declare(f"{inverse}[{place}]", entry, ""))
    yield f"    size_t {order}[{n}];"
    yield f"    memory->made_{number} = invert({n}, {inverse}, {order});"
    yield "    count_matrix(statistics);"
    yield f"    if (!memory->made_{number}) {{"
    yield f"        count_sweeps(statistics, {number - 1}, sweep, 1);"
    yield f"        return {s.prefix.upper()}NOT_CONVERGED;"
    yield "    }"
    yield "}"


def _not_finite(s: Statements, statement: Iteration, terms: list[str]) -> Iterator[str]:
    yield from fill("if (!isfinite(", (terms[0], *(f"+ {x}" for x in terms[1:])), ")) {", joint="")
    yield f"    count_sweeps(statistics, {statement.number - 1}, sweep, 1);"
    yield f"    return {s.prefix.upper()}NOT_FINITE;"
    yield "}"


def _decision(
    s: Statements,
    statement: Iteration,
    finite: list[str],
    changes: list[str],
    now: list[str],
    previous: str,
    corrections: Sequence[tuple[str, str]] = (),
) -> Iterator[str]:
    """Yield the lines that end the loop.

    ``changes`` are absolute values, ``finite`` is yet to be checked, ``corrections`` are unknowns with what
    is added to them whether or not the loop ends.
    """
    loop, block = statement.loop, statement.number - 1
    scaled = s.precision.scaled
    close, tolerance = (s.literal(scaled(x)) for x in (loop.close, loop.tolerance))
    unit = s.literal(s.precision.unit)
    yield from fill(f"const {s.real} change =", broken(greatest(changes)), ";")
    sizes = [s.literal(1.0), *(f"{s.style.function('fabs')}({x})" for x in now)]
    yield from fill(f"const {s.real} scale =", broken(greatest(sizes)), ";")
    yield from _not_finite(s, statement, finite) if finite else ()
    yield f"const int still = {previous} > {s.literal(0.0)} && change >= {previous};"
    yield from fill(
        "const int close =",
        (f"change <= {close} * scale", f"&& change * change <= {unit} * scale * {previous}"),
        ";",
    )
    yield from (f"{x} += {y};" for x, y in corrections)
    yield f"if (close || (still && change <= {tolerance} * scale)) {{"
    yield f"    count_sweeps(statistics, {block}, sweep, 0);"
    yield "    break;"
    yield "}"
    yield f"if (sweep == {loop.limit}) {{"
    yield f"    count_sweeps(statistics, {block}, sweep, 1);"
    yield f"    return {s.prefix.upper()}NOT_CONVERGED;"
    yield "}"
