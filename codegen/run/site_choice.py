"""The solvers for the implicit equations of a step on a chain or lattice."""

from __future__ import annotations

from codegen.errors import MethodError
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON, Kernel
from codegen.kernel.schedule import METHODS
from codegen.run.site_solver import loop_of
from codegen.run.solver_choice import Choice


def site_choices(kernel: Kernel, asked: str, name: str) -> tuple[Choice, ...]:
    """Return the solver for each block of implicit equations in ``kernel``.

    ``asked`` is the solver that the user requested. Error messages contain ``name``, the name of the problem.
    Newton's method (``newton``) is not implemented for a step on a chain or lattice. If ``asked`` is
    ``newton`` and the step has implicit equations, MethodError is raised.
    """
    step = kernel.sites
    assert step is not None
    # An explicit method has no equations to solve, so the requested solver does not matter.
    if step.blocks and asked == NEWTON:
        raise MethodError(
            f"{METHODS[asked]} is not possible for a chain or lattice",
            where=name,
            expected=f"the solver {FIXED_POINT}, or {SIMPLIFIED_NEWTON} for a chain",
        )
    # The number of sites is known only at run time, so the unknowns of all sites cannot be counted.
    reason = "only the unknowns of one site are counted"
    return tuple(
        Choice(block.label, len(step.sweeps[block.last].unknowns), loop_of(block).solver, reason)
        for block in step.blocks
    )
