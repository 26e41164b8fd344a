"""Continuation in h: find the solution of a failed step from the solutions of shorter steps.

If a step of size h fails, the emitted function first tries the same step with another initial guess. This
guess does not use the solutions of earlier steps. If this attempt fails, too, the function tries shorter
steps: it halves the step size until an attempt succeeds. Each solution is then the initial guess for a longer
step, until a step of size h succeeds.

The equations of a step may have several solutions. For small h, one of them tends to the exact motion. The
first successful attempt may find another solution, and the continuation then follows this other solution.
"""

from __future__ import annotations

from codegen.ir.kernel import Start
from codegen.run.language import Array, Assign, Call, Function, If, Return, Statement, While
from codegen.run.plan import INPUTS, STEP, Plan
from codegen.run.statistics import no_failure
from codegen.run.terms import (
    BAD_STEP,
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    STATUS,
    TOO_FAR,
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
"""The name of the emitted function that solves a failed step by continuation in h."""

LARGEST_FACTOR = 4.0
"""After a success, the step size is increased by at most this factor."""


def retried(plan: Plan, state: Term, arguments: tuple[Term, ...]) -> list[Statement]:
    """Return the statements that call the function CONTINUED after a failed step.

    CONTINUED repeats the step with other initial guesses. Only steps with a warm start read their initial
    guess from the argument ``memory``, so the list is empty for all other steps.
    """
    # Steps without a warm start store no solutions.
    if plan.start is None:
        return []
    # The status BAD_STEP means that h is infinite or a NaN. Such a step is not repeated.
    failed = both(STATUS.differs(code(OK)), STATUS.differs(code(BAD_STEP)))
    return [If(failed, (Call(CONTINUED, (state, *arguments), (STATUS,)),))]


def continued(plan: Plan, core: str) -> Function:
    """Return the function that repeats a failed step or substep by continuation in h.

    ``core`` is the name of the function that makes one step or substep.
    """
    return _Continuation(plan, core).function()


class _Continuation:
    """Builds the emitted function that solves a failed step by continuation in h.

    The class attributes are variables of the emitted function.
    """

    # The step size of an attempt is the fraction ``part`` of h. ``solved`` is the largest successful
    # fraction. After the first success, the next fraction is ``factor`` times ``solved``.
    solved, part, factor = real("solved"), real("part"), real("factor")
    tries, done = count("tries"), flag("done")

    def __init__(self, plan: Plan, core: str) -> None:
        assert plan.start is not None
        self.plan, self.core, self.n = plan, core, len(plan.start.unknowns)
        self.guess, self.trial = real("known_solution", self.n), plan.state("trial")
        # Every attempt overwrites STATUS, so ``failure`` stores the status of the last failed attempt.
        self.failure = Term("name", (), Kind.STATUS, "failure")

    def function(self) -> Function:
        """Return the emitted function that solves a failed step by continuation in h."""
        plan, state = self.plan, self.plan.state()
        parameters = (state, *plan.moment(), *plan.parameters, *plan.sampled())
        # The solution is stored in ``memory`` as the initial guess of the next step.
        parameters += (*plan.remembering(plan.memory), *plan.counted)
        # A step of size zero succeeds if the state is finite.
        nothing = select(all_finite(state), code(OK), code(NOT_FINITE))
        # After a success, the next step size is ``factor`` times the largest successful step size. The loop
        # ends if ``factor`` is near 1, because the next step size would hardly be larger.
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
            # ``failure`` is read only after a failed attempt, and each failed attempt assigns ``failure``.
            # The initial value here only prevents a warning of C compilers.
            Assign(self.failure, code(NOT_CONVERGED)),
            Assign(self.done, truth(False)),
            Assign(self.tries, whole(0)),
            While(going_on, (*self.attempt(), *self.adapted())),
            If(negated(self.done), (Return(self.cause()),)),
            # The state is changed only here, after an attempt with the full step size h has succeeded.
            Assign(state, self.trial),
            # The number of stored solutions (``known``) becomes 1. The initial guess of the next step is the
            # solution of this step.
            Assign(plan.memory.field("known", Kind.COUNT), whole(1)),
            no_failure(plan),
            Return(code(OK)),
        )
        part = "substep" if plan.parts else "step"
        # If a step consists of substeps, the function repeats only the substep that failed.
        about = (
            f"Repeat a failed {part} with a new initial guess. If the {part} fails again, the step size is "
            f"halved until the {part} succeeds. Each solution is then the initial guess for a longer {part} "
            "(continuation in h)."
        )
        return Function(CONTINUED, about, parameters, body, Kind.STATUS)

    def cause(self) -> Term:
        """Return the status that is reported for the failed step."""
        # TOO_FAR means that the step size is the cause of the failure. With run-time inputs, the cause may
        # also be an input that is NaN at a time near the end of the step. A shorter step may end before this
        # time and succeed. Therefore the status of the last failed attempt is returned in place of TOO_FAR.
        if self.plan.kernel.inputs:
            return self.failure
        too_far = both(self.solved > 0.0, self.failure.equals(code(NOT_FINITE)))
        return select(too_far, code(TOO_FAR), self.failure)

    def attempt(self) -> list[Statement]:
        """Return the statements that try one step.

        If an earlier attempt succeeded, the initial guess is the solution of the last successful attempt.
        """
        plan, memory = self.plan, self.plan.memory
        rates = [memory.field(f"rate_{k}") for k in range(1, len(plan.kernel.loops) + 1)]
        # The convergence rates of the iterations are unknown for this step size. Each rate gets the default
        # value 1.
        from_guess: list[Statement] = [
            Assign(memory.field("known", Kind.COUNT), whole(1)),
            Assign(memory.field("guess", Kind.REAL, (self.n,)), self.guess),
            *(Assign(rate, number(1.0)) for rate in rates),
        ]
        arguments = (*plan.moment(h=self.part * STEP), *plan.parameters, *plan.sampled(INPUTS))
        arguments += (*plan.remembering(memory), *plan.counted)
        # Only runs without step-size control use the continuation. Such runs need no error estimate, so the
        # argument for the estimate is absent.
        arguments += (absent(plan.error),) if plan.kernel.estimate is not None else ()
        return [
            # Each attempt starts at the original state and time.
            Assign(self.trial, plan.state()),
            # The memory is cleared, because its solutions and matrices belong to earlier steps or attempts.
            Assign(memory, fresh(memory)),
            If(self.solved > 0.0, tuple(from_guess)),
            Call(self.core, (self.trial, *arguments), (STATUS,)),
        ]

    def adapted(self) -> list[Statement]:
        """Return the statements that follow each attempt.

        If the full step succeeded, these statements end the loop. Otherwise, they choose the next step size.
        """
        plan, factor, part, solved = self.plan, self.factor, self.part, self.solved
        assert plan.start is not None
        values = plan.memory.field("values", Kind.REAL, (2 * plan.start.depth, self.n))
        # After a successful attempt, ``latest`` is its solution.
        latest = values[plan.memory.field("place", Kind.COUNT)]
        # First, ``factor`` is changed. A success squares ``factor``. A failure after the first success
        # replaces ``factor`` by its square root. A failure before the first success does not change
        # ``factor``. Then the next step size is computed. From the first success on, the next step size is
        # ``factor`` times the largest successful step size, but at most h.
        succeeded = (Assign(self.guess, latest), Assign(solved, part), Assign(factor, factor * factor))
        failed = (
            Assign(self.failure, STATUS),
            Assign(factor, select(solved > 0.0, call("sqrt", factor), factor)),
        )
        shorter = (
            Assign(factor, select(factor < LARGEST_FACTOR, factor, LARGEST_FACTOR)),
            # Before the first success, ``solved`` is 0, and each failure halves ``part``.
            Assign(part, select(solved > 0.0, solved * factor, 0.5 * part)),
            # The next step size ``part`` * h must not exceed h.
            Assign(part, select(part < 1.0, part, 1.0)),
        )
        return [
            Assign(self.done, both(STATUS.equals(code(OK)), part >= 1.0)),
            If(STATUS.equals(code(OK)), succeeded, failed),
            If(negated(self.done), shorter),
            Assign(self.tries, self.tries + 1),
        ]
