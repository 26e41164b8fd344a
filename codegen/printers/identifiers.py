"""Where the state's numbers lie, and which identifiers a kernel's names get."""

from __future__ import annotations

from collections.abc import Iterable

from codegen.ir.kernel import VARIATION, Kernel
from codegen.kernel.schedule import Arrangement, Beginning, Invocation, Iteration, Joint, Statement
from codegen.printers.expression import spell
from codegen.printers.names import Names

Place = tuple[str, int, int]
"""An array, where in it a block begins, and of how many numbers it is."""

WIDE = 12
"""The most unknowns for which each entry of a matrix stands in a statement of its own."""

WIDEST = 20
"""The most unknowns of a fixed point for which each stands in a statement of its own."""


def layout(kernel: Kernel) -> tuple[str, ...]:
    """Return a line for each field of the state: its places, its name and what it means."""
    lines: list[str] = []
    start = 0
    for field in kernel.state:
        end = start + len(field.symbols)
        places = f"[{start}]" if end == start + 1 else f"[{start}..{end - 1}]"
        lines.append(f"{places} {field.name}: {field.meaning}")
        start = end
    return tuple(lines)


def blocks(kernel: Kernel) -> tuple[Place, ...]:
    """Return where the blocks of a kernel's state lie.

    A kernel that carries a variation along has it as its last field, and in an array of its own.
    """
    found: list[Place] = []
    start = 0
    for field in kernel.state:
        varied = field.name == VARIATION
        found.append(("vector" if varied else "state", 0 if varied else start, len(field.symbols)))
        start += len(field.symbols)
    return tuple(found)


def times(kernel: Kernel) -> tuple[str, ...]:
    """Return a line that says what the inputs are and when they are read, none where there are none."""
    if not kernel.inputs:
        return ()
    read = ", ".join(" ".join(spell(sample.time, {})) for sample in kernel.samples)
    return (f"{', '.join(kernel.inputs)}, as functions of time, read at {read}",)


def register(kernel: Kernel, arrangement: Arrangement, names: Names) -> Names:
    """Give every name of an arranged kernel an identifier and return the names.

    Scalars come first, so that arguments keep their spelling where a state symbol wants the same.
    """
    names.add_all(kernel.scalars)
    names.add_all(s for f in kernel.state for s in f.symbols)
    names.add_all(s for sample in kernel.samples for s in sample.symbols)
    return named(arrangement.statements, names)


def named(statements: Iterable[Statement], names: Names) -> Names:
    """Give every name that statements make an identifier and return the names."""
    for statement in statements:
        match statement:
            case Iteration():
                names.add_all(statement.loop.unknowns)
                names.add_all(statement.loop.newton.changes if statement.loop.newton is not None else ())
                simple = (*statement.body, *statement.newton)
            case Beginning():
                names.add_all(statement.start.unknowns)
                simple = statement.body
            case _:
                simple = (statement,)
        for one in simple:
            names.add_all(one.names if isinstance(one, Joint) else (one.name,))
            if isinstance(one, Invocation) and one.results == 1:
                names.spelled[one.names[0]] = names.spelled[one.name]
            elif isinstance(one, Invocation):
                names.spelled |= {x: f"{names.spelled[one.name]}[{k}]" for k, x in enumerate(one.names)}
    return names


def inverts(kernel: Kernel) -> bool:
    """Whether some matrix of Newton's method is inverted at run time."""
    return any(loop.newton is not None and not loop.newton.inverted for loop in kernel.loops)
