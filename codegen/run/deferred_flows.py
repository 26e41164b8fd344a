"""Runs of a splitting method with deferred flows.

The last flow of a step and the first flow of the next step are computed as one flow. Flows that commute with
all other flows are applied once for many steps. In exact arithmetic, deferring flows does not change the
result (:class:`codegen.ir.kernel.Deferred`).

A state is complete only after the deferred flows have been applied. The run applies the deferred flows before
it writes a state to the trajectory, after the last step, and after :data:`codegen.ir.kernel.LONGEST` steps.
If a complete state is not finite, the run is repeated from the beginning, and no flow is deferred.
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.kernel import ELAPSED, LEAD, LONGEST, Deferred, Kernel
from codegen.run.arithmetic import computed, loaded, outputs, stored
from codegen.run.cause import cause, searched
from codegen.run.language import (
    RAISES_NAN,
    Array,
    Assign,
    Call,
    Function,
    If,
    Return,
    Statement,
    While,
)
from codegen.run.plan import STEP, STEPS, TIME, Plan
from codegen.run.step import ADVANCE, exact_time
from codegen.run.terms import (
    BAD_STEP,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    all_finite,
    both,
    code,
    count,
    either,
    flag,
    is_finite,
    narrow,
    negated,
    number,
    real,
    select,
    truth,
    whole,
    wide,
)
from codegen.run.trajectory import DONE, Rows, completed, run_parameters

BEGIN, FINISH, COMPLETE = "begin", "finish", "complete_step"
"""The names of three emitted functions.

- BEGIN applies the first flow of a step. BEGIN is not called if the previous step has already applied this
  first flow.
