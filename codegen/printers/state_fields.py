"""Describes the state and the run-time inputs, for the header of emitted code."""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.printers.expression import render


def layout(kernel: Kernel) -> tuple[str, ...]:
    """Return a line for each field of the state, with the indices, name and meaning of the field."""
    lines: list[str] = []
    start = 0
    for field in kernel.state:
        end = start + len(field.symbols)
        # A field with a single coordinate has one index, not a range.
        places = f"[{start}]" if end == start + 1 else f"[{start}..{end - 1}]"
        lines.append(f"{places} {field.name}: {field.meaning}")
        start = end
    return tuple(lines)


def times(kernel: Kernel) -> tuple[str, ...]:
    """Return one line with the names of the run-time inputs and their evaluation times.

    If there are no inputs, the tuple is empty.
    """
    if not kernel.inputs:
        return ()
    # The line contains the names from the scene. The emitted code may use different identifiers.
    read = ", ".join(" ".join(render(sample.time, {})) for sample in kernel.samples)
    return (f"{', '.join(kernel.inputs)}, as functions of time, evaluated at {read}",)
