"""Step control with a proportional-integral controller.

Let e_i be the error estimate for the component y_i of the state. The error norm of a step is the root mean
square of the quotients e_i/(atol + rtol |y_i|). A step is accepted if the norm is at most one. Let p be the
order of the estimate, ``norm`` the error norm of a step, and ``before`` the error norm of the previous
accepted step. After an accepted step, the step size is multiplied by the factor

    0.9 norm^(-0.8/p) before^(0.2/p).

This factor is limited to [0.2, 5]. If the trial directly before the accepted step was rejected, the factor is
limited to [0.2, 1]. After a rejected step, the step size is multiplied by 0.9 norm^(-1/p), limited to
[0.2, 0.9].

The limits of the factors are taken from Hairer, Norsett and Wanner, Solving Ordinary Differential Equations
I, section II.4. The controller is by Gustafsson (Hairer and Wanner, Solving Ordinary Differential Equations
II, section IV.2). With the exponents 0.7/p and 0.4/p in place of 0.8/p and 0.2/p, the step size would
oscillate less, but it would follow the solution more slowly.

The first accepted step has no previous accepted step. If the caller gives a step size, ``before`` = 1 is used
for the first accepted step. If the caller gives no step size, the first trial step has 1/16 of the length of
the interval of integration, and the factor after the first accepted step is 0.9 norm^(-1/p). This factor is
limited to [0.2, 16] if the first trial step is accepted, and to [0.2, 1] otherwise.

After a change of the step size, the solutions of earlier steps are bad initial guesses. Therefore implicit
steps do not use these solutions.
"""

from __future__ import annotations

from codegen.run.language import RAISES_NAN, Array, Assign, Call, For, Function, If, Return, Statement, While
from codegen.run.plan import Plan
from codegen.run.step import ADVANCE
from codegen.run.terms import (
    BAD_STEP,
    INFINITY,
    LIMIT,
    OK,
    STATUS,
    TOO_SHORT,
    Kind,
    Term,
    both,
    call,
    code,
    count,
    either,
    flag,
    fresh,
    given,
    is_finite,
    negated,
    number,
    real,
    select,
    size,
    truth,
    whole,
)

SAFETY, LEAST, MOST = 0.9, 0.2, 5.0
FIRST = 16.0
"""If the caller gives no step size, the first trial step is the length of the time interval divided by FIRST.
If this trial step is accepted, the step size grows at most by the factor FIRST. After each later step, the
step size grows at most by the factor MOST."""

SHARE = 0.2
"""A constant in the exponents of the controller.

After an accepted step, the step size is multiplied by

    SAFETY norm^(-4 SHARE/p) before^(SHARE/p) = 0.9 norm^(-0.8/p) before^(0.2/p).

Here p is the order of the error estimate, ``norm`` is the error norm of the step, and ``before`` is the error
norm of the previous accepted step.
"""

FLOOR = 1e-4
"""The least error norm that the controller stores for the next step.

The error norm of a step may be tiny by accident. A tiny stored norm would make the next step size too small,
so the controller stores FLOOR in place of a smaller norm.
"""

RTOL, ATOL = real("rtol"), real("atol")


def functions(plan: Plan) -> tuple[Function, ...]:
    """Return the functions of a run with step control. If the kernel has no error estimate, the tuple is
    empty."""
    if plan.kernel.estimate is None:
        return ()
    return weighted(plan), between(), Controlled(plan).function()


def usable_tolerances() -> Term:
    """Return the test whether both tolerances are finite and not negative, and at least one is positive.

    If both tolerances were zero, every step would be rejected. With an infinite tolerance, every step would
    be accepted.
    """
    # The test is false if a tolerance is a NaN.
    positive = either(RTOL > 0.0, ATOL > 0.0)
    return both(is_finite(RTOL), is_finite(ATOL), RTOL >= 0.0, ATOL >= 0.0, positive)


def weighted(plan: Plan) -> Function:
    """Return the emitted function that computes the norm of an error estimate."""
    n, i = plan.size, count("i")
    before, after, error = (real(name, n) for name in ("before", "after", "error"))
    total, ratio, old, new = real("total"), real("ratio"), real("old"), real("new")
    # |y_i| is the larger of the absolute values before and after the step. The smaller value may be
    # nearly zero by accident, and would then make the permitted error too small.
    scale = ATOL + RTOL * select(new > old, new, old)
    body = (
        Assign(total, number(0.0)),
        For(
            i,
            whole(n),
            (
                Assign(old, size(before[i])),
                Assign(new, size(after[i])),
                # If ``atol`` is zero and y_i remains zero, error_i and its scale are zero. The quotient would
                # be a NaN, and every step would be rejected.
                Assign(ratio, select(either(error[i] > 0.0, error[i] < 0.0), error[i] / scale, error[i])),
                Assign(total, total + ratio * ratio),
            ),
        ),
        Return(call("sqrt", total / float(n))),
    )
    about = (
        "The root mean square of error_i / (atol + rtol |y_i|), where |y_i| is the larger of the absolute "
        "values before and after the step."
    )
    parameters = (before, after, error, RTOL, ATOL)
    return Function("weighted", about, parameters, body, Kind.REAL, RAISES_NAN)


