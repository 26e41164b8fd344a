"""The fastest way to compute a group's products: tried on the kernel, chosen by its operations and chains.

A rotation matrix has a column to spare: it is the cross product of the other two. Which column that is best,
or whether all three should be turned, depends on what the scene reads of the attitude.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.groups.capabilities import CotangentBundle
from codegen.ir.expr import walk
from codegen.ir.kernel import Kernel
from codegen.ir.operations import FLOWS
from codegen.ir.program import Assign, Program
from codegen.kernel.critical_path import chain
from codegen.kernel.deferred_flows import part, with_deferred
from codegen.kernel.translate import AS_WRITTEN, COMBINED, ORDERED, SHORTENED, to_kernel
from codegen.scene.problem import Problem

CALL = 10
"""How many operations a call of a function counts for."""

WIDTH = 8
"""How many operations a processor makes while an addition takes its time, beside those that it waits for."""


def fastest(program: Program, scene: Problem) -> Kernel:
    """Return the kernel of a program in that variant of the group which promises the shortest step.

    Only explicit programs of flows, and fields on T*G, have variants of the group.
    """
    if not all(isinstance(statement, Assign) for statement in program.body):
        return to_kernel(program, scene)
    flows = any(isinstance(assign.operation, FLOWS) for assign in program.assigns())
    if not flows and scene.group.offers(CotangentBundle) is None:
        return _shortest([to_kernel(program, scene, chains=chains) for chains in (AS_WRITTEN, COMBINED)])
    parted = None if scene.inputs else part(program, scene)  # inputs are sampled step by step
    core = program if parted is None else parted.core
    found: list[tuple[Kernel, Problem, int]] = []
    for group in scene.group.variants():
        view = replace(scene, group=group)
        for chains in (ORDERED, SHORTENED):
            found.append((to_kernel(core, view, chains=chains), view, chains))
    best = _shortest([kernel for kernel, _, _ in found])
    kernel, view, chains = next(candidate for candidate in found if candidate[0] is best)
    return kernel if parted is None else with_deferred(kernel, parted, view, chains)


def _shortest(kernels: Sequence[Kernel]) -> Kernel:
    """Return the kernel of the shortest step; where some are so long that they call functions, of those."""
    return min([kernel for kernel in kernels if kernel.outlined] or kernels, key=time)


def time(kernel: Kernel) -> tuple[float, int]:
    """Return what a step takes, in times of an addition, and its operations, which decide between equals."""
    nodes = walk(kernel.expressions())
    work = sum(CALL if n.op == "call" else int(n.op not in ("const", "sym", "neg")) for n in nodes)
    return chain(kernel) + work / WIDTH, work
