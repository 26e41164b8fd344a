"""What a header says of the numbers of a state and of run-time inputs."""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.printers.expression import spell


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


def times(kernel: Kernel) -> tuple[str, ...]:
    """Return a line that names the run-time inputs and when they are read, none where there are none."""
    if not kernel.inputs:
        return ()
    read = ", ".join(" ".join(spell(sample.time, {})) for sample in kernel.samples)
    return (f"{', '.join(kernel.inputs)}, as functions of time, read at {read}",)
