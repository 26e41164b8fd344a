"""The solvers of implicit equations on a lattice."""

from __future__ import annotations

from codegen.errors import MethodError
from codegen.ir.kernel import FIXED_POINT, Kernel
from codegen.kernel.schedule import METHODS
from codegen.run.solver_choice import AUTO, Choice


def site_choices(kernel: Kernel, asked: str, name: str) -> tuple[Choice, ...]:
    """Return the choice of a solver for each block of a lattice; ``name`` is the name of the scene.

    MethodError is raised for an implicit method if another solver than fixed-point iteration is requested.
    """
    step = kernel.sites
    assert step is not None
    if step.blocks and asked not in (AUTO, FIXED_POINT):
        raise MethodError(
            f"{METHODS[asked]} for a chain or lattice",
            where=name,
            expected=METHODS[FIXED_POINT],
            hint=f"use --solver {FIXED_POINT}",
        )
    reason = "the numbers of unknowns are those of one site"
    return tuple(
        Choice(block.label, len(step.sweeps[block.last].unknowns), FIXED_POINT, reason)
        for block in step.blocks
    )
