"""Prints functions (:mod:`codegen.run.language`) in Python.

The printed functions change lists in place.

Python raises an arithmetic error where C computes an infinity or a NaN. A guard is a ``try`` statement that
catches this error in a printed function. After an error, the result of the function is a status code or NaNs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import prod

from codegen.printers.python.terms import Constants, Terms
from codegen.printers.python.text import filled, indented, listed, unpacked
from codegen.run.identifiers import Identifiers
from codegen.run.language import (
    RAISES_STATUS,
    Array,
    Assign,
    Body,
    Call,
    For,
    Function,
    If,
    Note,
    Record,
    Return,
    Statement,
    Table,
    Unit,
    While,
    root,
)
from codegen.run.terms import Kind, Term, names
from codegen.run.writes import written

TOGETHER = 3
"""The smallest number of assignments that the printer combines into one statement."""


class FunctionPrinter:
    """Prints functions as Python code. ``unit`` contains all records, tables and functions of the module."""

    def __init__(self, unit: Unit, identifiers: dict[str, Identifiers], constants: Constants) -> None:
        self.unit, self.identifiers, self.constants = unit, identifiers, constants

    def definition(self, function: Function) -> list[str]:
        """Return the lines of a function."""
        own = self.identifiers[function.name]
        # The name gets a leading underscore, because all functions printed here are private in Python. The
        # template of the module contains the public functions.
        head = filled(f"def _{function.name}(", [own.of(p) for p in function.parameters], "):", 0)
        # Triple quotes in the text would end the docstring. A backslash would start an escape sequence.
        about = function.about.replace("\\", "\\\\").replace('"""', "'''")
        lines = [*head, *docstring(about)] if about else head
        printed = _Body(self, function)
        if not function.guard:
            return [*lines, *printed.block(function.body, 1)]
        # A guard is a ``try`` statement. The guard must not catch errors of the caller's function for the
        # run-time inputs, so the calls of this function come before the guard.
        start = _unguarded(function.body)
        lines += printed.block(function.body[:start], 1)
        lines += ["    try:", *printed.block(function.body[start:], 2)]
        # Functions of ``math`` raise ValueError for an invalid argument.
        return [*lines, "    except (ArithmeticError, ValueError):", *self.guard(function)]

    def guard(self, function: Function) -> list[str]:
        """Return the body of the ``except`` clause of ``function``."""
        if function.guard == RAISES_STATUS:
            return ["        return NOT_FINITE"]
        if function.returns is not None:
            return ["        return nan"]
        # A function without a return value writes its result to one array. After an error, this array is
        # filled with NaNs.
        (changed,) = written(self.unit, function)
        return [f"        {changed}[:] = [nan] * len({changed})"]

    def table(self, table: Table) -> list[str]:
        """Return the lines of a constant array."""
        rows = [[self.constants.text(x) for x in row] for row in table.rows]
        about = [f"# {table.about}"] if table.about else []
        if len(table.name.shape) == 1:
            # A table is a tuple, because a tuple cannot change.
            return [*about, *filled(f"{table.name.text} = (", rows[0], ")", 0)]
        lines = [*about, f"{table.name.text} = ("]
        for row in rows:
            lines += filled("(", row, "),", 1)
        return [*lines, ")"]

    def zeros(self, shape: Sequence[int], kind: Kind, record: str = "") -> str:
        """Return the code that creates a list of zeros or a list of new records.

        If ``shape`` is empty, the code creates one zero or one new record.
        """
        if not shape:
            if kind is Kind.RECORD:
                return f"{class_of(self.unit.record(record))}()"
            return self.constants.text(0.0) if kind in (Kind.REAL, Kind.WIDE) else "0"
        inner = self.zeros(shape[1:], kind, record)
        if len(shape) > 1 or kind is Kind.RECORD:
            # With the operator ``*``, all entries would be the same object.
            return f"[{inner} for _ in range({shape[0]})]"
        return f"[{inner}] * {shape[0]}"

    def record(self, record: Record) -> list[str]:
        """Return the lines of the class of a record. The fields of a new or cleared record are zero."""
        lines = [f"class {class_of(record)}:", *docstring(record.about), "", "    def __init__(self):"]
        lines += ["        self.clear()", "", "    def clear(self):", '        """Set all fields to zero."""']
        for field, about in record.fields:
            note = f"  # {about}" if about and prod(field.shape) < 100 else ""
            line = f"        self.{field.text} = {self.zeros(field.shape, field.kind)}"
            lines.append(line + note)
        return lines


def class_of(record: Record) -> str:
    """Return the name of the Python class of a record."""
    return record.name.capitalize() if record.public else f"_{record.name.capitalize()}"


