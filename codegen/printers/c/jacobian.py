"""The Jacobian of a step in C: a function that carries one variation along, called for each unit vector."""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.kernel.schedule import Arrangement, arrange
from codegen.printers.c.statements import Statements
from codegen.printers.c.text import fill
from codegen.printers.identifiers import blocks, register
from codegen.printers.interface import Interface
from codegen.printers.names import Names


def varying(
    kernel: Kernel, interface: Interface, names: Names
) -> tuple[dict[str, object], Arrangement, Statements]:
    """Return what the template needs of the kernel of variations, and its arrangement and statements.

    Its state is that of the step and then the variation; it returns the variation of the new state.
    """
    arrangement = arrange(kernel)
    register(kernel, arrangement, names)
    symbols = tuple(s for f in kernel.state for s in f.symbols)
    real, read = interface.format.c_type, arrangement.symbols()
    statements = Statements(arrangement, names, interface.prefix, interface.format, blocks(kernel))
    body = list(statements.lines())
    ends, new = statements.outputs(symbols[interface.size :])
    places = [f"state[{i}]" for i in range(interface.size)]
    places += [f"vector[{i}]" for i in range(interface.variations)]
    pairs = zip(symbols, places, strict=True)
    loads = [f"const {real} {names.spelled[s]} = {place};" for s, place in pairs if s in read]
    scalars = [*(["t"] if interface.time else []), *interface.parameters]
    found: dict[str, object] = {
        "unread": [names.spelled[s] for s in scalars if s not in read],
        "body": [*loads, *body, *ends],
        "new": new,
        "finite": fill("if (!(", tuple(_checks(new)), ")) {", joint=""),
    }
    return found, arrangement, statements


def _checks(new: tuple[str, ...]) -> list[str]:
    first, *rest = (f"isfinite({name})" for name in new)
    return [first, *(f"&& {check}" for check in rest)]
