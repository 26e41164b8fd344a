"""From scene and method to emitted files and a manifest entry; also from a bare kernel."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from codegen.emission import Emission, digest
from codegen.ir.kernel import Kernel
from codegen.printers import target as printer_of
from codegen.printers.arrange import arrange
from codegen.printers.interface import Interface
from codegen.printers.operations import operations
from codegen.printers.recipe import Recipe


def emit_kernel(
    kernel: Kernel, recipe: Recipe, target: str, prefix: str, about: Mapping[str, Any] | None = None
) -> Emission:
    """Return a kernel as a module of a target; ``about`` adds to the manifest entry what only a caller knows.

    The prefix starts every external C name and names the files. UnknownName for a target that is not there.
    """
    interface = Interface.of(kernel, prefix)
    files = printer_of(target)(kernel, interface, recipe)
    manifest = {
        **(about or {}),
        "module": interface.module,
        "target": target,
        "interface": interface.as_json(),
        "defaults": {p: float(recipe.defaults[p]) for p in interface.parameters if p in recipe.defaults},
        "files": {name: digest(text) for name, text in files.items()},
        "operations": operations(arrange(kernel)),
        "state": [{"name": f.name, "symbols": list(f.symbols), "meaning": f.meaning} for f in kernel.state],
        "command": recipe.command,
        "version": recipe.version,
    }
    return Emission(files, manifest)
