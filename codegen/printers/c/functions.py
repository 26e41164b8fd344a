"""Pieces of a kernel in C: static functions that take numbers and give one, or fill an array."""

from __future__ import annotations

from collections.abc import Collection

from codegen.ir.kernel import Function
from codegen.kernel.schedule import Arrangement
from codegen.printers.c.statements import Statements
from codegen.printers.c.text import comment, fill
from codegen.printers.identifiers import named
from codegen.printers.interface import Interface
from codegen.printers.names import Names


def outlined_function(
    function: Function, arrangement: Arrangement, interface: Interface, reserved: Collection[str]
) -> tuple[list[str], int]:
    """Return the lines of a function's definition, and how many numbers it holds at once."""
    real = interface.format.c_type
    names = Names(reserved)
    for name in function.inputs:
        names.spelled[name] = names.fresh(name.partition(".")[2])
    named(arrangement.statements, names)
    statements = Statements(arrangement, names, interface.prefix, interface.format)
    several = len(arrangement.outputs) > 1
    body = list(statements.lines())
    for k, value in enumerate(arrangement.outputs):
        body += statements.declare(f"result[{k}]" if several else "return", value, "")
    if not several:
        body[-1:] = [body[-1].replace("return =", "return", 1)]
    arguments = [f"{real} {names.spelled[name]}" for name in function.inputs]
    arguments += [f"{real} result[static {len(arrangement.outputs)}]"] if several else []
    head = f"static {'void' if several else real} {function.name}("
    parts = (*(f"{a}," for a in arguments[:-1]), arguments[-1])
    lines = [
        *fill("/*", (*comment(function.about).split(), "*/"), ""),
        *fill(head, parts, ")", joint=""),
        "{",
        *(f"    {line}" for line in body),
        "}",
    ]
    return lines, names.count
