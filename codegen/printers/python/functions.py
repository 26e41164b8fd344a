"""Pieces of a kernel in Python: functions that take numbers and return one, or a tuple."""

from __future__ import annotations

from codegen.ir.kernel import Function
from codegen.kernel.schedule import Arrangement
from codegen.printers.identifiers import named
from codegen.printers.interface import Interface
from codegen.printers.names import Names
from codegen.printers.python.statements import RESERVED, Statements
from codegen.printers.python.text import filled, listed


def outlined_function(
    function: Function, arrangement: Arrangement, interface: Interface
) -> tuple[list[str], dict[str, str]]:
    """Return the lines of a function's definition, and the constants it uses in single precision."""
    names = Names(RESERVED)
    for name in function.inputs:
        names.spelled[name] = names.fresh(name.partition(".")[2])
    named(arrangement.statements, names)
    letter = "P" + function.name.rpartition("_")[2] + "_"
    statements = Statements(arrangement, names, interface.format, letter)
    body = list(statements.lines())
    results = []
    for k, value in enumerate(arrangement.outputs):
        if value.op == "sym":
            results.append(names.spelled[value.payload])
            continue
        results.append(names.fresh(f"result_{k}"))
        body += statements.assign(results[-1], value, 1)
    ending = [f"    return {results[0]}"] if len(results) == 1 else listed("return ", results, 1)
    lines = [
        *filled(f"def _{function.name}(", [names.spelled[name] for name in function.inputs], "):", 0),
        '    """' + function.about.replace("\\", "\\\\") + '"""',
        *body,
        *ending,
    ]
    return lines, statements.constants
