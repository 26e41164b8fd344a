"""A run to a given end time, with output at given times, with events, and with a largest number of steps.

Step control chooses the step sizes between two bounds, but the last step may be shorter. A run ends early if
the largest number of steps is reached, if an event ends the run, or if a step fails. The caller receives the
last accepted state and its time.
"""

from __future__ import annotations

from codegen.run.cause import searched
from codegen.run.language import Array, Assign, Call, Function, If, Return, Statement, While
from codegen.run.observation import Observation
from codegen.run.plan import Plan
from codegen.run.step import exact_time
from codegen.run.step_control import ATOL, RTOL, Controlled
from codegen.run.terms import (
    BAD_EVENT,
    BAD_STEP,
    LEAST_STEP,
    LIMIT,
    OK,
    STATUS,
    TOO_SHORT,
    Kind,
    absent,
    both,
    call,
    code,
    count,
    either,
    given,
    is_finite,
    negated,
    real,
    select,
    size,
    whole,
)
from codegen.run.trajectory import Rows, advanced, arguments, is_looped, own_memory

INTEGRATE = "integrate"
"""The name of the public function for a run to a given end time."""

NEARLY = 1e-9
"""If the rest of the run is at most (1 + NEARLY) times the step size, one step covers the rest.

Without this tolerance, rounding errors in the times could leave a tiny last step.
"""

LEAST, GREATEST = real("least"), real("greatest")


def functions(plan: Plan) -> tuple[Function, ...]:
    """Return the functions of the run, the public function last.

    The tuple is empty if no run to an end time was requested.
    """
    if plan.kernel.observed is None:
        return ()
    # Step control needs an error estimate.
    own = _Constant(plan) if plan.kernel.estimate is None else _Adaptive(plan)
    return *own.observation.functions(), own.integrate()


def _checked(observation: Observation) -> tuple[Statement, ...]:
    """Return the statement that sets the status BAD_EVENT if the buffer for events is too short."""
    if not observation.events:
        return ()
    # The buffer needs one entry for each event function, because all events may occur in one step.
    full = both(STATUS.equals(code(OK)), observation.room < observation.events)
    return (If(full, (Assign(STATUS, code(BAD_EVENT)),)),)


class _Constant:
    """Builds the run with steps of constant size. The attributes are variables of the emitted function."""

    # The run overwrites the initial time in the argument ``t`` with the reached time.
    t, h, completed = real("t", 1, cell=True), real("h"), count("completed", 1, optional=True, cell=True)
    now, end, limit = real("now"), real("end"), count("limit")
    start, length, following, left = real("begin"), real("size"), real("then"), real("left")
    # ``taken`` is the signed size of the current step, and ``done`` is the number of completed steps.
    taken, done = real("taken"), count("steps_done")
    stop = real("reached_time", 1)

    def __init__(self, plan: Plan) -> None:
        self.plan, self.observation = plan, Observation(plan)
        self.trial = plan.state("trial")

    def integrate(self) -> Function:
        """Return the public function for a run with steps of constant size."""
        plan, observation = self.plan, self.observation
        state = plan.state()
        chosen = (self.t, self.end, self.h, self.limit, *plan.parameters, *plan.sampled())
        parameters = (state, *chosen, *observation.outputs, *observation.buffers)
        parameters += (*plan.counted, self.completed)
        # The test needs no tolerance, because the last step ends exactly at ``end``.
        moving = either(self.now < self.end, self.now > self.end)
        # The sign of h is ignored: the end time determines the direction of the run.
        numbers = both(*(is_finite(x) for x in (self.now, self.end, self.length)), self.length > 0.0)
        body: tuple[Statement, ...] = (
            Assign(STATUS, code(OK)),
            Assign(self.done, whole(0)),
            Assign(self.now, self.t[0]),
            Assign(self.start, self.now),
            Assign(self.length, size(self.h)),
            If(negated(numbers), (Assign(STATUS, code(BAD_STEP)),)),
            *_checked(observation),
            *observation.begin(state, self.now, self.end),
            # The memory stores results of earlier steps, for example solutions of the implicit equations.
            # If ``own_step`` is True, each step calls ADVANCE with this memory as an argument. If
            # ``own_step`` is False, each step calls ``run``, which declares its own memory.
            *(own_memory(plan) if self.own_step else []),
            Array(self.trial),
            Array(self.stop, zero=True),
            While(both(STATUS.equals(code(OK)), moving), self.step()),
            Assign(self.t[0], self.now),
            If(given(self.completed), (Assign(self.completed[0], self.done),)),
            Return(STATUS),
        )
        return Function(INTEGRATE, "", parameters, body, Kind.STATUS, public=True)

    @property
    def own_step(self) -> bool:
        """True if each step calls the function ADVANCE. False if each step calls ``run``."""
        plan = self.plan
        # ADVANCE omits deferred flows and the conversion of a body momentum (``carried``). If the kernel is
        # inlined in the loop over the steps (``is_looped``), the function ADVANCE does not exist.
        return plan.kernel.deferred is None and plan.kernel.carried is None and not is_looped(plan)

    def step(self) -> tuple[Statement, ...]:
        """Return the statements of one step."""
        signed = call("copysign", self.length, self.left)
        near = size(self.left) <= (1.0 + NEARLY) * self.length
        following = exact_time(self.start, self.done + 1, self.taken)
        # If a very small step did not change the rounded time, the run would never end.
        stuck = negated(either(self.following > self.now, self.following < self.now))
        # The run ends early if the step is too short to change the time, or if the largest number of steps is
        # reached.
        ended = select(stuck, code(TOO_SHORT), code(LIMIT))
        return (
            Assign(self.left, self.end - self.now),
            Assign(self.taken, signed),
            # The new time is computed from the initial time, because a sum of step sizes would accumulate
            # rounding errors.
            Assign(self.following, select(near, self.end, following)),
            # The last step covers exactly the rest of the interval.
            Assign(self.taken, select(near, self.left, signed)),
            If(
                either(self.done >= self.limit, stuck),
                (Assign(STATUS, ended),),
                (
                    *self.moved(),
                    If(STATUS.equals(code(OK)), (self.observed(),)),
                    If(self.observation.sound, self.accept()),
                ),
            ),
        )

    def moved(self) -> list[Statement]:
        """Return the statements that compute the state after the step."""
        plan, trial = self.plan, self.trial
        # A copy of the state is advanced, because the search for events needs the state before the step.
        copied: list[Statement] = [Assign(trial, plan.state())]
        if self.own_step:
            # In the arguments of the step, ``t`` and ``h`` are the time and the size of the current step.
            known = {"t": self.now, "h": self.taken}
            passed = tuple(known.get(x.text, x) if x.own else x for x in arguments(plan))
            return [*copied, *advanced(plan, trial, passed), *searched(plan, trial, self.now, self.taken)]
        # ``run`` is called for one step. Two optional outputs of ``run`` are not requested: the trajectory
        # and the number of completed steps.
        time = (self.now,) if plan.time else ()
        nothing = (absent(Rows(plan).trajectory), whole(0))
        last = (*plan.counted, absent(count("completed", 1, optional=True, cell=True)))
        passed = (trial, *time, self.taken, whole(1), *plan.parameters, *plan.sampled(), *nothing, *last)
        return [*copied, Call("run", passed, (STATUS,))]

    def observed(self) -> Statement:
        """Return the call that finds the events of a step and computes the states at its output times."""
        return self.observation.observe(self.plan.state(), self.trial, self.now, self.following, self.stop)

    def accept(self) -> tuple[Statement, ...]:
        """Return the statements that accept a step."""
        return (
            Assign(self.plan.state(), self.trial),
            # ``stop`` is the time of the event that ends the run, or else the time at the end of the step.
            Assign(self.now, self.stop[0]),
            Assign(self.done, self.done + 1),
        )