- FINISH applies the deferred flows.
- COMPLETE applies all flows of one step.
"""

LATE = count("late")
"""The number of steps since the last application of the deferred flows."""


def functions(plan: Plan) -> tuple[Function, ...]:
    """Return all functions of the emitted code. The public functions come last."""
    deferred = plan.kernel.deferred
    assert deferred is not None
    sequence = [_core(plan, ADVANCE, "Apply all flows of one step except the deferred flows.")]
    if deferred.begin is not None:
        sequence.append(
            _core(
                _plan(plan, deferred.begin),
                BEGIN,
                "Apply the first flow of a step.",
            )
        )
    if deferred.finish is not None:
        about = "Apply the flows that commute with all other flows."
        sequence.append(_core(_plan(plan, deferred.finish), FINISH, about))
    deferring = _Deferring(plan, deferred)
    return (
        *sequence,
        deferring.complete_step(),
        cause(plan, COMPLETE, plan.parameters),
        deferring.step(),
        deferring.run(),
    )


def _plan(plan: Plan, kernel: Kernel) -> Plan:
    # A splitting solves no implicit equations, so the argument ``tries`` is not needed.
    return Plan(kernel, plan.format)


def _core(plan: Plan, name: str, about: str) -> Function:
    """Return a function that applies the kernel of ``plan`` to the state."""
    state, read = plan.state(), plan.arrangement.symbols()
    ends, new = outputs(plan.arrangement, plan.symbols)
    # The state is tested after all deferred flows, because a state that is not finite cannot become finite
    # again.
    body = [*loaded(plan.symbols, state, read), *computed(plan), *ends, *stored(state, new)]
    return Function(name, about, (state, *_read(plan)), tuple(body), guard=RAISES_NAN, often=True)


def _scalars(plan: Plan) -> Sequence[str]:
    # The scalar arguments t and h come first, and the durations LEAD and ELAPSED come last.
    return ("t", "h", *(s for s in plan.kernel.scalars if s not in ("t", "h", LEAD, ELAPSED)), LEAD, ELAPSED)


def _read(plan: Plan) -> tuple[Term, ...]:
    """Return the scalar arguments that the kernel of ``plan`` reads, for example the time."""
    return plan.read(_scalars(plan))


class _Deferring:
    """Builds three emitted functions: ``step``, ``run`` and ``complete_step``.

    The class attributes represent local variables of the emitted functions.
    """

    # The last flow of a step and the first flow of the next step can be applied as one flow. ``begun`` is
    # True if the first flow of the current step was applied together with the last flow of the previous step.
    lead, stop, begun = real("lead"), flag("stop"), flag("begun")
    # If ``careful`` is True, the state is tested after every step. ``good`` is the result of the last test.
    shown, careful, good, again = flag("shown"), flag("careful"), flag("good"), flag("again")
    # ``asked`` is the number of steps that the current attempt shall make.
    asked = count("asked")

    def __init__(self, plan: Plan, deferred: Deferred) -> None:
        self.plan, self.deferred = plan, deferred
        self.moving, self.complete = plan.state("next"), plan.state("complete")
        # In single precision, a conversion of the durations through doubles would cause a second rounding
        # error.
        rounded = plan.format.round
        self.last, self.later = (number(rounded(x)) for x in (deferred.last, deferred.later))

    def call(self, name: str, kernel: Kernel | None, t: Term, elapsed: Term) -> list[Statement]:
        """Return a list with the call of the function ``name``, or an empty list if ``kernel`` is None.

        The function applies ``kernel``. ``elapsed`` is the duration of a deferred flow.
        """
        if kernel is None:
            return []
        # ``known`` contains the arguments for the parameters t, LEAD and ELAPSED.
        known = {"t": t, LEAD: self.lead, ELAPSED: elapsed}
        plan = _plan(self.plan, kernel)
        passed = tuple(known.get(x.text, x) for x in _read(plan))
        return [Call(name, (self.moving, *passed))]

    def step(self) -> Function:
        """Return the public function for one step."""
        plan, state = self.plan, self.plan.state()
        parameters = (state, *plan.moment(), *plan.parameters)
        body = (Call(COMPLETE, parameters, (STATUS,)), *searched(plan, state), Return(STATUS))
        return Function("step", "", parameters, body, Kind.STATUS, public=True)

    def complete_step(self) -> Function:
        """Return the function that makes one step. No flow of the step is deferred to a later step."""
        plan, state, deferred = self.plan, self.plan.state(), self.deferred
        kernel = plan.kernel
        begin: list[Statement] = []
        if deferred.begin is not None:
            # ADVANCE reads the duration of the last flow of the step from the variable ``lead``.
            begin = [Assign(self.lead, self.last * STEP), *self.call(BEGIN, deferred.begin, TIME, STEP)]
        body: tuple[Statement, ...] = (
            If(negated(is_finite(STEP)), (Return(code(BAD_STEP)),)),
            If(negated(all_finite(state)), (Return(code(NOT_FINITE)),)),
            Array(self.moving),
            Assign(self.moving, state),
            *begin,
            *self.call(ADVANCE, kernel, TIME, STEP),
            # FINISH applies the deferred flows of this step.
            *self.call(FINISH, deferred.finish, TIME, STEP),
            If(negated(all_finite(self.moving)), (Return(code(NOT_FINITE)),)),
            Assign(state, self.moving),
            Return(code(OK)),
        )
        # A splitting has no implicit equations, so there is no argument for iteration statistics.
        parameters = (state, *plan.moment(), *plan.parameters)
        return Function(
            COMPLETE, "Make one step. Defer no flow to a later step.", parameters, body, Kind.STATUS
        )

    def run(self) -> Function:
        """Return the emitted function ``run``."""
        plan, state = self.plan, self.plan.state()
        # A run of zero steps does not change the state, so it tests neither the step size nor the state.
        bad_step = both(STEPS > 0, negated(is_finite(STEP)))
        # If the initial state is not finite, every attempt would fail, so no step is made.
        bad_state = both(STATUS.equals(code(OK)), STEPS > 0, negated(all_finite(state)))
        body: tuple[Statement, ...] = (
            Assign(STATUS, code(OK)),
            # A failure reduces ``asked`` to the number of successful steps.
            Assign(self.asked, STEPS),
            If(bad_step, (Assign(STATUS, code(BAD_STEP)), Assign(self.asked, whole(0)))),
            If(bad_state, (Assign(STATUS, code(NOT_FINITE)), Assign(self.asked, whole(0)))),
            Array(self.moving),
            Array(self.complete),
            Assign(self.careful, truth(False)),
            Assign(DONE, whole(0)),
            # If the first attempt fails, the second attempt tests the state after every step. If a step of
            # the second attempt fails, the third attempt makes only the steps before the failed step.
            While(self.again, self.attempt(), at_least_once=True),
            Assign(state, self.complete),
            # After a failure, ``asked`` is the number of steps before the failed step. Therefore the failed
            # step begins at the time ``t`` + ``asked`` * ``h``.
            *searched(plan, state, t=exact_time(TIME, self.asked, STEP)),
            *completed(),
            Return(STATUS),
        )
        return Function("run", "", run_parameters(plan), body, Kind.STATUS, public=True)

    def attempt(self) -> tuple[Statement, ...]:
        """Return the statements of one attempt to make the steps of a run.

        In the emitted code, the loop over the steps ends early if a tested state is not finite.
        """
        state = self.plan.state()
        failed = (
            # Every attempt begins at the initial state. The first attempt tests only some states. If the
            # first attempt fails, the failed step is unknown, and ``careful`` becomes True. The second
            # attempt then tests the state after every step. If the second attempt fails, DONE is the number
            # of steps before the failed step, and the third attempt makes only these steps.
            If(self.careful, (Assign(STATUS, code(NOT_FINITE)), Assign(self.asked, DONE))),
            Assign(self.careful, truth(True)),
        )
        # If there is no function BEGIN, the emitted code does not use ``begun``.
        begun = [Assign(self.begun, truth(False))] if self.deferred.begin is not None else []
        return (
            Assign(DONE, whole(0)),
            Assign(LATE, whole(0)),
            *begun,
            *Rows(self.plan).begin(state),
            Assign(self.moving, state),
            # ``complete`` is the last state that passed the test for infinities and NaNs.
            Assign(self.complete, state),
            Assign(self.good, truth(True)),
            While(both(self.good, DONE < self.asked), self.one()),
            # If ``good`` is False, a state was not finite, and another attempt follows.
            Assign(self.again, negated(self.good)),
            If(self.again, failed),
        )

    def one(self) -> tuple[Statement, ...]:
        """Return the statements of one step of a run."""
        rows, deferred = Rows(self.plan), self.deferred
        # ``DONE`` is the number of steps before the current step.
        last = (DONE + 1).equals(self.asked)
        t = exact_time(TIME, DONE, STEP)
        # The emitted code computes ``elapsed`` as a product, because a product has a single rounding error.
        # If the emitted code added STEP to ``elapsed`` in every step, each addition would have a rounding
        # error.
        elapsed = narrow(wide(LATE) * wide(STEP))
        sequence: list[Statement] = [
            Assign(self.shown, rows.due(DONE + 1)),
            Assign(LATE, LATE + 1),
            # If ``stop`` is True, the deferred flows are applied at the end of this step. LATE is the number
            # of steps since these flows were last applied. The rounding errors of these flows grow with LATE,
            # so LATE is at most LONGEST.
            Assign(self.stop, either(self.shown, self.careful, last, LATE.equals(LONGEST))),
        ]
        if deferred.begin is not None:
            begin = tuple(self.call(BEGIN, deferred.begin, t, elapsed))
            sequence += [
                # If ``stop`` is False, the last flow of this step is merged with the first flow of the next.
                Assign(self.lead, select(self.stop, self.last, self.later) * STEP),
                If(negated(self.begun), begin),
                Assign(self.begun, negated(self.stop)),
            ]
        sequence += self.call(ADVANCE, self.plan.kernel, t, elapsed)
        taken = (
            Assign(LATE, whole(0)),
            Assign(self.complete, self.moving),
            If(self.shown, tuple(rows.add(self.complete))),
        )
        ended: list[Statement] = [
            *self.call(FINISH, deferred.finish, t, elapsed),
            Assign(self.good, all_finite(self.moving)),
            If(self.good, taken),
        ]
        # Only a state without deferred flows is tested for infinities and NaNs.
        sequence += [If(self.stop, tuple(ended)), If(self.good, (Assign(DONE, DONE + 1),))]
        return tuple(sequence)
