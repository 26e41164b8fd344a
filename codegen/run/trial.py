"""Trials of solvers: count the sweeps and the Newton matrices in a few steps from the initial state.

Python executes the statements of the emitted code (:mod:`codegen.run.execute`). Therefore the counts are
those of the emitted code.
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
    contains the average number of Newton matrices in a step. ``most`` is the largest number of sweeps over
    one block in one step or substep. If all steps succeeded, ``converged`` is True.
    """

    steps: int
    h: float
    sweeps: tuple[float, ...]
    matrices: tuple[float, ...]
    most: int
    converged: bool


class Trials:
    """Counts the sweeps, and the evaluations of Newton's matrix, in test runs of one kernel.

    If a step with a warm start fails, it is repeated once, without the solutions of earlier steps. If
    ``continuation`` is True and the step fails again, it is repeated by continuation in h
    (:mod:`codegen.run.continuation`).
    """

    def __init__(
        self, kernel: Kernel, scene: Problem, initial: tuple[float, ...], continuation: bool = False
    ) -> None:
        # Error estimates, derivatives and integrations to an end time do not change the number of sweeps, so
        # a trial omits them.
        plain = replace(kernel, estimate=None, vary=None, observed=None)
        # Trials use doubles, so the choice of the solver does not depend on the precision of the emitted
        # code.
        self.plan = Plan(plain, DOUBLE, tries=None if continuation else 1)
        # ``EmittedFloats`` rounds Stumpff functions as the emitted code does. A different rounding could
        # change the number of sweeps.
        self.machine = Machine(unit_of(self.plan), EmittedFloats(chain=chain(kernel)))
        self.initial, self.span = initial, scene.span
        self.values = [float(scene.parameters[p.text]) for p in self.plan.parameters]

    def run(self, steps: int, longer: int = 1) -> Trial:
        """Make ``steps`` steps from the initial state and return the results.

        The step size is ``longer * T / PARTS``, where T is the length of the time span of the scene.
        """
        first, last = self.span
        number, loops = len(self.plan.kernel.inputs), self.plan.kernel.loops
        counts, state = self.machine.record(STATISTICS), list(self.initial)
        time = [float(first)] if self.plan.time else []
        # The user chooses the run-time inputs later. In a trial they are zero.
        signals = [lambda t: (0.0,) * number] if number else []
        # The times are fractions, so only the conversion of the quotient to a double causes a rounding error.
        h = float(longer * (last - first) / PARTS)
        # No trajectory is stored.
        arguments = [state, *time, h, steps, *self.values, *signals, None, 0, counts, None]
        status = self.machine.call("run", *arguments)
        # The matrices of all blocks with Newton's method are counted together. Each of these blocks gets an
        # equal share of ``counts.matrices``.
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
