"""Describes the state and the run-time inputs, for the header of emitted code."""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.printers.expression import render


def layout(kernel: Kernel) -> tuple[str, ...]:
    """Return lines with the indices, the name and the meaning of each field of the state."""
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
    """Return a tuple with at most one line of text.

    If the kernel has run-time inputs, the line lists the inputs and the times at which the inputs are
    evaluated. If the kernel has no inputs, the tuple is empty.
    """
    if not kernel.inputs:
        return ()
    # The returned line contains the input names of the scene. The emitted code may use different identifiers.
    read = ", ".join(" ".join(render(sample.time, {})) for sample in kernel.samples)
    return (f"{', '.join(kernel.inputs)}, as functions of time, evaluated at {read}",)
