"""Decide whether the step size or the state is the cause of a failed step.

After a failed step, the emitted function ``cause`` tries a step of size zero from the state before the failed
step. If the step of size zero has a finite result, the failed step was too long, and the status is TOO_FAR.
Otherwise the vector field is not finite at this state, and the status remains NOT_FINITE.

Steps with run-time inputs or a warm start do not call this function.
"""

from __future__ import annotations

from codegen.run.language import Array, Assign, Call, Function, If, Return, Statement
from codegen.run.plan import STEP, TIME, Plan
from codegen.run.terms import NOT_FINITE, OK, STATUS, TOO_FAR, Kind, Term, absent, code, select

CAUSE = "cause"
"""The name of the emitted function that finds the cause of a failed step."""


def is_searched(plan: Plan) -> bool:
    """Return True if the emitted code contains the function that finds the cause of a failed step."""
    # The function tries a step of size zero. If this step succeeds, the size of the failed step is reported
    # as the cause. If a run-time input is NaN at t + h/2 but not at t, the step of size zero succeeds,
    # because it reads the inputs only at t. Then the step size would wrongly be reported as the cause.
    # Therefore code with run-time inputs does not contain the function. Code with a warm start does not need
    # the function, because :mod:`codegen.run.continuation` finds the cause.
    return plan.start is None and not plan.kernel.inputs


def cause(plan: Plan, core: str, more: tuple[Term, ...]) -> Function:
    """Return the emitted function that finds the cause of a failed step.

    The arguments of the step function ``core`` are the state, the time, the step size, and ``more``. The time
    is omitted if the step does not depend on the time.
    """
    state, same = plan.state(), plan.state("same")
    parameters = (state, *plan.moment(), *plan.parameters)
    # The new memory is empty: it contains no data from earlier steps.
    memory = [Array(plan.memories, zero=True)] if plan.remembers else []
    body: tuple[Statement, ...] = (
        Array(same),
        Assign(same, state),
        *memory,
        # The step size is passed as 0 times h. If the constant 0 were passed, a compiler might compile a
        # second copy of the step function for the step size 0.
        Call(core, (same, *plan.moment(h=0.0 * STEP), *more), (STATUS,)),
        Return(select(STATUS.equals(code(OK)), code(TOO_FAR), code(NOT_FINITE))),
    )
    about = (
        "Find the cause of a failed step. If a step of size zero succeeds, the cause is the step size. "
        "Otherwise the cause is the state."
    )
    return Function(CAUSE, about, parameters, body, Kind.STATUS)


def step_arguments(plan: Plan) -> tuple[Term, ...]:
    """Return the arguments that the function ``cause`` passes to the step function.

    The state, the time and the step size are not included.
    """
    # ``cause`` makes a step of size zero as a test. The statistics of the caller do not count this step.
    counted = tuple(absent(x) for x in plan.counted)
    # If a step consists of substeps, its function has no argument for an error estimate.
    error = (absent(plan.error),) if plan.kernel.estimate is not None and not plan.parts else ()
    return (*plan.parameters, *plan.remembering(plan.memories), *counted, *error)


def searched(plan: Plan, state: Term, t: Term = TIME, h: Term = STEP) -> list[Statement]:
    """Return a list with one emitted statement: if the status is NOT_FINITE, call the function ``cause``.

    If the emitted code has no function ``cause``, the list is empty. The failed step has the size ``h`` and
    begins at the time ``t`` and at ``state``.
    """
    if not is_searched(plan):
        return []
    call = Call(CAUSE, (state, *plan.moment(t, h), *plan.parameters), (STATUS,))
    return [If(STATUS.equals(code(NOT_FINITE)), (call,))]
