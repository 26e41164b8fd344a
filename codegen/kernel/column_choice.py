"""The choice among variants of a group: all are compiled, and the kernel with the shortest step is kept.

A column of a rotation matrix is the cross product of the other two columns. A variant computes one column by
this product, or rotates all three. Which variant is fastest depends on the columns that the scene reads.
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
"""A function call counts as this many operations. The number was chosen with ``benchmarks/emitted.py``.

With 20 in place of 10, all emitted files stay the same. With 5, the files of five explicit methods change. To
repeat this
comparison, edit the value and type ``orderconds regenerate --check``."""

WIDTH = 8
"""The number of independent operations that a processor completes during one addition.

The number was chosen with ``benchmarks/emitted.py``. With 16 in place of 8, all emitted files stay the same.
With 4, the
files of
``rkmk:rk4`` on free_rigid_body and of one splitting change. Repeat the comparison as for :data:`CALL`."""


def fastest(program: Program, scene: Problem) -> Kernel:
    """Return a program's kernel, compiled for the variant of the group that gives the shortest step.

    Variants are compared only for explicit programs that contain flows or integrate a field on T*G.
    """
    if not all(isinstance(statement, Assign) for statement in program.body):
        return to_kernel(program, scene)
    flows = any(isinstance(assign.operation, FLOWS) for assign in program.assigns())
    # In a program without flows all variants of the group give the same kernel, so only the order of constant
    # factors is tried.
    if not flows and scene.group.offers(CotangentBundle) is None:
        return _shortest([to_kernel(program, scene, chains=chains) for chains in (AS_WRITTEN, COMBINED)])
    # Run-time inputs are sampled in every step, so no flow is deferred if the scene has run-time inputs. The
    # core is the
    # step without its deferred flows; only the core is computed in every step, so only the core is compared.
    parted = None if scene.inputs else part(program, scene)
    core = program if parted is None else parted.core
    # All variants are compiled and compared, because the common subexpressions of the scene decide which is
    # shortest.
    candidates: list[tuple[Kernel, Problem, int]] = []
    # Each variant is compiled twice: with products and assignments in another order only, and with a
    # shortened critical path.
    for group in scene.group.variants():
        problem = replace(scene, group=group)
        for chains in (ORDERED, SHORTENED):
            candidates.append((to_kernel(core, problem, chains=chains), problem, chains))
    # Kernels are compared by identity, because two candidates may have equal kernels.
    best = _shortest([kernel for kernel, _, _ in candidates])
    kernel, problem, chains = next(candidate for candidate in candidates if candidate[0] is best)
    return kernel if parted is None else with_deferred(kernel, parted, problem, chains)


def _shortest(kernels: Sequence[Kernel]) -> Kernel:
    """Return the kernel with the shortest step; compare only outlined kernels if there are any."""
    # The time of a step that is long enough for outlining is limited by the instruction cache, not by
    # latency.
    return min([kernel for kernel in kernels if kernel.outlined] or kernels, key=time)


def time(kernel: Kernel) -> tuple[float, int]:
    """Return a step's estimated time, in additions, and its number of operations, which decides ties."""
    nodes = walk(kernel.expressions())
    work = sum(CALL if n.op == "call" else int(n.op not in ("const", "sym", "neg")) for n in nodes)
    # The time of a step is estimated by the sum of two lower bounds, from the latency and from the throughput
    # of operations.
    return chain(kernel) + work / WIDTH, work
