"""The cheapest way to compute a group's products: tried on the kernel, chosen by its number of operations.

A rotation matrix has a column to spare: it is the cross product of the other two. Which column that is best,
or whether all three should be turned, depends on what the scene reads of the attitude.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.expr import walk
from codegen.ir.kernel import Kernel
from codegen.ir.program import FLOWS, Program
from codegen.lower.kernel import to_kernel
from codegen.lower.put_off import with_put_off
from codegen.scene import Setting

CALL = 10
"""How many operations a call of a function counts for."""


def cheapest(program: Program, scene: Setting) -> Kernel:
    """Return the kernel of a program with as few operations as the group's variants allow."""
    composed = any(name in FLOWS for name in program.counts())
    groups = scene.group.variants() if composed else (scene.group,)
    found = []
    for group in groups:
        view = replace(scene, group=group)
        found.append(with_put_off(to_kernel(program, view), program, view))
    return min(found, key=cost)


def cost(kernel: Kernel) -> int:
    """Return the number of operations of a step, calls counted :data:`CALL` times."""
    nodes = walk(kernel.expressions())
    return sum(CALL if n.op == "call" else int(n.op not in ("const", "sym", "neg")) for n in nodes)