class _Adaptive(Controlled):
    """Builds the run with step control, output times and events."""

    stop = real("reached_time", 1)

    def __init__(self, plan: Plan) -> None:
        super().__init__(plan)
        self.observation = Observation(plan)

    def integrate(self) -> Function:
        """Return the public function for a run with step control."""
        plan, observation = self.plan, self.observation
        chosen = (self.t, self.end, self.h, RTOL, ATOL, LEAST, GREATEST, self.limit)
        passed = (*plan.parameters, *plan.sampled(), *observation.outputs, *observation.buffers)
        parameters = (plan.state(), *chosen, *passed, *plan.counted, self.accepted, self.rejected)
        return Function(INTEGRATE, "", parameters, self.body(), Kind.STATUS, public=True)

    def begin(self) -> tuple[Statement, ...]:
        """Return the statements that are executed before the first step."""
        observation, state = self.observation, self.plan.state()
        # If LEAST is zero, the step size has no lower bound. If GREATEST is infinite, it has no upper bound.
        ordered = both(LEAST >= 0.0, is_finite(LEAST), GREATEST >= LEAST, GREATEST > 0.0)
        return (
            *super().begin(),
            Array(self.stop, zero=True),
            If(negated(ordered), (Assign(STATUS, code(BAD_STEP)),)),
            *_checked(observation),
            *observation.begin(state, self.now, self.end),
            # The step size given by the caller may be outside the interval [LEAST, GREATEST].
            *self.limited(),
        )

    def limited(self) -> tuple[Statement, ...]:
        """Return the statements that restrict the size of the next step to the interval [LEAST, GREATEST]."""
        return (
            If(self.length > GREATEST, (Assign(self.length, GREATEST),)),
            If(self.length < LEAST, (Assign(self.length, LEAST),)),
        )

    def accept(self) -> tuple[Statement, ...]:
        """Return the statements that are executed if the error of a step is small enough."""
        observed = self.observation.observe(
            self.plan.state(), self.trial, self.now, self.following, self.stop
        )
        # ``stop`` is the time of the event that ends the run, or else the time at the end of the step.
        accepted = (Assign(self.following, self.stop[0]), *super().accept(), *self.limited())
        return (observed, If(self.observation.sound, accepted))

    def refuse(self) -> tuple[Statement, ...]:
        """Return the statements that are executed if a step is rejected."""
        # The run ends if a rejected step is not longer than LEAST.
        short = both(LEAST > 0.0, size(self.taken) <= LEAST, STATUS.equals(code(OK)))
        return (
            *super().refuse(),
            If(short, (Assign(STATUS, code(LEAST_STEP)),)),
            # The base class may reduce the step size to a value below LEAST.
            If(self.length < LEAST, (Assign(self.length, LEAST),)),
        )
