"""Trials of solvers: a kernel makes a few steps from the initial state, and sweeps and matrices are counted.

A trial runs inside Python. The executor (:mod:`codegen.run.execute`) executes the same statements that are
translated to C, so a trial needs the same numbers of sweeps and matrices as the emitted code.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from codegen.ir.angle_depth import chain
from codegen.ir.kernel import NEWTON, SIMPLIFIED_NEWTON, Kernel
from codegen.ir.precision import DOUBLE
from codegen.run.execute import Machine
from codegen.run.floats import EmittedFloats
from codegen.run.plan import STATISTICS, Plan
from codegen.run.terms import OK, STATUSES
from codegen.run.unit import unit_of
from codegen.scene.problem import Problem

PARTS = 100
"""The number of steps into which the example in the emitted code divides the time span of the problem."""


@dataclass(frozen=True)
class Trial:
    """The results of a trial that makes ``steps`` steps of size ``h``.

    For each block of equations, ``sweeps`` contains the average number of sweeps in a step, and ``matrices``
    contains the average number of computed matrices in a step. ``most`` is the largest number of sweeps that
    one block needed in one step or substep. ``converged`` is True if all steps succeeded.
    """

    steps: int
    h: float
    sweeps: tuple[float, ...]
    matrices: tuple[float, ...]
    most: int
    converged: bool


class Trials:
    """Makes the trials of one kernel.

    If the iterations of a step do not converge, the step is repeated once, with an initial guess that does
    not use earlier steps. If the repeated step fails too and ``continuation`` is True, the solution is
    computed by continuation in h from shorter steps, as in the emitted code.
    """

    def __init__(
        self, kernel: Kernel, scene: Problem, initial: tuple[float, ...], continuation: bool = False
    ) -> None:
        # Error estimates, derivatives and runs to an end time are removed. They would make the trial slower
        # and do not change the number of sweeps.
        plain = replace(kernel, estimate=None, vary=None, observed=None)
        # Trials always compute in doubles, because the choice of a solver should not depend on the precision
        # of the emitted code.
        self.plan = Plan(plain, DOUBLE, tries=None if continuation else 1)
        # Stumpff functions are rounded as in emitted code, because a difference in the last bit can cause one
        # more sweep.
        self.machine = Machine(unit_of(self.plan), EmittedFloats(chain=chain(kernel)))
        self.initial, self.span = initial, scene.span
        self.values = [float(scene.parameters[p.text]) for p in self.plan.parameters]

    def run(self, steps: int, longer: int = 1) -> Trial:
        """Make ``steps`` steps and return the counts of their sweeps and matrices.

        The step size is ``longer`` times 1/PARTS of the time span of the problem. The example in the emitted
        code uses this step size with ``longer`` = 1.
        """
        first, last = self.span
        number, loops = len(self.plan.kernel.inputs), self.plan.kernel.loops
        counts, state = self.machine.record(STATISTICS), list(self.initial)
        time = [float(first)] if self.plan.time else []
        # The run-time inputs of the user are not known, so they are zero in a trial.
        signals = [lambda t: (0.0,) * number] if number else []
        # The step size is computed with exact rationals and rounded once, as in the emitted example.
        h = float(longer * (last - first) / PARTS)
        # No trajectory is stored, because only the counts are needed.
        arguments = [state, *time, h, steps, *self.values, *signals, None, 0, counts, None]
        status = self.machine.call("run", *arguments)
        # The record contains the total number of matrices of all blocks with Newton's method. Each of these
        # blocks is assigned the average.
        newton = [loop.solver for loop in loops].count(NEWTON)
        of_solver = {
            NEWTON: counts.matrices / steps / newton if newton else 0.0,
            SIMPLIFIED_NEWTON: float(max(1, len(self.plan.kernel.substeps))),
        }
        return Trial(
            steps,
            h,
            tuple(n / steps for n in counts.sweeps),
            tuple(of_solver.get(loop.solver, 0.0) for loop in loops),
            counts.most,
            status == STATUSES.index(OK),
        )
