"""Makes runs over the time span of a scene with the interpreter, without compiled code.

Runs with equal steps solve implicit equations by fixed-point iteration. Newton's method needs difference
quotients, and would therefore be slow in the interpreter.

Runs with step-size control use Newton's method, because fixed-point iteration does not converge for the long
steps of a stiff scene.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import flatten, interpret
from codegen.ir.program import EMBEDDED, Program, Solve
from codegen.ir.values import Var
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.runner import split_state
from codegen.run.step_control import FIRST, LEAST, MOST, SAFETY
from codegen.scene.problem import TIME, Problem

MOST_SWEEPS, MOST_NEWTON = 40, 15
"""The largest numbers of fixed-point iterations and of Newton iterations for a system of implicit equations.
"""

SETTLED = 1e-9
"""The iteration for implicit equations ends when the relative change of the unknowns is at most SETTLED."""


class CountingDomain(FloatDomain):
    """Double precision arithmetic, with a counter of sweeps (iterations for implicit equations)."""

    def __init__(self, h: float) -> None:
        super().__init__(h)
        # The counter is a list, because copies of this object must share it.
        self.swept = [0]

    def settled(self, old: Sequence[float], new: Sequence[float], previous: Scalar) -> tuple[bool, float]:
        """Count one sweep. Return the pair (converged, change).

        The change is the largest absolute difference of the unknowns before (``old``) and after (``new``)
        this sweep.
        """
        self.swept[0] += 1
        done, change = super().settled(old, new, previous)
        return done or change <= SETTLED * max(map(abs, old), default=0.0), change


class NewtonDomain(CountingDomain):
    """Double precision arithmetic for runs that solve implicit equations by Newton's method.

    ``patience`` is the number of fixed-point iterations before Newton's method begins.
    """

    patience = 0


def run(program: Program, problem: Problem, steps: int, end: float = math.inf) -> tuple[Vector, float]:
    """Integrate over the time span in equal steps. Return the pair (final state, sweeps).

    ``steps`` is the number of steps. A sweep is one iteration for a system of implicit equations. The result
    ``sweeps`` is a prediction of the mean number of sweeps that emitted code needs for one system in one
    step. ArithmeticError is raised if a state is not finite, or if the process has used more than ``end``
    seconds of CPU time.
    """
    first, last = problem.span
    domain = CountingDomain(float((last - first) / steps))
    state = problem.initial(domain)
    solutions: dict[Var, Scalar] = {}
    for k in range(steps):
        inputs = _inputs(program, problem, state, float(first) + k * domain.h)
        ends = interpret(
            program, problem, domain, inputs, limit=MOST_SWEEPS, newton=False, solutions=solutions
        )
        state = tuple(x for block in problem.state for x in flatten(block.kind, ends[block.name]))
        if not all(map(math.isfinite, state)):
            raise ArithmeticError("the state of an interpreted run is not finite")
        if time.process_time() > end:
            raise ArithmeticError("the interpreted run takes too long")
    # The iterations above end at an accuracy of 9 digits (``SETTLED``). Emitted code iterates to about 16
    # digits, so it needs about twice as many sweeps.
    return state, 2 * domain.swept[0] / steps / _blocks(program)


def controlled_run(
    program: Program, problem: Problem, order: int, tolerance: float, end: float = math.inf
) -> tuple[Vector, int, float]:
    """Integrate over the time span with step-size control. Return three values.

    - the final state,
    - the total number of attempted steps (accepted steps plus rejected steps),
    - the mean number of sweeps (iterations) for one system of implicit equations in one step.

    ``program`` must compute an embedded solution. The error estimate is proportional to the step size to the
    power ``order``. ``tolerance`` is both the relative and the absolute tolerance. ArithmeticError is raised
    if steps become too short, or if the process has used more than ``end`` seconds of CPU time.
    """
    now, last = map(float, problem.span)
    domain = NewtonDomain((last - now) / FIRST)
    state, tried, most = problem.initial(domain), 0, FIRST
    while now < last:
        if time.process_time() > end:
            raise ArithmeticError("the interpreted run takes too long")
        length = min(domain.h, last - now)
        if not now + length > now:
            raise ArithmeticError("the steps of an interpreted run become too short")
        domain.h, tried = length, tried + 1
        try:
            inputs = _inputs(program, problem, state, now)
            ends = interpret(program, problem, domain, inputs, limit=MOST_NEWTON)
            new = tuple(x for block in problem.state for x in flatten(block.kind, ends[block.name]))
            norm = weighted(state, new, ends[EMBEDDED], tolerance)
        except (ArithmeticError, ValueError):
            # An infinite error norm causes a new attempt with a shorter step.
            norm = math.inf
        if norm <= 1.0:
            state, now = new, last if length >= last - now else now + length
        else:
            most = SAFETY
        factor = SAFETY * math.pow(norm, -1 / order) if norm > 0.0 else most
        domain.h = length * max(LEAST, min(most, factor))
        # Directly after a rejected step, the step size must not increase.
        most = MOST if norm <= 1.0 else 1.0
    return state, tried, domain.swept[0] / tried / _blocks(program)


def weighted(
    before: Sequence[float], after: Sequence[float], lower: Sequence[float], tolerance: float
) -> float:
    """Return the weighted norm of the error estimate of a step.

    ``before`` and ``after`` are the states before and after the step, and ``lower`` is the embedded solution.
    The norm is the root mean square of (``after`` - ``lower``)/(``tolerance`` (1 + m)) over all components.
    Here m is the larger of the absolute values of the component in ``before`` and in ``after``. If ``after``
    or ``lower`` is not finite, the norm is infinite.

    >>> round(weighted([1.0, 0.0], [1.0, 0.0], [1.0 + 2e-3, 1e-3], 1e-3), 9)
    1.0
    """
    total = 0.0
    for old, new, other in zip(before, after, lower, strict=True):
        total += ((new - other) / (tolerance + tolerance * max(abs(old), abs(new)))) ** 2
    return math.sqrt(total / len(after)) if math.isfinite(total) else math.inf


def _inputs(program: Program, problem: Problem, state: Vector, now: float) -> dict[str, Scalar]:
    values: dict[str, Scalar] = {TIME: now, **split_state(problem, state)}
    return {v.name: values[v.name] for v in program.inputs}


def _blocks(program: Program) -> int:
    """Return the number of systems of implicit equations in a step, or 1 if there are none."""
    return max(1, sum(isinstance(s, Solve) for s in program.body) * max(1, len(program.substeps)))
