"""The fastest way to compute a group's products: tried on the kernel, chosen by its operations and chains.

A rotation matrix has a column to spare: it is the cross product of the other two. Which column that is best,
or whether all three should be turned, depends on what the scene reads of the attitude.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.expr import walk
from codegen.ir.kernel import Kernel
from codegen.ir.program import FLOWS, Program
from codegen.lower.kernel import to_kernel
from codegen.lower.late import chain
from codegen.lower.put_off import with_put_off
from codegen.scene import Setting

CALL = 10
"""How many operations a call of a function counts for."""

WIDTH = 10
"""How many operations a processor makes while an addition takes its time."""


def fastest(program: Program, scene: Setting) -> Kernel:
    """Return the kernel of a program in that variant of the group which promises the shortest step."""
    composed = any(name in FLOWS for name in program.counts())
    groups = scene.group.variants() if composed else (scene.group,)
    found = []
    for group in groups:
        view = replace(scene, group=group)
        found.append(with_put_off(to_kernel(program, view), program, view))
    return min(found, key=time)


def time(kernel: Kernel) -> tuple[float, int]:
    """Return what a step takes, in times of an addition, and its operations, which decide between equals."""
    nodes = walk(kernel.expressions())
    work = sum(CALL if n.op == "call" else int(n.op not in ("const", "sym", "neg")) for n in nodes)
    return max(work / WIDTH, chain(kernel)), work
