"""Continuation in h: a step whose equations do not settle is reached through shorter ones.

First the solutions of earlier steps are forgotten: they may mislead where the motion changes. Then the step
is halved until its equations settle, and each solution is where those of a longer step begin. The factor from
one step to the next grows while that succeeds and falls where it does not. The solution so found is the one
that tends to the motion as h tends to zero; a long step may have others. A step of no length changes nothing.
"""

from __future__ import annotations

from codegen.ir.kernel import Start
from codegen.run.language import Array, Assign, Call, Function, If, Return, Statement, While
from codegen.run.plan import INPUTS, STEP, Plan
from codegen.run.statistics import no_failure
from codegen.run.terms import (
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    absent,
    all_finite,
    both,
    call,
    code,
    count,
    either,
    flag,
    fresh,
    negated,
    number,
    real,
    select,
    truth,
    whole,
)

CONTINUED = "continued"
"""The name of the function."""

LARGEST_FACTOR = 4.0
"""No step is longer than the one before by more."""


def retried(plan: Plan, state: Term, arguments: tuple[Term, ...]) -> list[Statement]:
    """Return the statement that continues a step where its equations have not settled, none without them."""
    if plan.start is None:
        return []
    failed = either(STATUS.equals(code(NOT_CONVERGED)), STATUS.equals(code(NOT_FINITE)))
    return [If(failed, (Call(CONTINUED, (state, *arguments), (STATUS,)),))]


def continued(plan: Plan, core: str) -> Function:
    """Return the function that makes a step, or substep, which ``core`` does not make at once."""
    return _Continuation(plan, core).function()


class _Continuation:
    """The function and its variables."""

    solved, part, factor = real("solved"), real("part"), real("factor")
    tries, done = count("tries"), flag("done")

    def __init__(self, plan: Plan, core: str) -> None:
        assert plan.start is not None
        self.plan, self.core, self.n = plan, core, len(plan.start.unknowns)
        self.guess, self.trial = real("known_solution", self.n), plan.state("trial")
        self.failure = Term("name", (), Kind.STATUS, "failure")

    def function(self) -> Function:
        """Return the whole."""
        plan, state = self.plan, self.plan.state()
        parameters = (state, *plan.moment(), *plan.parameters, *plan.sampled())
        parameters += (*plan.remembering(plan.memory), *plan.counted)
        nothing = select(all_finite(state), code(OK), code(NOT_FINITE))
        going_on = both(
            negated(self.done),
            self.tries < (Start.TRIES if plan.tries is None else plan.tries),
            self.factor > 1.0 + Start.SHORTEST,
        )
        body: tuple[Statement, ...] = (
            If(negated(either(STEP < 0.0, STEP > 0.0)), (Return(nothing),)),
            Array(self.guess, zero=True),
            Array(self.trial),
            Assign(self.solved, number(0.0)),
            Assign(self.part, number(1.0)),
            Assign(self.factor, number(2.0)),
            Assign(self.failure, code(NOT_CONVERGED)),
            Assign(self.done, truth(False)),
            Assign(self.tries, whole(0)),
            While(going_on, (*self.attempt(), *self.adapted())),
            If(negated(self.done), (Return(self.failure),)),
            Assign(state, self.trial),
            # The solutions before the last one are those of shorter steps, and no guide.
            Assign(plan.memory.field("known", Kind.COUNT), whole(1)),
            no_failure(plan),
            Return(code(OK)),
        )
        part = "part of a step" if plan.parts else "step"
        about = (
            f"Make a {part} whose equations do not settle: without the earlier solutions, which may mislead "
            "where the motion changes; then through shorter ones, whose solutions are continued in h."
        )
        return Function(CONTINUED, about, parameters, body, Kind.STATUS)

    def attempt(self) -> list[Statement]:
        """Return the statements that try one step from what is known."""
        plan, memory = self.plan, self.plan.memory
        rates = [memory.field(f"rate_{k}") for k in range(1, len(plan.kernel.loops) + 1)]
        from_guess: list[Statement] = [
            Assign(memory.field("known", Kind.COUNT), whole(1)),
            Assign(memory.field("guess", Kind.REAL, (self.n,)), self.guess),
            *(Assign(rate, number(1.0)) for rate in rates),
        ]
        arguments = (*plan.moment(h=self.part * STEP), *plan.parameters, *plan.sampled(INPUTS))
        arguments += (*plan.remembering(memory), *plan.counted)
        arguments += (absent(plan.error),) if plan.kernel.estimate is not None else ()
        return [
            Assign(self.trial, plan.state()),
            Assign(memory, fresh(memory)),
            If(self.solved > 0.0, tuple(from_guess)),
            Call(self.core, (self.trial, *arguments), (STATUS,)),
        ]

    def adapted(self) -> list[Statement]:
        """Return the statements that choose the next step, where the whole one is not done."""
        plan, factor, part, solved = self.plan, self.factor, self.part, self.solved
        assert plan.start is not None
        values = plan.memory.field("values", Kind.REAL, (2 * plan.start.depth, self.n))
        latest = values[plan.memory.field("place", Kind.COUNT)]
        succeeded = (Assign(self.guess, latest), Assign(solved, part), Assign(factor, factor * factor))
        failed = (
            Assign(self.failure, STATUS),
            Assign(factor, select(solved > 0.0, call("sqrt", factor), factor)),
        )
        shorter = (
            Assign(factor, select(factor < LARGEST_FACTOR, factor, LARGEST_FACTOR)),
            Assign(part, select(solved > 0.0, solved * factor, 0.5 * part)),
            Assign(part, select(part < 1.0, part, 1.0)),
        )
        return [
            Assign(self.done, both(STATUS.equals(code(OK)), part >= 1.0)),
            If(STATUS.equals(code(OK)), succeeded, failed),
            If(negated(self.done), shorter),
            Assign(self.tries, self.tries + 1),
        ]
