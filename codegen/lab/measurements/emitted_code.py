"""The section about the emitted code of each method.

The section shows the arithmetic operations of a step, and the emitted files.
"""

from __future__ import annotations

from codegen.kernel.operations import sentences
from codegen.lab.measurement import Measurement, Section
from codegen.lab.subject import CompiledMethod, Subject


class EmittedCode(Measurement[tuple[CompiledMethod, ...]]):
    """Lists the operations, the simplifications and the emission command of each emitted module.

    All three are read from the manifest (the description) of the module.
    """

    name = "emitted"
    title = "Emitted code"
    about = "operations of a step, emitted files, and simplifications of the emitted code"
    part_of = "orders"

    def run(self, subject: Subject) -> tuple[CompiledMethod, ...]:
        """Return the compiled methods."""
        return subject.compiled.measured

    def as_json(self, result: tuple[CompiledMethod, ...]) -> object:
        """Return the module name, operations, simplifications and emission command for each method."""
        keys = ("module", "operations", "left_out", "command")
        return [{"method": m.label, **{k: m.artifact.manifest[k] for k in keys}} for m in result]

    def verdict(self, result: tuple[CompiledMethod, ...], subject: Subject) -> str:
        """Return a sentence that names the methods with the shortest and with the longest emitted code."""
        lengths = sorted((sum(text.count("\n") for _, text in m.files), m.label) for m in result)
        if not lengths:
            return ""
        (least, shortest), (most, longest) = lengths[0], lengths[-1]
        if len(lengths) == 1:
            return f"The emitted code of {shortest} has {least} lines."
        return (
            f"{shortest} has the shortest emitted code ({least} lines), and "
            f"{longest} has the longest emitted code ({most} lines)."
        )

    def section(self, result: tuple[CompiledMethod, ...], subject: Subject) -> Section | None:
        """Return the section with one entry for each method."""
        if not result:
            return None
        entries = [_entry(m) for m in result]
        return Section('{% include "sections/emitted.html.j2" %}', {"emissions": entries})


def _entry(method: CompiledMethod) -> dict[str, object]:
    manifest = method.artifact.manifest
    return {
        "label": method.label,
        "operations": sentences(manifest["operations"]),
        "left_out": manifest["left_out"],
        "command": manifest["command"],
        "lines": {name: text.count("\n") for name, text in sorted(method.artifact.files.items())},
    }
