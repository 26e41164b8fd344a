"""Step control: steps as large as the tolerances allow, by a proportional-integral controller.

The error of a step is the root mean square of its estimate over atol + rtol |y|; a step is accepted where
that is at most one. With p the order of the estimate the next step is longer by 0.9 norm^(-0.7/p)
before^(0.4/p), of the last two errors, but by a factor between 0.2 and 5, and not longer at all after a
refusal; a refused step is repeated with 0.9 norm^(-1/p), between 0.2 and 0.9. Exponents and limits are those
of Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.4, and of Gustafsson's
controller there.

The solutions of steps of another size are no guide: each step begins without them.
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
FLOOR = 1e-4
"""No error before is taken to be smaller: a lucky step shall not make the next ones long."""

RTOL, ATOL = real("rtol"), real("atol")


def functions(plan: Plan) -> tuple[Function, ...]:
    """Return the run that chooses its steps, with what it calls; none without an estimate."""
    if plan.kernel.estimate is None:
        return ()
    return weighted(plan), between(), _Controlled(plan).function()


def weighted(plan: Plan) -> Function:
    """Return the function that measures an error."""
    n, i = plan.size, count("i")
    before, after, error = (real(name, n) for name in ("before", "after", "error"))
    total, ratio, old, new = real("total"), real("ratio"), real("old"), real("new")
    scale = ATOL + RTOL * select(new > old, new, old)
    body = (
        Assign(total, number(0.0)),
        For(
            i,
            whole(n),
            (
                Assign(old, size(before[i])),
                Assign(new, size(after[i])),
                Assign(ratio, error[i] / scale),
                Assign(total, total + ratio * ratio),
            ),
        ),
        Return(call("sqrt", total / float(n))),
    )
    about = (
        "The root mean square of error over atol + rtol |y|, y the larger of a component before and after."
    )
    parameters = (before, after, error, RTOL, ATOL)
    return Function("weighted", about, parameters, body, Kind.REAL, RAISES_NAN)


def between() -> Function:
    """Return the function that bounds a factor."""
    least, x, most = real("least"), real("x"), real("most")
    bounded = select(x > least, select(x < most, x, most), least)
    about = "x, but at least least and at most most; least for a NaN."
    return Function("between", about, (least, x, most), (Return(bounded),), Kind.REAL)


class _Controlled:
    """The run and its variables."""

    t, h = real("t", 1, cell=True), real("h", 1, cell=True)
    end, limit = real("end"), count("limit")
    accepted, rejected = (count(name, 1, optional=True, cell=True) for name in ("accepted", "rejected"))
    accepted_steps, refused, shrunk = count("made"), count("refused"), flag("shrunk")
    now, length, before = real("now"), real("size"), real("before")
    left, last, taken, following = real("left"), flag("last"), real("taken"), real("then")
    norm, wish, factor = real("norm"), real("wish"), real("factor")

    def __init__(self, plan: Plan) -> None:
        assert plan.kernel.estimate is not None
        self.plan, self.order = plan, plan.kernel.estimate.order
        self.trial, self.error = plan.state("trial"), real("error", plan.size)

    def function(self) -> Function:
        """Return the whole."""
        plan = self.plan
        chosen = (self.t, self.end, self.h, RTOL, ATOL, self.limit)
        passed = (*plan.parameters, *plan.sampled(), *plan.counted)
        parameters = (plan.state(), *chosen, *passed, self.accepted, self.rejected)
        moving = either(self.now < self.end, self.now > self.end)
        body: tuple[Statement, ...] = (
            *self.begin(),
            While(both(STATUS.equals(code(OK)), moving), self.step()),
            Assign(self.t[0], self.now),
            Assign(self.h[0], self.length),
            If(given(self.accepted), (Assign(self.accepted[0], self.accepted_steps),)),
            If(given(self.rejected), (Assign(self.rejected[0], self.refused),)),
            Return(STATUS),
        )
        return Function("run_adaptive", "", parameters, body, Kind.STATUS, public=True)

    def begin(self) -> tuple[Statement, ...]:
        """Return what stands before the first step."""
        plan = self.plan
        numbers = both(*(is_finite(x) for x in (self.length, self.now, self.end)))
        tolerances = both(RTOL >= 0.0, ATOL >= 0.0)
        memory = [Array(plan.memory, zero=True)] if plan.remembers else []
        chosen = size(self.end - self.now) / 100.0
        return (
            Assign(STATUS, code(OK)),
            Assign(self.accepted_steps, whole(0)),
            Assign(self.refused, whole(0)),
            Assign(self.shrunk, truth(False)),
            Assign(self.now, self.t[0]),
            Assign(self.length, size(self.h[0])),
            If(self.length <= 0.0, (Assign(self.length, chosen),)),
            Assign(self.before, number(1.0)),
            If(negated(both(numbers, tolerances)), (Assign(STATUS, code(BAD_STEP)),)),
            *memory,
            Array(self.trial),
            Array(self.error),
        )

    def step(self) -> tuple[Statement, ...]:
        """Return the statements of one trial."""
        stuck = negated(either(self.following > self.now, self.following < self.now))
        return (
            Assign(self.left, self.end - self.now),
            Assign(self.last, self.length >= size(self.left)),
            Assign(self.taken, select(self.last, self.left, call("copysign", self.length, self.left))),
            Assign(self.following, select(self.last, self.end, self.now + self.taken)),
            If(
                either(self.accepted_steps + self.refused >= self.limit, stuck),
                (Assign(STATUS, code(LIMIT)),),
                (*self.tried(), If(self.norm <= 1.0, self.accept(), self.refuse())),
            ),
        )

    def tried(self) -> tuple[Statement, ...]:
        """Return the statements that make a step on trial and measure its error."""
        plan, state = self.plan, self.plan.state()
        known = {"t": self.now, "h": self.taken}
        arguments = (*(known.get(x.text, x) for x in plan.moment()), *plan.parameters, *plan.sampled())
        arguments += (*plan.remembering(plan.memory), *plan.counted, self.error)
        forgotten = [Assign(plan.memory, fresh(plan.memory))] if plan.remembers else []
        measured = Call("weighted", (state, self.trial, self.error, RTOL, ATOL), (self.norm,))
        return (
            Assign(self.trial, state),
            *forgotten,
            Call(ADVANCE, (self.trial, *arguments), (STATUS,)),
            # A step that fails is refused like one whose error is too large.
            Assign(self.norm, INFINITY),
            If(STATUS.equals(code(OK)), (measured,)),
        )

    def power(self, base: Term, exponent: float) -> Term:
        """Return a power of an error."""
        return call("power", base, number(self.plan.format.round(exponent / self.order)))

    def rounded(self, x: float) -> Term:
        """Return a constant of the controller."""
        return number(self.plan.format.round(x))

    def bounded(self, most: Term) -> Call:
        """Return the call that makes the wish a factor."""
        return Call("between", (self.rounded(LEAST), self.wish, most), (self.factor,))

    def accept(self) -> tuple[Statement, ...]:
        """Return the statements after a step that was accepted."""
        state, floor = self.plan.state(), self.rounded(FLOOR)
        trend = self.power(self.before, 0.4)
        longer = select(self.shrunk, number(1.0), number(MOST))
        return (
            Assign(state, self.trial),
            Assign(self.now, self.following),
            Assign(self.accepted_steps, self.accepted_steps + 1),
            Assign(self.wish, self.rounded(SAFETY) * self.power(self.norm, -0.7) * trend),
            self.bounded(longer),
            If(
                either(negated(self.last), self.factor < 1.0),
                (Assign(self.length, size(self.taken) * self.factor),),
            ),
            Assign(self.before, select(self.norm > floor, self.norm, floor)),
            Assign(self.shrunk, truth(False)),
        )

    def refuse(self) -> tuple[Statement, ...]:
        """Return the statements after a step that was refused.

        A failure is forgotten as long as a shorter step still changes the time.
        """
        following = real("next")
        changes = either(following > self.now, following < self.now)
        return (
            Assign(self.refused, self.refused + 1),
            Assign(self.shrunk, truth(True)),
            Assign(self.wish, self.rounded(SAFETY) * self.power(self.norm, -1.0)),
            self.bounded(self.rounded(SAFETY)),
            Assign(self.length, size(self.taken) * self.factor),
            Assign(following, self.now + call("copysign", self.length, self.left)),
            If(changes, (Assign(STATUS, code(OK)),)),
        )
