"""Prints functions in C: types, declarations and statements.

The functions are given in the run representation (:mod:`codegen.run.language`). An array parameter is
``const`` if the function does not change the array.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import groupby

from codegen.ir.precision import Precision
from codegen.printers.c.packing import PACKED, packed, whole
from codegen.printers.c.terms import Terms, literal
from codegen.printers.c.text import block_comment, comment, fill, together
from codegen.printers.infix import closed
from codegen.run.batch import BATCH, complete
from codegen.run.batch import near as without_branches
from codegen.run.identifiers import Identifiers
from codegen.run.language import (
    Array,
    Assign,
    Body,
    Call,
    For,
    Function,
    If,
    Note,
    Return,
    Statement,
    Table,
    Unit,
    While,
    direct,
    statements,
)
from codegen.run.scope import declarations
from codegen.run.terms import Kind, Term, names
from codegen.run.writes import written
from codegen.snippets.graph import LIBRARY

MANY = 20
"""If more than ``MANY`` short statements follow each other, several statements are printed on each line."""

ONE_TEST = "If the sum of all x overflows, test each x: x - x is 0 only if x is finite."
"""A comment in the emitted code, above a test whether several numbers are all finite.

If the sum of the numbers is finite, all numbers are finite. However, a sum of finite numbers may overflow.
"""


class FunctionPrinter:
    """Writes the records, tables and functions of ``unit`` in C, with names that start with ``prefix``."""

    def __init__(
        self, unit: Unit, identifiers: dict[str, Identifiers], precision: Precision, prefix: str
    ) -> None:
        self.unit, self.identifiers, self.precision, self.prefix = unit, identifiers, precision, prefix
        self.real = precision.c_type
        # ``written`` searches all called functions, so its results are stored.
        self.writes = {f.name: written(unit, f) for f in unit.functions}
        self.packed = {f.name: packed(f, self.writes[f.name]) for f in unit.functions}
        self.batch = BATCH in unit.parts or any(f.near for f in unit.functions)

    def called(self, name: str, near: bool = False) -> str:
        """Return the name of a function in C.

        If ``near`` is true, return the name of the variant for arguments near zero
        (:func:`codegen.run.batch.near`).
        """
        name = self.forms(name, near)
        return name if name in LIBRARY else f"{self.prefix}{name}"

    def forms(self, name: str, near: bool = False) -> str:
        """Return the name, without prefix, of the C function that computes the function ``name``.

        If ``near`` is true, the C function has no branches and is valid only for arguments near zero.
        """
        # If a module has a loop over many systems, its other functions use the same polynomials for sines and
        # cosines as the loop. A system then has the same rounding errors inside and outside the loop.
        if not self.batch:
            return name
        return without_branches(name) if near else complete(name)

    def type_of(self, kind: Kind) -> str:
        """Return the C type of a scalar of the given kind."""
        # If counts and array indices had another type than size_t, -Wconversion would warn.
        return {Kind.REAL: self.real, Kind.WIDE: "double", Kind.COUNT: "size_t"}.get(kind, "int")

    def record_type(self, name: str) -> str:
        """Return the C type of the record with the given name."""
        return f"{'' if self.unit.record(name).public else 'struct '}{self.prefix}{name}"

    def parameter(self, function: Function, parameter: Term, header: bool) -> str:
        """Return the declaration of a parameter.

        If ``header`` is true, array sizes have no ``static``.
        """
        name = self.identifiers[function.name].of(parameter)
        # ``const`` shows callers which arrays a function does not change.
        const = "" if parameter.text in self.writes[function.name] else "const "
        # A function of the user is passed as two parameters: the function and a pointer to its data.
        if parameter.kind is Kind.SIGNAL:
            return f"{self.prefix}input input, void *context"
        if parameter.kind is Kind.EVENTS:
            return f"{self.prefix}event event, void *data"
        # In C, the declaration ``x[static n]`` promises that the array x has at least n entries. C++ has no
        # such declaration, so the header omits ``static`` for C++ programs.
        promised = "" if header else "static "
        if parameter.kind is Kind.RECORD:
            of = self.record_type(parameter.record)
            size = f"[{promised}{parameter.shape[0]}]" if parameter.shape else ""
            return f"{const}{of} {name}{size}" if size else f"{const}{of} *{name}"
        kind = self.type_of(parameter.kind)
        # A scalar is passed by value and needs no ``const``.
        if not parameter.shape:
            return f"{kind} {name}"
        # An optional array is declared as a pointer without a size, because the caller may pass NULL.
        if parameter.cell or parameter.optional or not parameter.shape[0]:
            return f"{const}{kind} *{name}"
        promised = "" if function.name == "jacobian" and parameter.text != "state" else promised
        promised = "" if parameter.text == "inputs" else promised
        return f"{const}{kind} {name}[{promised}{parameter.shape[0]}]"

    def head(self, function: Function, header: bool = False) -> list[str]:
        """Return the lines with the type, name and parameters of a function.

        If ``header`` is true, the lines are a prototype and end with a semicolon.
        """
        # All names start with the prefix of the module, so one C file can contain the code of two modules.
        storage = "" if function.public else "static inline " if function.often else "static "
        kind = "void" if function.returns is None else self.type_of(function.returns)
        # A function with many scalar parameters receives them in one array.
        together = self.packed[function.name]
        listed = [f"const {self.real} {PACKED}[static {len(together)}]"] if together else []
        listed += [self.parameter(function, p, header) for p in function.parameters if p not in together]
        # Each comma is part of the preceding segment, so no line begins with a comma.
        segments = (*(f"{p}," for p in listed[:-1]), f"{listed[-1]})")
        return fill(
            f"{storage}{kind} {self.called(function.name)}(", segments, ";" if header else "", separator=""
        )

    def definition(self, function: Function) -> list[str]:
        """Return the lines of a function, with its comment."""
        body = _Body(self, function).lines()
        return [
            *block_comment(function.about),
            *self.head(function),
            "{",
            *(f"    {line}" for line in body),
            "}",
        ]

    def table(self, table: Table) -> list[str]:
        """Return the lines of a constant array."""
        rows = [[literal(self.precision, x) for x in row] for row in table.rows]
        size = "".join(f"[{n}]" for n in table.name.shape)
        start = f"static const {self.real} {self.prefix}{table.name.text}{size} ="
        # With ``static const``, compilers can insert the entries into the code.
        about = [f"/* {comment(table.about)} */"]
        if len(table.name.shape) == 1:
            entries = [f"{x}," for x in rows[0][:-1]] + [rows[0][-1]]
            return [*about, *fill(start, closed("{", tuple(entries), "}"), ";")]
        # Each row is a nested initialiser on its own line.
        return [*about, f"{start} {{", *(f"    {{{_without_zeros(row)}}}," for row in rows), "};"]

    def record(self, name: str) -> list[str]:
        """Return the lines that define the type of a record."""
        record = self.unit.record(name)
        lines = block_comment(record.about)
        lines.append("typedef struct {" if record.public else f"{self.record_type(name)} {{")
        for field, about in record.fields:
            size = "".join(f"[{n}]" for n in field.shape)
            note = f" /* {comment(about)} */" if about else ""
            lines.append(f"    {self.type_of(field.kind)} {field.text}{size};{note}")
        return [*lines, f"}} {self.record_type(name)};" if record.public else "};"]


def _without_zeros(row: Sequence[str]) -> str:
    """Return the text of a row without zeros at the end, because C sets missing entries to zero."""
    # Zeros were appended to the shorter rows of a table, so all rows have the same length.
    kept = list(row)
    # The loop removes zeros at the end of the row. The first entry always stays, because C11 does not allow
    # an empty initialiser.
    while len(kept) > 1 and not float(kept[-1].removesuffix("f")):
        kept.pop()
    return ", ".join(kept)


class _Body:
    """Prints the body of one function."""

    def __init__(self, printer: FunctionPrinter, function: Function) -> None:
        self.printer, self.function = printer, function
        self.identifiers = printer.identifiers[function.name]
        self.declared = declarations(function, self.identifiers)
        # Records among the parameters are pointers, so their fields are accessed by ``->``.
        pointers = {p.text for p in function.parameters if p.kind is Kind.RECORD}
        tables = [table.name.text for table in printer.unit.tables]
        forms = partial(printer.forms, near=function.near)
        self.terms = Terms(self.identifiers, printer.precision, printer.prefix, pointers, tables, forms)
        self.pointers = pointers

    def lines(self) -> list[str]:
        """Return the lines of the body of the function."""
        whole = statements(self.function.body)
        # ``whole`` includes the statements inside loops and branches.
        read = {self.identifiers.variable(x) for s in whole for x in names(direct(s))}
        callbacks = (Kind.SIGNAL, Kind.EVENTS)
        parameters = [p for p in self.function.parameters if p.kind not in callbacks]
        # If the body does not read a parameter, a cast to void avoids a compiler warning.
        unread = [self.identifiers.of(p) for p in parameters if self.identifiers.of(p) not in read]
        signals = [p for p in self.function.parameters if p.kind is Kind.SIGNAL and p.text not in read]
        unread += ["input", "context"] if signals else []
        real, given = self.printer.real, self.printer.packed[self.function.name]
        # Parameters that are passed in one array are copied to local constants.
        loads = [f"const {real} {self.identifiers.of(p)} = {PACKED}[{k}];" for k, p in enumerate(given)]
        return [*loads, *(f"(void){name};" for name in unread), *self.block(self.function.body)]

    def block(self, body: Body) -> list[str]:
        """Return the lines of ``body``.

        If more than ``MANY`` short statements follow each other, one line can contain several of these
        statements.
        """
        groups: list[tuple[bool, list[str]]] = []
        for statement in body:
            before = self.before(statement)
            own = list(self.statement(statement))
            # Statements with sums do not share lines, because several sums on a line would be hard to read.
            short = isinstance(statement, Assign) and not before and len(own) == 1 and _is_short(own[0])
            # The declarations in ``before`` share no line with a statement.
            groups += [(False, before)] if before else []
            groups.append((short, own))
        lines: list[str] = []
        for short, group in groupby(groups, key=lambda x: x[0]):
            flat = [line for _, part in group for line in part]
            # Some kernels copy hundreds of scalars, so short statements share lines.
            lines += together(flat) if short and len(flat) > MANY else flat
        return lines

    def before(self, statement: Statement) -> list[str]:
        """Return the declarations that must be printed before ``statement``.

        Consecutive variables of one type share a declaration.
        """
        # For example, a variable that is assigned in a loop and read after the loop is declared before the
        # loop.
        waiting = self.declared.before.get(id(statement), [])
        lines: list[str] = []
        for kind, group in groupby(waiting, key=lambda x: self.printer.type_of(x[1].kind)):
            names = [name for name, _ in group]
            lines += fill(kind, (*(f"{n}," for n in names[:-1]), names[-1]), ";")
        return lines

    def statement(self, statement: Statement) -> Iterator[str]:
        """Yield the lines of a statement."""
        match statement:
            case Assign():
                yield from self.assign(statement)
            case Array():
                yield from self.array(statement)
            case Call():
                yield from self.call(statement)
            case Return(value):
                yield from fill("return", self.terms.text(value).segments, ";")
            case Note(text):
                yield f"/* {comment(text)} */"
            case If():
                yield from self.branch(statement)
            case While():
                yield from self.loop(statement)
            case For(index, count, body, reverse):
                yield from self.hints(statement)
                # ``size_t`` is unsigned, so a test ``i >= 0`` would always be true.
                i, n = self.identifiers.of(index), self.terms.line(count)
                yield (
                    f"for (size_t {i} = {n}; {i}-- > 0;) {{"
                    if reverse
                    else (f"for (size_t {i} = 0; {i} < {n}; {i}++) {{")
                )
                yield from self.inner(body)
                yield "}"

    def hints(self, loop: For) -> Iterator[str]:
        """Yield the directives that allow vector instructions and OpenMP threads in ``loop``."""
        # The macro INDEPENDENT allows gcc and clang to use vector instructions.
        if loop.independent:
            yield f"{self.printer.prefix.upper()}INDEPENDENT"
        if loop.parallel:
            clauses = []
            # For each operation, one OpenMP clause lists the variables that the operation reduces.
            for operation in dict.fromkeys(name for name, _ in loop.reductions):
                reduced = [self.identifiers.of(x) for name, x in loop.reductions if name == operation]
                clauses.append(f"reduction({operation}:{', '.join(reduced)})")
            # For a short loop, starting threads would take longer than the loop itself.
            if loop.when is not None:
                clauses.append(f"if({self.terms.line(loop.when)})")
            # A backslash continues a long directive on the next line.
            separator = " " if len(clauses) < 2 else " \\\n        "
            pragma = ["#pragma omp parallel for schedule(static)", *([" ".join(clauses)] if clauses else [])]
            # A compiler without OpenMP would warn about the unknown pragma under -Wall.
            yield from ("#ifdef _OPENMP", *separator.join(pragma).split("\n"), "#endif")

    def inner(self, body: Body) -> list[str]:
        """Return the indented lines of the body of a loop or branch."""
        return [f"    {line}" for line in self.block(body)]

    def branch(self, statement: If) -> Iterator[str]:
        """Yield the lines of a branch. An else part that is itself a branch is printed as ``else if``."""
        test = statement.test
        # ``finite`` is ``test`` without a leading ``not``.
        finite = test.args[0] if test.op == "not" else test
        if finite.op == "finite" and len(finite.args) > 1:
            yield f"/* {ONE_TEST} */"
        yield from fill("if (", self.terms.text(test).segments, ") {", separator="")
        yield from self.inner(statement.body)
        orelse = statement.orelse
        # ``else if`` leaves no place for declarations before the second ``if``.
        if len(orelse) == 1 and isinstance(orelse[0], If) and not self.declared.before.get(id(orelse[0])):
            # The inner ``if`` begins on the line of ``else``.
            first, *rest = self.branch(orelse[0])
            yield f"}} else {first}"
            yield from rest
            return
        if orelse:
            yield "} else {"
            yield from self.inner(orelse)
        yield "}"

    def loop(self, statement: While) -> Iterator[str]:
        """Yield the lines of a loop."""
        test = self.terms.text(statement.test).segments
        # A ``do`` loop evaluates the test after the body, so the body is executed at least once.
        if statement.at_least_once:
            yield "do {"
            yield from self.inner(statement.body)
            yield from fill("} while (", test, ");", separator="")
            return
        yield from fill("while (", test, ") {", separator="")
        yield from self.inner(statement.body)
        yield "}"

    def kind(self, statement: Statement, target: Term) -> str:
        """Return the C type of ``target`` if the statement declares ``target``, else an empty text.

        If ``target`` is assigned only once, the type starts with ``const``.
        """
        # An array is declared as a whole, so an assignment to one entry declares nothing.
        name = self.identifiers.of(target) if target.op == "name" else ""
        # The keys of ``declared.by`` are ids, because two statements may be equal.
        constant = self.declared.by.get(id(statement), {}).get(name)
        if constant is None:
            return ""
        return f"{'const ' if constant else ''}{self.printer.type_of(target.kind)} "

    def assign(self, statement: Assign) -> Iterator[str]:
        """Yield the lines that assign a scalar, copy an array or clear a record."""
        target, value = statement.target, statement.value
        if value.op == "fresh":
            name = self.terms.line(target)
            record = (
                f"{name}, 0, sizeof *{name}" if target.text in self.pointers else f"&{name}, 0, sizeof {name}"
            )
            # Integers and IEEE numbers are 0 if all their bytes are zero.
            yield f"memset({record});"
            return
        if target.shape:
            # ``memcpy`` is allowed, because the source and the target never overlap.
            copied = (self.terms.line(target), self.terms.line(value), self.extent(target, value))
            yield f"memcpy({', '.join(copied)});"
            return
        kind, name = self.kind(statement, target), self.terms.line(target)
        # ``x = x + y`` is printed as ``x += y``.
        changed = value.op in "+-*" and value.args and self.terms.line(value.args[0]) == name
        # C does not allow ``+=`` in a declaration.
        if changed and not kind:
            more = self.terms.text(value.args[1])
            # A real number 1 is printed as "1.0" or "1.0f", so "1" is always an integer.
            if value.op in "+-" and more.line == "1":
                # For the target ``*x``, ``(*x)++`` is printed, because ``*x++`` increments the pointer ``x``.
                yield f"({name}){value.op * 2};" if name.startswith("*") else f"{name}{value.op * 2};"
                return
            yield from fill(f"{name} {value.op}=", more.segments, ";")
            return
        yield from fill(f"{kind}{name} =", self.terms.text(value).segments, ";")

    def extent(self, target: Term, value: Term) -> str:
        """Return the number of bytes to copy, as an expression in C."""
        parameters = {p.text for p in self.function.parameters}
        # ``sizeof`` of an array parameter is only the size of a pointer.
        for term in (target, value):
            if term.op == "name" and term.text not in parameters:
                return f"sizeof {self.terms.line(term)}"
        named = next(
            (t for t in (value, target) if t.op in ("name", "field")), value.args[0] if value.args else value
        )
        return f"{target.shape[0]} * sizeof *{self.terms.line(named)}"

    def array(self, statement: Array) -> Iterator[str]:
        """Yield the lines of an array's declaration."""
        name = statement.name
        identifier = self.identifiers.of(name)
        size = "".join(f"[{n}]" for n in name.shape)
        # All fields of a new record are zero.
        if name.kind is Kind.RECORD:
            yield f"{self.printer.record_type(name.record)} {identifier}{size} = {{0}};"
            return
        kind = self.printer.type_of(name.kind)
        # In C the initialiser ``{0.0}`` sets all entries of an array to zero.
        if statement.zero:
            yield f"{kind} {identifier}{size} = {{{literal(self.printer.precision, 0.0)}}};"
            return
        # Without an initialiser the entries have arbitrary values until they are assigned.
        if not statement.values:
            yield f"{kind} {identifier}{size};"
            return
        entries = [self.terms.line(x) for x in statement.values]
        segments = closed("{", (*(f"{x}," for x in entries[:-1]), entries[-1]), "}")
        # An array that is declared with values is a constant.
        yield from fill(f"const {kind} {identifier}{size} =", segments, ";")

    def argument(self, term: Term) -> str:
        """Return the text of an argument. A record is passed by its address."""
        text = self.terms.line(term)
        # An array of records decays to a pointer, so the argument needs no operator ``&``.
        if term.kind is not Kind.RECORD or term.op == "none" or term.shape:
            return text
        # A record that is a parameter is already a pointer.
        return text if term.text in self.pointers and term.op == "name" else f"&{text}"

    def call(self, statement: Call) -> Iterator[str]:
        """Yield the lines of a call."""
        given = [self.argument(a) for a in statement.arguments]
        name, results = statement.function, statement.results
        if name == "measure":
            # The user function ``event`` fills the array ``results[0]``.
            given = [*given[1:], self.terms.line(results[0]), "data"]
            yield from fill("event(", _arguments(given), ";", separator="")
            return
        if name == "sample":
            # ``given[0]`` is the text "input, context": a user function and a pointer to its data. The
            # printed line calls ``input``, and the last argument is ``context``.
            given = [given[0].partition(",")[0], *given[1:], self.terms.line(results[0]), "context"]
            callee, *given = given
            yield from fill(f"{callee}(", _arguments(given), ";", separator="")
            return
        if len(results) > 1:
            # A C function returns one value, so several results are written through pointers.
            names = [self.identifiers.of(r) for r in results]
            given += [f"&{n}" for n in names]
            results = ()
        start = f"{self.printer.called(name, self.function.near)}("
        together = self.printer.packed.get(name)
        # A packed function returns no value, so its call needs no target.
        if together:
            yield from self.packed_call(start, name, given)
            return
        if results:
            (target,) = results
            # A single result is the return value of the C function.
            start = f"{self.kind(statement, target)}{self.terms.line(target)} = {start}"
        yield from fill(start, _arguments(given), ";", separator="")

    def packed_call(self, start: str, name: str, given: Sequence[str]) -> Iterator[str]:
        """Yield the lines of a call. The called function receives its scalars in one array."""
        together = self.printer.packed[name]
        parameters = next(f.parameters for f in self.printer.unit.functions if f.name == name)
        values = [x for p, x in zip(parameters, given, strict=False) if p in together]
        others = [x for p, x in zip(parameters, given, strict=False) if p not in together]
        # The last entries of ``given`` may be pointers to the results.
        others += given[len(parameters) :]
        # An existing array that begins with ``values`` is passed without a copy.
        array = whole(values, others)
        if array:
            yield from fill(start, _arguments([array, *others]), ";", separator="")
            return
        # The array exists only inside the braces, so the arrays of several calls can share stack memory.
        entries = closed("{", (*(f"{x}," for x in values[:-1]), values[-1]), "}")
        yield "{"
        yield from (f"    {x}" for x in fill(f"const {self.printer.real} {PACKED}[] =", entries, ";"))
        yield from (f"    {x}" for x in fill(start, _arguments([PACKED, *others]), ";", separator=""))
        yield "}"


def _arguments(given: Sequence[str]) -> tuple[str, ...]:
    return (*(f"{x}," for x in given[:-1]), f"{given[-1]})")


def _is_short(line: str) -> bool:
    """Return True if a statement assigns one name or number to a variable, as in ``a = b;``."""
    return len(line.split()) == 3 and line.endswith(";")
