"""Find out why the result of a step is not finite. The cause is the step size or the state.

A step may be too long: an angle may become so large that it has no correct digit, a formula may have a pole,
or a number may overflow. A step of size zero then has a finite result, and the status is TOO_FAR. If the step
of size zero also fails, the vector field is not finite at this state, and the status remains NOT_FINITE.

After a failure, the emitted function ``cause`` tries the step of size zero. Implicit steps with a warm start
use the continuation instead (:mod:`codegen.run.continuation`).
"""

from __future__ import annotations

from codegen.run.language import Array, Assign, Call, Function, If, Return, Statement
from codegen.run.plan import STEP, TIME, Plan
from codegen.run.terms import NOT_FINITE, OK, STATUS, TOO_FAR, Kind, Term, absent, code, select

CAUSE = "cause"
"""The name of the emitted function that finds the cause of a failed step."""


def is_searched(plan: Plan) -> bool:
    """Return True if the emitted code contains the function that finds the cause of a failed step."""
    # Steps with a warm start find the cause by continuation. With run-time inputs, a step of size zero reads
    # the inputs at its initial time only, but the failed step also read them at later times. The success of a
    # step of size zero would therefore not show that h is too large.
    return plan.start is None and not plan.kernel.inputs


def cause(plan: Plan, core: str, more: tuple[Term, ...]) -> Function:
    """Return the emitted function that finds the cause of a failed step.

    ``core`` is the name of the function that makes a step. The arguments of ``core`` are the state, the time
    (if the step depends on the time), the step size, and the terms ``more``.
    """
    state, same = plan.state(), plan.state("same")
    parameters = (state, *plan.moment(), *plan.parameters)
    # The test uses a new, empty memory, so it does not depend on data from earlier steps.
    memory = [Array(plan.memories, zero=True)] if plan.remembers else []
    body: tuple[Statement, ...] = (
        Array(same),
        Assign(same, state),
        *memory,
        # The step size zero is written as ``0 * h``. For the constant 0, compilers would make a second copy
        # of ``core``.
        Call(core, (same, *plan.moment(h=0.0 * STEP), *more), (STATUS,)),
        Return(select(STATUS.equals(code(OK)), code(TOO_FAR), code(NOT_FINITE))),
    )
    about = "Find the cause of a failed step: it was too long if a step of size zero has a finite result."
    return Function(CAUSE, about, parameters, body, Kind.STATUS)


def step_arguments(plan: Plan) -> tuple[Term, ...]:
    """Return the arguments that follow the step size in the call of the function that makes a step."""
    # The step of size zero is only a test, so the statistics of the caller do not count it.
    counted = tuple(absent(x) for x in plan.counted)
    # A step that is composed of substeps has no argument for an error estimate.
    error = (absent(plan.error),) if plan.kernel.estimate is not None and not plan.parts else ()
    return (*plan.parameters, *plan.remembering(plan.memories), *counted, *error)


def searched(plan: Plan, state: Term, t: Term = TIME, h: Term = STEP) -> list[Statement]:
    """Return the statement that replaces the status NOT_FINITE by the cause of the failure.

    The list is empty if the unit has no function for the cause. The failed step has the size ``h`` and begins
    at the time ``t`` and at ``state``.
    """
    if not is_searched(plan):
        return []
    call = Call(CAUSE, (state, *plan.moment(t, h), *plan.parameters), (STATUS,))
    return [If(STATUS.equals(code(NOT_FINITE)), (call,))]
