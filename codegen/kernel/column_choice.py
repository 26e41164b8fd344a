"""The choice among several implementations (variants) of a Lie group. The variants update a rotation matrix
in different ways.

One variant rotates all three columns. Each other variant rotates two columns and computes the third by a
cross product. All variants are compiled. The kernel with the smallest estimated execution time is used.
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
"""The cost of a function call, relative to an arithmetic operation.

The number was chosen with ``benchmarks/emitted.py``. The value 20 gives the same emitted files as 10. The
value 5 changes the code of five explicit methods (``orderconds regenerate --check``).
"""

WIDTH = 8
"""The assumed throughput of a processor: the number of independent arithmetic operations per time unit.

The time unit is the latency of one addition.

The number was chosen with ``benchmarks/emitted.py``. With the value 16, the emitted files are the same. With
the value 4, the code of two methods changes (``orderconds regenerate --check``).
"""


def fastest(program: Program, scene: Problem) -> Kernel:
    """Return the kernel of ``program`` for the fastest variant (implementation) of the group.

    An explicit program is compiled with every variant if it contains exact flows, or if ``scene.group`` is a
    group T*G. All other programs are compiled only with ``scene.group``.
    """
    if not all(isinstance(statement, Assign) for statement in program.body):
        return to_kernel(program, scene)
    flows = any(isinstance(assign.operation, FLOWS) for assign in program.assigns())
    # The variants of ``scene.group`` are different implementations of this group. If the program contains no
    # flows and ``scene.group`` is not a group T*G, all variants give the same kernel.
    if not flows and scene.group.offers(CotangentBundle) is None:
        return _shortest([to_kernel(program, scene, chains=chains) for chains in (AS_WRITTEN, COMBINED)])
    # ``part`` combines flows of different steps. For example, one flow after the last step (a deferred flow)
    # replaces a flow of each step. If the scene has run-time inputs, no flows are combined, because the
    # inputs can change in each step.
    parted = None if scene.inputs else part(program, scene)
    # The cost of the deferred flows is neglected, because they are applied only once for many steps.
    core = program if parted is None else parted.core
    # The estimated times of complete steps are compared. A sum of the times of single operations would be
    # too large, because operations can share subexpressions.
    candidates: list[tuple[Kernel, Problem, int]] = []
    # Each variant is compiled twice, with and without shortening of the critical path.
    for group in scene.group.variants():
        problem = replace(scene, group=group)
        for chains in (ORDERED, SHORTENED):
            candidates.append((to_kernel(core, problem, chains=chains), problem, chains))
    # Two candidates may have equal kernels, so ``is`` identifies the chosen candidate.
    best = _shortest([kernel for kernel, _, _ in candidates])
    kernel, problem, chains = next(candidate for candidate in candidates if candidate[0] is best)
    return kernel if parted is None else with_deferred(kernel, parted, problem, chains)


def _shortest(kernels: Sequence[Kernel]) -> Kernel:
    """Return the kernel whose step has the shortest estimated time.

    If some of the kernels contain outlined functions, only these kernels are compared. Otherwise, all kernels
    are compared.
    """
    # The instruction cache limits the speed of a long step, so the shorter code with outlined functions is
    # preferred.
    return min([kernel for kernel in kernels if kernel.outlined] or kernels, key=time)


def time(kernel: Kernel) -> tuple[float, int]:
    """Return the estimated time of a step and its number of operations. The unit of time is one addition.

    A function call counts as :data:`CALL` operations.
    """
    nodes = walk(kernel.expressions())
    # Changes of sign are not counted: they are usually combined with additions.
    work = sum(CALL if n.op == "call" else int(n.op not in ("const", "sym", "neg")) for n in nodes)
    # The estimated time of a step is the length of its critical path, plus the number of its operations
    # divided by the throughput.
    return chain(kernel) + work / WIDTH, work
