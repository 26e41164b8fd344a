"""Properties of emitted methods, computed from their programs and tableaux."""

from __future__ import annotations

import re
from dataclasses import dataclass

from codegen.artifact import Artifact
from codegen.emitter import Compiled
from codegen.lower import lowering
from codegen.printers import target as known_target


@dataclass(frozen=True)
class Features:
    """Properties of an emitted method.

    ``on_manifold`` is True if a step acts by group elements, so that the state stays on the manifold up to
    rounding. ``explicit`` is True if no equations are solved, so that all steps take the same time. ``stack``
    is an upper bound of the stack memory of a call in bytes, or 0 if no bound is known. ``lines`` is the
    number of lines of the file that contains the step.
    """

    label: str
    on_manifold: bool
    symplectic: bool
    explicit: bool
    adaptive: bool
    stack: int
    lines: int


def features(compiled: Compiled, artifact: Artifact, label: str = "") -> Features:
    """Return the properties of a method, under the given label or the label of the method."""
    target = known_target(artifact.manifest["target"])
    source = artifact.files[target.step_file(artifact.manifest["module"])]
    stack = re.search(target.stack, source) if target.stack else None
    return Features(
        label or compiled.method.label,
        lowering(compiled.method.family).keeps_manifold(compiled.scene),
        is_symplectic(compiled),
        not compiled.kernel.loops,
        compiled.method.adaptive,
        int(stack[1]) if stack else 0,
        source.count("\n"),
    )


def is_symplectic(compiled: Compiled) -> bool:
    """Return True if steps of constant size are symplectic maps, and False for methods with step-size
    control.

    With variable steps, symplectic methods lose their good behaviour over long times.
    """
    scene, method = compiled.scene, compiled.method
    if not scene.is_hamiltonian or method.adaptive:
        return False
    return lowering(method.family).symplectic(scene, method)
