"""Determines properties of emitted methods, such as symplecticity and the stack memory of a call."""

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

    - ``on_manifold``: True if the state stays on the manifold, apart from rounding errors.
    - ``symplectic``: True if the method is symplectic and all steps have the same size.
    - ``explicit``: True if the method solves no equations.
    - ``adaptive``: True if the method runs with step-size control.
    - ``stack``: an upper bound of the stack memory of a call in bytes, or 0 if no bound is known.
    - ``lines``: the number of lines of the file that contains the emitted step.
    """

    label: str
    on_manifold: bool
    symplectic: bool
    explicit: bool
    adaptive: bool
    stack: int
    lines: int


def features(compiled: Compiled, artifact: Artifact, label: str = "") -> Features:
    """Return the properties of an emitted method.

    If ``label`` is not empty, it replaces the label of the method.
    """
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
    """Return True if a method is symplectic and has a constant step size.

    With variable step sizes, symplectic methods do not preserve the energy better than other methods over
    long times.
    """
    scene, method = compiled.scene, compiled.method
    if not scene.is_hamiltonian or method.adaptive:
        return False
    return lowering(method.family).symplectic(scene, method)
