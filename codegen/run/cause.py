"""The cause of a step whose result is not finite: the state, or the length of the step.

A step may turn by an angle of which no digit is known, meet a pole of its formulas, or overflow. Then a step
of size zero from the same state has a finite result, as has every step that is short enough, and the status
is TOO_FAR. If the step of size zero fails as well, the field is not finite at this state, and the status
remains NOT_FINITE. The test is made after a failure only, so steps that succeed do not pay for it.

Implicit steps with a warm start have no function of this kind: their continuation tries shorter steps in any
case (:mod:`codegen.run.continuation`).
"""

from __future__ import annotations

from codegen.run.language import Array, Assign, Call, Function, If, Return, Statement
from codegen.run.plan import STEP, TIME, Plan
from codegen.run.terms import NOT_FINITE, OK, STATUS, TOO_FAR, Kind, Term, absent, code, select

CAUSE = "cause"
"""The name of the function."""


def is_searched(plan: Plan) -> bool:
    """Return True if the unit has the function."""
    # The values of run-time inputs may be the cause, and a shorter step samples other values.
    return plan.start is None and not plan.kernel.inputs


def cause(plan: Plan, core: str, more: tuple[Term, ...]) -> Function:
    """Return the function.

    ``core`` is the name of the function that makes a step. Its arguments are the state, the time if it is
    read, the step size, and ``more``.
    """
    state, same = plan.state(), plan.state("same")
    parameters = (state, *plan.moment(), *plan.parameters)
    memory = [Array(plan.memories, zero=True)] if plan.remembers else []
    body: tuple[Statement, ...] = (
        Array(same),
        Assign(same, state),
        *memory,
        # A product instead of a constant, because compilers copy a large function for a constant argument.
        Call(core, (same, *plan.moment(h=0.0 * STEP), *more), (STATUS,)),
        Return(select(STATUS.equals(code(OK)), code(TOO_FAR), code(NOT_FINITE))),
    )
    about = "Return the cause of a step without a finite result: does a step of size zero have one?"
    return Function(CAUSE, about, parameters, body, Kind.STATUS)


def step_arguments(plan: Plan) -> tuple[Term, ...]:
    """Return the arguments of a step after its size, without statistics or an error estimate."""
    # The caller's statistics count the steps of the integration only.
    counted = tuple(absent(x) for x in plan.counted)
    error = (absent(plan.error),) if plan.kernel.estimate is not None and not plan.parts else ()
    return (*plan.parameters, *plan.remembering(plan.memories), *counted, *error)


def searched(plan: Plan, state: Term, t: Term = TIME) -> list[Statement]:
    """Return the statement that replaces NOT_FINITE by the cause; none without the function.

    ``state`` is the state before the failed step, which begins at the time ``t``.
    """
    if not is_searched(plan):
        return []
    call = Call(CAUSE, (state, *plan.moment(t), *plan.parameters), (STATUS,))
    return [If(STATUS.equals(code(NOT_FINITE)), (call,))]
