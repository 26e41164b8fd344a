"""Loops in C: where unknowns begin, sweeps, the change of the unknowns, and when it ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from codegen.ir.kernel import CHORD, LOST, NEWTON, SLOWEST, VARIED, Loop, Newton
from codegen.kernel.schedule import METHODS, Assignment, Beginning, Iteration
from codegen.printers.c.text import broken, comment, fill, greatest, paired, together
from codegen.printers.expression import spell
from codegen.printers.identifiers import WIDE, WIDEST

if TYPE_CHECKING:
    from codegen.printers.c.statements import Statements


LEAST_RATE = 2.0**-13
"""No rate is trusted to be smaller: what is corrected after the last sweep has errors of that kind too."""


def beginning(s: Statements, statement: Beginning) -> Iterator[str]:
    """Yield the lines that give the unknowns of all loops their first values."""
    unknowns = [s.names.spelled[u] for u in statement.start.unknowns]
    yield from fill(s.real, (*(f"{u}," for u in unknowns[:-1]), unknowns[-1]), ";")
    joined = together if len(unknowns) > WIDEST else list
    yield "if (memory->known > 0) {"
    loads = [f"{unknown} = memory->guess[{place}];" for place, unknown in enumerate(unknowns)]
    yield from (f"    {line}" for line in joined(loads))
    yield "} else {"
    for inner in statement.body:
        yield from (f"    {line}" for line in s.simple(inner))
    values = [
        line
        for unknown, value in zip(unknowns, statement.values, strict=True)
        for line in s.declare(unknown, value, "")
    ]
    yield from (f"    {line}" for line in (joined(values) if _short(values) else values))
    yield "}"


def _short(statements: Sequence[str]) -> bool:
    """Whether each line is a statement."""
    return all(line.endswith(";") and not line.startswith(" ") for line in statements)


def iteration(s: Statements, statement: Iteration) -> Iterator[str]:
    """Yield the lines of one loop."""
    loop, number = statement.loop, statement.number
    now = [s.names.spelled[u] for u in loop.unknowns]
    previous = s.names.fresh(f"previous_{number}")
    yield f"/* {comment(loop.label)}: {METHODS[loop.solver]} in {', '.join(now)} */"
    for name, start in zip(now, statement.starts, strict=False):  # none where they begin together
        yield from s.declare(name, start, f"{s.real} ")
    own = loop.newton.changes if loop.newton is not None else ()
    if statement.kept or own:
        kept = [s.names.spelled[n] for n in (*statement.kept, *own)]
        yield from fill(s.real, (*(f"{n}," for n in kept[:-1]), kept[-1]), ";")
    yield f"{s.real} {previous} = {s.literal(0.0)};"
    if not statement.starts:
        yield f"{s.real} rate_{number} = memory->known > 0 ? memory->rate_{number} : {s.literal(1.0)};"
    if loop.solver == NEWTON:
        yield f"int {_fresh(number)} = !memory->made_{number};"
    if loop.solver == CHORD:
        yield from _matrix(s, statement)
    yield "for (size_t sweep = 1;; sweep++) {"
    yield from (f"    {line}" for line in _sweep(s, statement, now, previous))
    yield "}"


def compares(loop: Loop) -> bool:
    """Whether the lines of a loop call ``greater``: of several changes, or of rates from step to step."""
    if loop.newton is not None and loop.newton.residuals:
        return False
    return len(loop.unknowns) > 1 or not loop.starts


def _fresh(number: int) -> str:
    return f"make_{number}"


def _sweep(s: Statements, statement: Iteration, now: list[str], previous: str) -> Iterator[str]:
    loop = statement.loop
    yield from _body(s, statement)
    plain = [x.op == "sym" and x.payload not in loop.unknowns for x in statement.images]
    new = [
        s.names.spelled[x.payload] if already else s.names.fresh(f"next_{u}")
        for u, x, already in zip(loop.unknowns, statement.images, plain, strict=True)
    ]
    for name, image, already in zip(new, statement.images, plain, strict=True):
        yield from [] if already else s.declare(name, image)
    absolute = s.style.function("fabs")
    compared = loop.newton is not None and loop.newton.residuals
    changes = [s.names.fresh(f"change_{u}") for u in loop.unknowns]
    if loop.newton is not None and compared:
        changes = [s.names.spelled[c] for c in loop.newton.changes]
    if loop.newton is None and len(now) > WIDEST:
        largest, total = (s.names.fresh(f"{word}_{statement.number}") for word in ("largest", "total"))
        yield from _compared(s, statement, now, new, largest, total)
        yield from _decision(s, statement, [total], [largest], now, previous)
        yield f"{previous} = change;"
        yield from together([f"{x} = {y};" for x, y in zip(now, new, strict=True)])
        return
    if loop.newton is None:
        joined = together if _many(s) else list
        pairs = zip(changes, new, now, strict=True)
        yield from joined([f"const {s.real} {change} = {absolute}({x} - {y});" for change, x, y in pairs])
        yield from _decision(s, statement, changes, changes, now, previous)
        yield f"{previous} = change;"
        yield from joined([f"{x} = {y};" for x, y in zip(now, new, strict=True)])
        return
    residuals = new if compared else [s.names.fresh(f"residual_{u}") for u in loop.unknowns]
    for residual, x, y in zip(residuals, new, now, strict=True):
        yield from [] if compared else [f"const {s.real} {residual} = {x} - {y};"]
    yield from [] if compared else _not_finite(s, statement, residuals)
    if loop.solver == NEWTON:
        yield f"if ({_fresh(statement.number)}) {{"
        yield from (f"    {line}" for line in _matrix(s, statement))
        yield "    count_matrix(statistics);"
        yield "}"
    yield from _product(s, statement, changes, residuals, "" if compared else f"const {s.real} ")
    sizes = [f"{absolute}({change})" for change in changes]
    if compared:
        yield from _end(s, statement, changes, now, previous)
        return
    yield from _decision(s, statement, [], sizes, now, previous, tuple(zip(now, changes, strict=True)))
    if loop.solver == NEWTON:
        limit = f"{s.literal(Newton.CONTRACTION)} * {previous}"
        yield f"{_fresh(statement.number)} = {limit} > {s.literal(0.0)} && change > {limit};"
    yield f"{previous} = change;"


def _many(s: Statements) -> bool:
    """Whether the loops of a step have so many unknowns that short statements share lines."""
    loops = (x.loop for x in s.arrangement.statements if isinstance(x, Iteration))
    return sum(len(loop.unknowns) for loop in loops) > WIDEST


def _body(s: Statements, statement: Iteration) -> Iterator[str]:
    """Yield the lines of what a sweep computes before its images."""
    many, copies = _many(s), list[str]()
    for inner in statement.body:
        lines = list(s.simple(inner, statement.kept))
        if many and isinstance(inner, Assignment) and inner.value.op == "sym" and len(lines) == 1:
            copies += lines
            continue
        yield from together(copies)
        copies = []
        yield from lines
    yield from together(copies)


def _compared(
    s: Statements, statement: Iteration, now: list[str], new: list[str], largest: str, total: str
) -> Iterator[str]:
    """Yield the lines that find the largest of many changes, and their sum, which is finite if they are."""
    n = len(now)
    before, after = (s.names.fresh(f"{word}_{statement.number}") for word in ("unknowns", "images"))
    yield from array(f"const {s.real} {before}[{n}] =", now)
    yield from array(f"const {s.real} {after}[{n}] =", new)
    yield f"{s.real} {largest} = {s.literal(0.0)}, {total} = {s.literal(0.0)};"
    yield f"for (size_t i = 0; i < {n}; i++) {{"
    yield f"    const {s.real} moved = {s.style.function('fabs')}({after}[i] - {before}[i]);"
    yield f"    {largest} = greater({largest}, moved);"
    yield f"    {total} += moved;"
    yield "}"


def _product(
    s: Statements, statement: Iteration, changes: list[str], residuals: list[str], kind: str
) -> Iterator[str]:
    """Yield the lines of changes = inverse residuals: a sum for each row, or loops where there are many."""
    n = len(changes)
    if n <= WIDE:
        for row, change in enumerate(changes):
            terms = [f"{_cell(statement, row * n + column)} * {r}" for column, r in enumerate(residuals)]
            yield from fill(f"{kind}{change} =", paired(terms), ";")
        return
    right, left = (s.names.fresh(f"{word}_{statement.number}") for word in ("residuals", "changes"))
    inverse = _cell(statement, 0).removesuffix("[0]")
    yield from array(f"const {s.real} {right}[{n}] =", residuals)
    yield f"{s.real} {left}[{n}];"
    yield f"for (size_t i = 0; i < {n}; i++) {{"
    yield f"    {s.real} sum = {s.literal(0.0)};"
    yield f"    for (size_t j = 0; j < {n}; j++) {{"
    yield f"        sum += {inverse}[{n} * i + j] * {right}[j];"
    yield "    }"
    yield f"    {left}[i] = sum;"
    yield "}"
    yield from (f"{kind}{change} = {left}[{row}];" for row, change in enumerate(changes))


def array(start: str, entries: list[str]) -> list[str]:
    """Return the lines that give an array its entries."""
    pieces = [f"{x}," for x in entries[:-1]]
    return fill(start, ("{" + pieces[0], *pieces[1:], f"{entries[-1]}}}"), ";")


def _cell(statement: Iteration, place: int) -> str:
    """Spell an entry of the inverse, by rows."""
    newton = statement.loop.newton
    if newton is not None and newton.leading and newton.inverted:
        return f"inverse_{statement.number}_{place}"
    kept = "" if newton is not None and newton.leading else "memory->"
    return f"{kept}inverse_{statement.number}[{place}]"


def _matrix(s: Statements, statement: Iteration) -> Iterator[str]:
    """Yield the lines that make and invert the matrix."""
    number, n, newton = statement.number, len(statement.loop.unknowns), statement.loop.newton
    assert newton is not None
    for inner in statement.newton:
        yield from s.simple(inner)
    names = newton.leading and newton.inverted
    if newton.leading and not names:
        yield f"{s.real} inverse_{number}[{n * n}];"
    if n > WIDE:
        matrix, target = s.names.fresh(f"matrix_{number}"), _cell(statement, 0).removesuffix("[0]")
        entries = [" ".join(spell(x, s.names.spelled, s.style)) for x in statement.matrix]
        yield from array(f"const {s.real} {matrix}[{n * n}] =", entries)
        yield f"memcpy({target}, {matrix}, sizeof {matrix});"
    else:
        for place, entry in enumerate(statement.matrix):
            yield from s.declare(_cell(statement, place), entry, None if names else "")
    if newton.inverted:
        yield from [] if newton.leading else [f"memory->made_{number} = 1;"]
        return
    inverse, order = _cell(statement, 0).removesuffix("[0]"), s.names.fresh(f"order_{number}")
    row = s.names.fresh(f"row_{number}")
    yield f"{s.real} {row}[{n}];"
    yield f"size_t {order}[{n}];"
    if newton.leading:
        yield f"if (!invert({n}, {inverse}, {row}, {order})) {{"
    else:
        yield f"memory->made_{number} = invert({n}, {inverse}, {row}, {order});"
        yield f"if (!memory->made_{number}) {{"
    yield f"    count_sweeps(statistics, {number - 1}, {'0' if newton.leading else 'sweep'}, 1);"
    yield f"    return {s.prefix.upper()}NOT_CONVERGED;"
    yield "}"


def _not_finite(s: Statements, statement: Iteration, terms: list[str]) -> Iterator[str]:
    yield from fill("if (!isfinite(", (terms[0], *(f"+ {x}" for x in terms[1:])), ")) {", joint="")
    yield f"    count_sweeps(statistics, {statement.number - 1}, sweep, 1);"
    yield f"    return {s.prefix.upper()}NOT_FINITE;"
    yield "}"


def _end(
    s: Statements, statement: Iteration, changes: list[str], now: list[str], previous: str
) -> Iterator[str]:
    """Yield the lines that correct the unknowns and end the comparison of momenta.

    It ends where the next change would be below four roundings of the sum of the unknowns, by the rate of the
    last two: that of the step before in the first sweep. What stands still at rounding, of the unknowns or of
    the state, ends it, too.
    """
    number, absolute, limit = statement.number, s.style.function("fabs"), statement.loop.limit
    rate, zero = f"rate_{number}", s.literal(0.0)
    close, still = (s.literal(s.precision.scaled(x)) for x in (2.0**-50, statement.loop.tolerance))
    yield from fill(f"const {s.real} change =", paired([f"{absolute}({x})" for x in changes]), ";")
    yield from _not_finite(s, statement, ["change"])
    yield from fill(f"const {s.real} scale =", paired([f"{absolute}({x})" for x in now]), ";")
    yield from (f"{x} += {y};" for x, y in zip(now, changes, strict=True))
    yield f"if ({previous} > {zero}) {{"
    yield f"    {rate} = change / {previous};"
    yield "} else {"
    yield "    memory->first += change;"
    yield "}"
    yield f"const int contracts = {rate} < {s.literal(0.5)};"
    yield f"if (contracts ? change * ({rate} + {s.literal(LEAST_RATE)}) <= {close} * scale"
    yield f"              : sweep > 1 && (change <= {still} * scale"
    yield from _alternative(_lost(s, statement.loop), "                  ", "))")
    yield f"    memory->{rate} = {rate};"
    yield f"    count_sweeps(statistics, {number - 1}, sweep, 0);"
    yield "    break;"
    yield "}"
    yield f"if (sweep == {limit}) {{"
    yield f"    count_sweeps(statistics, {number - 1}, sweep, 1);"
    yield f"    return {s.prefix.upper()}NOT_CONVERGED;"
    yield "}"
    yield f"{_fresh(number)} = 0;"
    yield f"{previous} = change;"


def _lost(s: Statements, loop: Loop) -> list[str]:
    """Spell the tests whether a change of the unknowns is lost in the state, or in the variation of it."""
    varied, bound = loop.label.startswith(VARIED), s.literal(s.precision.scaled(LOST))
    moved = f"change * {s.style.function('fabs')}(h)"
    return [
        f"{moved} <= {bound} * largest({name}{f' + {start}' if start else ''}, {size})"
        for name, start, size in s.blocks
        if varied == (name == "vector")
    ]


def _alternative(tests: list[str], indent: str, end: str) -> Iterator[str]:
    """Yield the lines of "or all tests", the last of a condition that ``end`` closes."""
    opened, closed = ("(", ")") if len(tests) > 1 else ("", "")
    for k, test in enumerate(tests):
        start = f"|| {opened}" if k == 0 else "    && "
        yield f"{indent}{start}{test}" + (f"{closed}{end} {{" if k == len(tests) - 1 else "")


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
    sizes = [f"{s.style.function('fabs')}({x})" for x in now]
    yield from fill(f"const {s.real} scale =", broken(greatest(sizes)), ";")
    yield from _not_finite(s, statement, finite) if finite else ()
    yield f"const int still = {previous} > {s.literal(0.0)} && change >= {previous};"
    small = f"change * change <= {unit} * scale * {previous}"
    if not statement.starts:
        rate = f"rate_{statement.number}"
        yield "if (sweep == 1) {"
        yield "    memory->first = greater(memory->first, change);"
        yield "}"
        yield f"if ({previous} > {s.literal(0.0)}) {{"
        yield f"    {rate} = greater(change / {previous}, {s.literal(SLOWEST)});"
        yield "}"
        small = f"change * {rate} <= {unit} * scale"
    yield from fill("const int close =", (f"change <= {close} * scale", f"&& {small}"), ";")
    yield from (f"{x} += {y};" for x, y in corrections)
    yield f"if (close || (still && (change <= {tolerance} * scale"
    yield from _alternative(_lost(s, loop), "    ", ")))")
    yield f"    count_sweeps(statistics, {block}, sweep, 0);"
    if not statement.starts:
        rate = f"rate_{statement.number}"
        yield f"    memory->{rate} = sweep > 1 ? {rate} : {s.literal(2.0)} * {rate};"
    yield "    break;"
    yield "}"
    diverging = f" || (still && {_fresh(statement.number)})" if loop.solver == NEWTON else ""
    yield f"if (sweep == {loop.limit}{diverging}) {{"
    yield f"    count_sweeps(statistics, {block}, sweep, 1);"
    yield f"    return {s.prefix.upper()}NOT_CONVERGED;"
    yield "}"
