"""Lines for the header of emitted code that describe the state and the run-time inputs."""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.printers.expression import render


def layout(kernel: Kernel) -> tuple[str, ...]:
    """Return a line for each field of the state: indices, name and meaning."""
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
    """Return a line with the names of the run-time inputs, and the times at which a step evaluates them.

    If there are no inputs, the result is empty.
    """
    if not kernel.inputs:
        return ()
    # The header shows the names of the scene, not the identifiers of the emitted code.
    read = ", ".join(" ".join(render(sample.time, {})) for sample in kernel.samples)
    return (f"{', '.join(kernel.inputs)}, as functions of time, evaluated at {read}",)
