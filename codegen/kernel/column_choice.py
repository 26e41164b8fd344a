"""The choice among variants of a group: each is compiled, and the one with the shortest step is kept.

A column of a rotation matrix is the cross product of the other two. Which column to compute so, or whether to
rotate all three, depends on the columns that the scene reads.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.groups.capabilities import CotangentBundle
from codegen.ir.expr import walk
from codegen.ir.kernel import Kernel
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import FLOWS
from codegen.kernel.critical_path import chain
from codegen.kernel.deferred_flows import part, with_deferred
from codegen.kernel.translate import AS_WRITTEN, COMBINED, ORDERED, SHORTENED, to_kernel
from codegen.scene.problem import Problem

CALL = 10
"""The operations that a function call counts as; chosen with ``benchmarks/emitted.py``."""

WIDTH = 8
"""Independent operations that a processor completes during one addition.

Chosen with ``benchmarks/emitted.py``."""


def fastest(program: Program, scene: Problem) -> Kernel:
    """Return the kernel of a program in the variant of the group with the shortest step.

    Only explicit programs of flows, and fields on T*G, have variants of the group.
    """
    if not all(isinstance(statement, Assign) for statement in program.body):
        return to_kernel(program, scene)
    flows = any(isinstance(assign.operation, FLOWS) for assign in program.assigns())
    if not flows and scene.group.offers(CotangentBundle) is None:
        return _shortest([to_kernel(program, scene, chains=chains) for chains in (AS_WRITTEN, COMBINED)])
    parted = None if scene.inputs else part(program, scene)  # inputs are sampled step by step
    core = program if parted is None else parted.core
    candidates: list[tuple[Kernel, Problem, int]] = []
    # Each variant is compiled twice: reordering alone, and with the critical path shortened.
    for group in scene.group.variants():
        problem = replace(scene, group=group)
        for chains in (ORDERED, SHORTENED):
            candidates.append((to_kernel(core, problem, chains=chains), problem, chains))
    best = _shortest([kernel for kernel, _, _ in candidates])
    kernel, problem, chains = next(candidate for candidate in candidates if candidate[0] is best)
    return kernel if parted is None else with_deferred(kernel, parted, problem, chains)


def _shortest(kernels: Sequence[Kernel]) -> Kernel:
    """Return the kernel of the shortest step; where some are so long that they call functions, of those."""
    return min([kernel for kernel in kernels if kernel.outlined] or kernels, key=time)


def time(kernel: Kernel) -> tuple[float, int]:
    """Return what a step takes, in times of an addition, and its operations, which decide between equals."""
    nodes = walk(kernel.expressions())
    work = sum(CALL if n.op == "call" else int(n.op not in ("const", "sym", "neg")) for n in nodes)
    return chain(kernel) + work / WIDTH, work