def between() -> Function:
    """Return the emitted function that limits a factor to an interval."""
    least, x, most = real("least"), real("x"), real("most")
    # The test ``x > least`` comes first, because this test is false for a NaN.
    bounded = select(x > least, select(x < most, x, most), least)
    about = "Clamp x to [least, most]; a NaN gives least."
    return Function("between", about, (least, x, most), (Return(bounded),), Kind.REAL)


class Controlled:
    """Builds the emitted function ``run_adaptive``, which integrates with step control.

    The attributes of the class are variables of the emitted function.
    """

    t, h = real("t", 1, cell=True), real("h", 1, cell=True)
    end, limit = real("end"), count("limit")
    accepted, rejected = (count(name, 1, optional=True, cell=True) for name in ("accepted", "rejected"))
    accepted_steps, rejected_steps, shrunk = count("accepted_steps"), count("rejected_steps"), flag("shrunk")
    now, length, previous = real("now"), real("size"), real("previous")
    left, last, taken, following = real("left"), flag("last"), real("taken"), real("then")
    norm, proposed, factor = real("norm"), real("proposed"), real("factor")
    starting, root = flag("starting"), real("root")

    def __init__(self, plan: Plan) -> None:
        assert plan.kernel.estimate is not None
        self.plan, self.order = plan, plan.kernel.estimate.order
        # A trial step changes a copy of the state, because a rejected step must leave the state unchanged.
        self.trial, self.error = plan.state("trial"), real("error", plan.size)

    def function(self) -> Function:
        """Return the emitted function ``run_adaptive``."""
        plan = self.plan
        chosen = (self.t, self.end, self.h, RTOL, ATOL, self.limit)
        passed = (*plan.parameters, *plan.sampled(), *plan.counted)
        parameters = (plan.state(), *chosen, *passed, self.accepted, self.rejected)
        return Function("run_adaptive", "", parameters, self.body(), Kind.STATUS, public=True)

    def body(self) -> tuple[Statement, ...]:
        """Return the statements in the body of the emitted function."""
        # If a time is NaN, both comparisons are false, and no step is made.
        moving = either(self.now < self.end, self.now > self.end)
        return (
            *self.begin(),
            While(both(STATUS.equals(code(OK)), moving), self.step()),
            # The time and the step size are stored even after a failure, so that the caller can continue.
            Assign(self.t[0], self.now),
            Assign(self.h[0], self.length),
            If(given(self.accepted), (Assign(self.accepted[0], self.accepted_steps),)),
            If(given(self.rejected), (Assign(self.rejected[0], self.rejected_steps),)),
            Return(STATUS),
        )

    def begin(self) -> tuple[Statement, ...]:
        """Return the statements before the first step."""
        plan = self.plan
        # The arguments are tested for NaNs and infinities only here. Later step sizes are finite, because
        # ``between`` returns only finite factors.
        numbers = both(*(is_finite(x) for x in (self.length, self.now, self.end)))
        memory = [Array(plan.memory, zero=True)] if plan.remembers else []
        # A rough first step size is enough, because it may change by a large factor after the first trial.
        span, first = self.end - self.now, real("first")
        chosen = size(span) / FIRST
        # If the interval is so short that t + span / FIRST rounds to t, the first step is the whole interval.
        long = either(first > self.now, first < self.now)
        return (
            Assign(STATUS, code(OK)),
            Assign(self.accepted_steps, whole(0)),
            Assign(self.rejected_steps, whole(0)),
            Assign(self.shrunk, truth(False)),
            Assign(self.now, self.t[0]),
            Assign(self.length, size(self.h[0])),
            Assign(self.starting, self.length <= 0.0),
            If(
                self.starting,
                (
                    Assign(first, self.now + span / FIRST),
                    Assign(self.length, select(long, chosen, size(span))),
                ),
            ),
            Assign(self.previous, number(1.0)),
            If(negated(both(numbers, usable_tolerances())), (Assign(STATUS, code(BAD_STEP)),)),
            *memory,
            Array(self.trial),
            Array(self.error),
        )

    def step(self) -> tuple[Statement, ...]:
        """Return the statements of one trial step."""
        # If t + h equals t in floating-point arithmetic, the run never reaches the end.
        stuck = negated(either(self.following > self.now, self.following < self.now))
        return (
            Assign(self.left, self.end - self.now),
            # A step that would go beyond the end is shortened.
            Assign(self.last, self.length >= size(self.left)),
            Assign(self.taken, select(self.last, self.left, call("copysign", self.length, self.left))),
            # The last step ends exactly at ``end``. The rounded sum ``now + taken`` could be below ``end``,
            # and then a tiny step would follow.
            Assign(self.following, select(self.last, self.end, self.now + self.taken)),
            If(
                either(self.accepted_steps + self.rejected_steps >= self.limit, stuck),
                (Assign(STATUS, select(stuck, code(TOO_SHORT), code(LIMIT))),),
                # If the norm of the error is a NaN, this test is false, and the step is rejected.
                (*self.tried(), If(self.norm <= 1.0, self.accept(), self.refuse())),
            ),
        )

    def tried(self) -> tuple[Statement, ...]:
        """Return the statements that compute a trial step and the norm of its error."""
        plan, state = self.plan, self.plan.state()
        known = {"t": self.now, "h": self.taken}
        arguments = (*(known.get(x.text, x) for x in plan.moment()), *plan.parameters, *plan.sampled())
        arguments += (*plan.remembering(plan.memory), *plan.counted, self.error)
        # The solutions of earlier steps are useful initial guesses only if all steps have the same size.
        forgotten = [Assign(plan.memory, fresh(plan.memory))] if plan.remembers else []
        measured = Call("weighted", (state, self.trial, self.error, RTOL, ATOL), (self.norm,))
        return (
            Assign(self.trial, state),
            *forgotten,
            Call(ADVANCE, (self.trial, *arguments), (STATUS,)),
            # If the step fails, the norm remains infinite, so the step is rejected.
            Assign(self.norm, INFINITY),
            If(STATUS.equals(code(OK)), (measured,)),
        )

    def power(self, base: Term, exponent: float) -> Term:
        """Return ``base`` to the power ``exponent``/p, where p is the order of the estimate."""
        # The order is known when the code is generated, so the exponent is a constant of the emitted code.
        return call("power", base, number(self.plan.format.round(exponent / self.order)))

    def rounded(self, x: float) -> Term:
        """Return the constant ``x``, rounded to the floating-point format of the emitted code."""
        return number(self.plan.format.round(x))

    def bounded(self, most: Term) -> Call:
        """Return the call that limits the factor ``proposed`` to the interval from LEAST to ``most``."""
        return Call("between", (self.rounded(LEAST), self.proposed, most), (self.factor,))

    def accept(self) -> tuple[Statement, ...]:
        """Return the statements that are executed after an accepted step."""
        state, most = self.plan.state(), self.rounded(FLOOR ** (-SHARE / self.order))
        square = self.root * self.root
        # If ``starting`` is true, no earlier step was accepted, so ``previous`` is not used.
        trend = select(self.starting, self.root, number(1.0) / self.previous)
        # If the trial directly before this step was rejected, the step size does not grow after this step
        # (Hairer, Norsett and Wanner).
        longer = select(self.shrunk, number(1.0), select(self.starting, number(FIRST), number(MOST)))
        return (
            Assign(state, self.trial),
            Assign(self.now, self.following),
            Assign(self.accepted_steps, self.accepted_steps + 1),
            Assign(self.root, self.power(self.norm, -SHARE)),
            Assign(self.proposed, self.rounded(SAFETY) * (square * square) * trend),
            self.bounded(longer),
            If(
                # A short last step must not reduce ``length``, unless the error demands a shorter step.
                either(negated(self.last), self.factor < 1.0),
                (Assign(self.length, size(self.taken) * self.factor),),
            ),
            Assign(self.previous, select(self.root < most, self.root, most)),
            Assign(self.shrunk, truth(False)),
            Assign(self.starting, truth(False)),
        )

    def refuse(self) -> tuple[Statement, ...]:
        """Return the statements that are executed after a rejected step.

        Let t be the time and h the size of the next, shorter trial step. If t + h differs from t in
        floating-point arithmetic, the status is set to OK, and the run continues. If t + h equals t, the run
        ends. If the rejected step failed, the final status is the status of the rejected step. If the
        rejected step did not fail, its error was too large, and the final status is TOO_SHORT.
        """
        # If a step fails and no shorter step is possible, the run ends with the status of the failed step.
        following = real("next")
        changes = either(following > self.now, following < self.now)
        return (
            Assign(self.rejected_steps, self.rejected_steps + 1),
            Assign(self.shrunk, truth(True)),
            Assign(self.proposed, self.rounded(SAFETY) * self.power(self.norm, -1.0)),
            self.bounded(self.rounded(SAFETY)),
            Assign(self.length, size(self.taken) * self.factor),
            Assign(following, self.now + call("copysign", self.length, self.left)),
            If(changes, (Assign(STATUS, code(OK)),)),
        )
