"""The choice among variants of a group. All variants are compiled, and the kernel with the shortest estimated
time of a step is used.

The variants update a rotation matrix in different ways. Either they rotate all three columns, or they rotate
two columns and compute the third column as the cross product of these two. Which variant is fastest depends
on the columns that the scene uses.
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
"""The cost of a function call, in units of one arithmetic operation. The number was chosen with
``benchmarks/emitted.py``.

The value 20 changes no emitted file. The value 5 changes the files of five explicit methods. To repeat this
comparison, edit the value and run ``orderconds regenerate --check``.
"""

WIDTH = 8
"""The number of independent operations that a processor completes during one addition.

The number was chosen with ``benchmarks/emitted.py``. The value 16 changes no emitted file. The value 4
changes the files of ``rkmk:rk4`` on free_rigid_body and of one splitting. To repeat this comparison, edit the
value and run ``orderconds regenerate --check``.
"""


def fastest(program: Program, scene: Problem) -> Kernel:
    """Return the kernel of a program for the variant of the group with the shortest estimated time of a step.

    Variants are compared only for explicit programs that contain flows or integrate a field on T*G.
    """
    if not all(isinstance(statement, Assign) for statement in program.body):
        return to_kernel(program, scene)
    flows = any(isinstance(assign.operation, FLOWS) for assign in program.assigns())
    # If the program has no flows and the group is no cotangent bundle, all variants of the group give the
    # same kernel. Therefore only two orders of the products with constant factors are compared.
    if not flows and scene.group.offers(CotangentBundle) is None:
        return _shortest([to_kernel(program, scene, chains=chains) for chains in (AS_WRITTEN, COMBINED)])
    # Deferred flows are applied only at the beginning or the end of a run. Each step then computes only the
    # other flows, called the core. Therefore cores are compared. In a scene with run-time inputs no flows are
    # deferred, because the inputs must be sampled in every step.
    parted = None if scene.inputs else part(program, scene)
    core = program if parted is None else parted.core
    # The variant with the shortest time depends on subexpressions that the formulas of the group share with
    # the scene, so all variants are compiled.
    candidates: list[tuple[Kernel, Problem, int]] = []
    # Each variant is compiled twice. In one kernel only the order of products and assignments is changed. In
    # the other kernel the critical path is also shortened.
    for group in scene.group.variants():
        problem = replace(scene, group=group)
        for chains in (ORDERED, SHORTENED):
            candidates.append((to_kernel(core, problem, chains=chains), problem, chains))
    # The chosen kernel is found by identity, because two candidates may have equal kernels.
    best = _shortest([kernel for kernel, _, _ in candidates])
    kernel, problem, chains = next(candidate for candidate in candidates if candidate[0] is best)
    return kernel if parted is None else with_deferred(kernel, parted, problem, chains)


def _shortest(kernels: Sequence[Kernel]) -> Kernel:
    """Return the kernel whose step has the shortest estimated time.

    If some kernels contain outlined functions, only these kernels are compared.
    """
    # A step that is long enough for outlined functions is limited by the instruction cache, not by latency.
    return min([kernel for kernel in kernels if kernel.outlined] or kernels, key=time)


def time(kernel: Kernel) -> tuple[float, int]:
    """Return the estimated time of a step, in units of an addition, and the number of operations of the step.

    If two kernels have equal times, the kernel with fewer operations is used.
    """
    nodes = walk(kernel.expressions())
    work = sum(CALL if n.op == "call" else int(n.op not in ("const", "sym", "neg")) for n in nodes)
    # The estimate is the sum of two lower bounds of the time: the length of the critical path, and the number
    # of operations divided by the throughput.
    return chain(kernel) + work / WIDTH, work