def docstring(text: str) -> list[str]:
    """Return the lines of a docstring that consists of one paragraph."""
    lines = filled_words(text)
    if len(lines) == 1:
        return [f'    """{lines[0]}"""']
    return [f'    """{lines[0]}', *(f"    {line}" for line in lines[1:]), '    """']


def filled_words(text: str, width: int = 78) -> list[str]:
    """Return the words of a text as lines of at most ``width`` characters."""
    lines = [""]
    for word in text.split():
        # A word longer than ``width`` gets a line of its own.
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append(word)
        else:
            lines[-1] += f" {word}" if lines[-1] else word
    return lines


class _Body:
    """Prints the body of one function."""

    def __init__(self, printer: FunctionPrinter, function: Function) -> None:
        self.printer = printer
        self.identifiers = printer.identifiers[function.name]
        self.terms = Terms(self.identifiers, printer.constants)

    def block(self, body: Body, depth: int) -> list[str]:
        """Return the lines of consecutive statements."""
        lines: list[str] = []
        place = 0
        while place < len(body):
            # In CPython, one combined assignment is faster than one assignment for each entry.
            group = self.entries(body[place:])
            if len(group) >= TOGETHER:
                lines += self.together(group, depth)
                place += len(group)
                continue
            lines += self.statement(body[place], depth)
            place += 1
        return lines

    def entries(self, body: Sequence[Statement]) -> list[Assign]:
        """Return a group of assignments. One Python statement can replace the whole group.

        The group contains the first assignments of ``body``. Either all these assignments read consecutive
        entries of one list, or all of them write consecutive entries of one list.
        """
        group: list[Assign] = []
        for statement in body:
            if not isinstance(statement, Assign):
                break
            if group and not (self.follow(group, statement, True) or self.follow(group, statement, False)):
                break
            # The first assignment of a group must read or write a list entry.
            if not group and _entry(statement.target) is None and _entry(statement.value) is None:
                break
            group.append(statement)
        return group

    def follow(self, group: Sequence[Assign], statement: Assign, reading: bool) -> bool:
        """Return True if ``statement`` can be appended to ``group``.

        One Python statement must be able to replace ``statement`` and all assignments in ``group``. If
        ``reading`` is True, these assignments must read consecutive entries of one list. Otherwise, these
        assignments must write consecutive entries of one list.
        """

        def one(s: Assign) -> Term:
            return s.value if reading else s.target

        entries = [_entry(one(s)) for s in (*group, statement)]
        # If ``reading`` is True, the assignments must not change the list that they read. Therefore every
        # target must be a name, and not an entry of a list.
        if any(e is None for e in entries) or (
            reading and any(s.target.op != "name" for s in (*group, statement))
        ):
            return False
        first = self.terms.line(one(group[0]).args[0])
        # The indices must be consecutive, because a slice selects consecutive entries.
        neighbours = all(b == (entries[0] or 0) + k for k, b in enumerate(entries))
        # A slice belongs to one list, so ``statement`` must use the same list as ``group[0]``.
        same = self.terms.line(one(statement).args[0]) == first
        changed = root(one(statement)).text
        # Assignments that write to a list are joined only if they do not read this list. For example,
        # ``x[0] = x[1]; x[1] = x[0]`` must not become ``x[0:2] = x[1], x[0]``, which swaps the two entries.
        apart = reading or all(x.text != changed for s in (*group, statement) for x in names([s.value]))
        return neighbours and same and apart

    def together(self, group: Sequence[Assign], depth: int) -> list[str]:
        """Return the lines of one assignment with the same effect as ``group``."""
        reading = all(_entry(s.value) is not None and s.target.op == "name" for s in group)
        entry = group[0].value if reading else group[0].target
        array, start = entry.args[0], _entry(entry) or 0
        # A slice copies the list, so a whole list is read without a slice.
        whole = start == 0 and array.shape == (len(group),)
        name = self.terms.line(array)
        if reading:
            part = name if whole else f"{name}[{start}:{start + len(group)}]"
            return unpacked([self.terms.line(s.target) for s in group], part, depth)
        # An assignment without ``[:]`` would bind the name to a new tuple.
        part = f"{name}[:]" if whole else f"{name}[{start}:{start + len(group)}]"
        return listed(f"{part} = ", [self.terms.line(s.value) for s in group], depth)

    def statement(self, statement: Statement, depth: int) -> Iterator[str]:
        """Yield the lines of a statement."""
        space = "    " * depth
        match statement:
            case Assign():
                yield from self.assign(statement, depth)
            case Array():
                yield from self.array(statement, depth)
            case Call():
                yield from self.call(statement, depth)
            case Return(value):
                yield from indented("return ", self.terms.text(value).segments, depth)
            case Note(text):
                yield from (f"{space}# {line}" for line in filled_words(text))
            case If():
                yield from self.branch(statement, depth, "if")
            case While():
                yield from self.loop(statement, depth)
            case For(index, count, body, reverse):
                places = f"range({self.terms.line(count)})"
                places = f"reversed({places})" if reverse else places
                yield f"{space}for {self.identifiers.of(index)} in {places}:"
                yield from self.block(body, depth + 1)

    def branch(self, statement: If, depth: int, word: str) -> Iterator[str]:
        """Yield the lines of a branch."""
        yield from self.condition(word, statement.test, depth)
        yield from self.block(statement.body, depth + 1)
        # If the else part is a single branch, ``elif`` avoids a deeper indentation.
        orelse = statement.orelse
        if len(orelse) == 1 and isinstance(orelse[0], If):
            yield from self.branch(orelse[0], depth, "elif")
        elif orelse:
            yield f"{'    ' * depth}else:"
            yield from self.block(orelse, depth + 1)

    def condition(self, word: str, test: Term, depth: int) -> list[str]:
        """Return the first lines of a branch or a loop. ``word`` is ``if``, ``elif`` or ``while``."""
        lines = indented(f"{word} ", self.terms.text(test).segments, depth)
        return [*lines[:-1], f"{lines[-1]}:"]

    def loop(self, statement: While, depth: int) -> Iterator[str]:
        """Yield the lines of a loop."""
        if statement.guard is not None:
            space, inner = "    " * depth, replace(statement, guard=None)
            yield f"{space}try:"
            yield from self.loop(inner, depth + 1)
            # Functions of ``math`` raise ValueError for an invalid argument.
            yield f"{space}except (ArithmeticError, ValueError):"
            yield f"{space}    {self.identifiers.of(statement.guard)} = NOT_FINITE"
            return
        if not statement.at_least_once:
            yield from self.condition("while", statement.test, depth)
            yield from self.block(statement.body, depth + 1)
            return
        # Python has no loop with a test at the end.
        yield f"{'    ' * depth}while True:"
        yield from self.block(statement.body, depth + 1)
        yield from self.condition("if", Term("not", (statement.test,), Kind.FLAG), depth + 1)
        yield f"{'    ' * (depth + 2)}break"

    def assign(self, statement: Assign, depth: int) -> Iterator[str]:
        """Yield the lines that assign a scalar, copy an array or clear a record."""
        target, value = statement.target, statement.value
        name = self.terms.line(target)
        # The caller also uses this record, so the record is cleared and not replaced.
        if value.op == "fresh":
            yield f"{'    ' * depth}{name}.clear()"
            return
        if target.shape:
            # A slice assignment changes the caller's list.
            name = name if target.op == "part" else f"{name}[:]"
            yield f"{'    ' * depth}{name} = {self.terms.line(value)}"
            return
        text = self.terms.text(value)
        # ``x = x - y`` is printed as ``x -= y``. Python has no short form for ``x = y - x``.
        changed = value.op in "+-*" and value.args and self.terms.line(value.args[0]) == name
        if changed:
            yield from indented(f"{name} {value.op}= ", self.terms.text(value.args[1]).segments, depth)
            return
        yield from indented(f"{name} = ", text.segments, depth)

    def array(self, statement: Array, depth: int) -> Iterator[str]:
        """Yield the lines that create a list."""
        name = statement.name
        start = f"{self.identifiers.of(name)} = "
        if statement.values:
            yield from filled(f"{start}[", [self.terms.line(x) for x in statement.values], "]", depth)
            return
        yield f"{'    ' * depth}{start}{self.printer.zeros(name.shape, name.kind, name.record)}"

    def call(self, statement: Call, depth: int) -> Iterator[str]:
        """Yield the lines of a call."""
        given = [self.terms.line(a) for a in statement.arguments]
        results = [self.terms.line(r) for r in statement.results]
        # The template defines ``sample`` and ``measure`` under the names ``_sampled`` and ``_measured``.
        name = {"sample": "sampled", "measure": "measured"}.get(statement.function, statement.function)
        start = f"{', '.join(results)} = " if results else ""
        # The helper ``invert`` has no leading underscore.
        called = "invert" if name == "invert" else f"_{name}"
        yield from filled(f"{start}{called}(", given, ")", depth)


def _unguarded(body: Body) -> int:
    """Return the number of statements at the start of ``body`` up to the last call of ``sample``.

    The result is 0 if ``body`` has no such call.
    """
    calls = [k for k, x in enumerate(body) if isinstance(x, Call) and x.function == "sample"]
    return calls[-1] + 1 if calls else 0


def _entry(term: Term) -> int | None:
    """Return k if ``term`` is a scalar a[k] with a constant k. Otherwise return None."""
    # If the index ``term.args[1]`` is a variable, its value is known only when the emitted code runs.
    if term.op != "item" or term.shape or term.args[1].op != "number":
        return None
    return int(term.args[1].number)
