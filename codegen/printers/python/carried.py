"""The momentum that a run carries, in Python: functions that turn it in and out of the frame of the steps."""

from __future__ import annotations

from codegen.ir.kernel import Carried, Kernel
from codegen.kernel.schedule import arrange
from codegen.printers.identifiers import register
from codegen.printers.interface import Interface
from codegen.printers.names import Names
from codegen.printers.python.statements import RESERVED, Statements
from codegen.printers.python.text import listed, unpacking


def turning(carried: Carried, interface: Interface) -> tuple[dict[str, object], dict[str, str]]:
    """Return what the template needs, and constants: bodies of both functions, where the momentum stands."""
    inward, first = _lines(carried.inward, interface, "I")
    outward, second = _lines(carried.outward, interface, "O")
    return {"inward": inward, "outward": outward, "first": carried.first}, first | second


def _lines(kernel: Kernel, interface: Interface, letter: str) -> tuple[list[str], dict[str, str]]:
    """Return the body of a function that returns what a kernel gives of the state, and its constants."""
    arrangement = arrange(kernel)
    names = register(kernel, arrangement, Names(RESERVED))
    statements = Statements(arrangement, names, interface.format, letter)
    symbols = [names.spelled[s] for f in kernel.state for s in f.symbols]
    body = [*unpacking(symbols), *statements.lines()]
    found = [names.fresh(f"momentum_{k}") for k in range(len(arrangement.outputs))]
    for name, value in zip(found, arrangement.outputs, strict=True):
        body += statements.assign(name, value, 1)
    return [*body, *listed("return ", found, 1)], statements.constants
