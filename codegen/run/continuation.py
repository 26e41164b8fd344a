"""Continuation in h: if the equations of a step do not converge, follow the solution from shorter steps.

The first attempt repeats the step without the solutions of earlier steps, which are bad initial guesses if
the motion has changed. Then the step is halved until its equations converge. From there on, each solution is
the initial guess for a longer step. The ratio of two consecutive step sizes grows on success and shrinks on
failure.

The equations of a long step may have several solutions. The result is on the branch that tends to the exact
motion as h tends to zero.
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
"""The name of the function that repeats a failed step."""

LARGEST_FACTOR = 4.0
"""The largest ratio of two consecutive step sizes."""


def retried(plan: Plan, state: Term, arguments: tuple[Term, ...]) -> list[Statement]:
    """Return the statement that calls the continuation if a step fails.

    Without a warm start the list is empty.
    """
    # Continuation begins each step at the solution of a shorter step, so it needs a memory for solutions.
    if plan.start is None:
        return []
    # The iteration may also overflow, or find a singular matrix, so the step is repeated after every failure
    # except BAD_STEP. A step size that is not finite would fail in every attempt.
    failed = both(STATUS.differs(code(OK)), STATUS.differs(code(BAD_STEP)))
    return [If(failed, (Call(CONTINUED, (state, *arguments), (STATUS,)),))]


def continued(plan: Plan, core: str) -> Function:
    """Return the function that repeats a failed step or substep by continuation in h.

    ``core`` is the name of the function that failed.
    """
    return _Continuation(plan, core).function()


class _Continuation:
    """Builds the emitted function that repeats a failed step. Its variables are attributes of this class."""

    # ``solved`` is the longest step that succeeded, and ``part`` is the current step, both as fractions of h.
    # ``factor`` is the ratio of consecutive fractions.
    solved, part, factor = real("solved"), real("part"), real("factor")
    tries, done = count("tries"), flag("done")

    def __init__(self, plan: Plan, core: str) -> None:
        assert plan.start is not None
        self.plan, self.core, self.n = plan, core, len(plan.start.unknowns)
        self.guess, self.trial = real("known_solution", self.n), plan.state("trial")
        # Every attempt overwrites STATUS, so the failure is stored in another variable.
        self.failure = Term("name", (), Kind.STATUS, "failure")

    def function(self) -> Function:
        """Return the function with its parameters and body."""
        plan, state = self.plan, self.plan.state()
        parameters = (state, *plan.moment(), *plan.parameters, *plan.sampled())
        # With the memory of the run, the next step starts from the solution found by continuation.
        parameters += (*plan.remembering(plan.memory), *plan.counted)
        # A step of length zero is not repeated, because no step is shorter.
        nothing = select(all_finite(state), code(OK), code(NOT_FINITE))
        # If the factor is near 1, there is no progress, and the loop ends. The branch of solutions then
        # probably ends before the full length of the step.
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
            # ``failure`` is the status of the last failed attempt.
            Assign(self.failure, code(NOT_CONVERGED)),
            Assign(self.done, truth(False)),
            Assign(self.tries, whole(0)),
            While(going_on, (*self.attempt(), *self.adapted())),
            If(negated(self.done), (Return(self.cause()),)),
            # Only the step of full length changes the state.
            Assign(state, self.trial),
            # A polynomial through solutions of steps of other lengths would be a bad initial guess.
            Assign(plan.memory.field("known", Kind.COUNT), whole(1)),
            no_failure(plan),
            Return(code(OK)),
        )
        part = "part of a step" if plan.parts else "step"
        # With substeps, only the failed substep is repeated.
        about = (
            f"Repeat a {part} whose equations did not converge: first without the earlier solutions, which "
            "are bad initial guesses if the motion has changed, then by continuation in h from shorter steps."
        )
        return Function(CONTINUED, about, parameters, body, Kind.STATUS)

    def cause(self) -> Term:
        """Return the status of a step that cannot be computed.

        It is TOO_FAR if the last failed attempt computed a number that is not finite and a shorter step
        succeeded. Otherwise it is the status of the last failed attempt.
        """
        # With run-time inputs the success of a shorter step proves nothing, because the shorter step reads
        # other values of the inputs.
        if self.plan.kernel.inputs:
            return self.failure
        too_far = both(self.solved > 0.0, self.failure.equals(code(NOT_FINITE)))
        return select(too_far, code(TOO_FAR), self.failure)

    def attempt(self) -> list[Statement]:
        """Return the statements that try one step from the solution of the last successful step."""
        plan, memory = self.plan, self.plan.memory
        rates = [memory.field(f"rate_{k}") for k in range(1, len(plan.kernel.loops) + 1)]
        # The rate of convergence of the shorter step does not apply to the longer step. With the rate 1, the
        # loop ends after one sweep only if the change is at rounding level.
        from_guess: list[Statement] = [
            Assign(memory.field("known", Kind.COUNT), whole(1)),
            Assign(memory.field("guess", Kind.REAL, (self.n,)), self.guess),
            *(Assign(rate, number(1.0)) for rate in rates),
        ]
        arguments = (*plan.moment(h=self.part * STEP), *plan.parameters, *plan.sampled(INPUTS))
        arguments += (*plan.remembering(memory), *plan.counted)
        # The error estimate is omitted, because runs that read it use no continuation in h.
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
        """Return the statements that choose the length of the next attempt, or end the loop after success."""
        plan, factor, part, solved = self.plan, self.factor, self.part, self.solved
        assert plan.start is not None
        values = plan.memory.field("values", Kind.REAL, (2 * plan.start.depth, self.n))
        # A successful attempt has stored its solution in row ``place`` of the memory.
        latest = values[plan.memory.field("place", Kind.COUNT)]
        # After the first success, a failure replaces the factor by its square root. A success squares the
        # factor, so a success after a failure restores the old factor.
        succeeded = (Assign(self.guess, latest), Assign(solved, part), Assign(factor, factor * factor))
        failed = (
            Assign(self.failure, STATUS),
            Assign(factor, select(solved > 0.0, call("sqrt", factor), factor)),
        )
        shorter = (
            Assign(factor, select(factor < LARGEST_FACTOR, factor, LARGEST_FACTOR)),
            # Before the first success, the step is halved. After the first success, the last successful
            # length is multiplied by the factor.
            Assign(part, select(solved > 0.0, solved * factor, 0.5 * part)),
            # No attempt is longer than the step itself.
            Assign(part, select(part < 1.0, part, 1.0)),
        )
        return [
            Assign(self.done, both(STATUS.equals(code(OK)), part >= 1.0)),
            If(STATUS.equals(code(OK)), succeeded, failed),
            If(negated(self.done), shorter),
            Assign(self.tries, self.tries + 1),
        ]
