"""The momentum that a run carries, in C: functions that turn it in and out of the frame of the steps."""

from __future__ import annotations

from collections.abc import Collection

from codegen.ir.kernel import Carried, Kernel
from codegen.kernel.schedule import arrange
from codegen.printers.c.statements import Statements
from codegen.printers.identifiers import register
from codegen.printers.interface import Interface
from codegen.printers.names import Names


def turning(carried: Carried, interface: Interface, reserved: Collection[str]) -> dict[str, object]:
    """Return what the template needs: the lines of both functions, and where the momentum stands."""
    return {
        "inward": _lines(carried.inward, interface, reserved),
        "outward": _lines(carried.outward, interface, reserved),
        "first": carried.first,
        "size": interface.size - carried.first,
    }


def _lines(kernel: Kernel, interface: Interface, reserved: Collection[str]) -> list[str]:
    """Return the body of a function that fills an array by what a kernel gives of the state."""
    arrangement, real = arrange(kernel), interface.format.c_type
    names = register(kernel, arrangement, Names(reserved))
    statements = Statements(arrangement, names, interface.prefix, interface.format)
    read = arrangement.symbols()
    symbols = [s for f in kernel.state for s in f.symbols]
    lines = [f"const {real} {names.spelled[s]} = state[{i}];" for i, s in enumerate(symbols) if s in read]
    lines += statements.lines()
    for k, value in enumerate(arrangement.outputs):
        lines += statements.declare(f"momentum[{k}]", value, "")
    return lines
