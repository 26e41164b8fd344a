"""Compute the states at the output times of a run, and find events.

A state inside a step of the run is computed by a separate, shorter step. Both steps begin at the same state.
If a continuous extension was requested, the states at output times are computed by the extension instead
(:mod:`codegen.run.dense_output`).

The event functions are evaluated at :data:`PARTS` equally spaced times of a step. An event is a change of the
sign of an event function between two consecutive times. Two changes of sign between consecutive times are not
found. If an event function is exactly zero when a run begins, this is no event.

The Illinois variant of the secant method, together with bisection, encloses an event in a short interval. The
event state is the state at the end of this interval, where the sign has changed.
"""

from __future__ import annotations

from codegen.run.dense_output import DenseOutput
from codegen.run.language import Array, Assign, Call, For, Function, If, Return, Statement, While
from codegen.run.plan import STEP, TIME, Plan
from codegen.run.terms import (
    BAD_EVENT,
    BAD_TIMES,
    EVENT,
    EVENT_FUNCTIONS,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    absent,
    all_finite,
    both,
    code,
    count,
    either,
    flag,
    is_finite,
    negated,
    number,
    real,
    select,
    size,
    truth,
    whole,
)
from codegen.run.trajectory import COMPLETED, Rows

INSIDE, ORDERED, CROSSED, LOCATE, EVENTS, OBSERVE = (
    *("inside", "in_order", "crossed", "locate", "find_events", "observe"),
)
"""The names of the private emitted functions that this module builds."""

PARTS = 4
"""The number of equal parts of a step. Event functions are evaluated at the end of each part."""

TRIALS = 200
"""The search for one event evaluates the event functions at most TRIALS times.

Every third evaluation halves the interval that contains the event."""

CLOSE = 4
"""A factor in the tolerance for the time of an event.

In a step from the time t to the time t', the interval that contains an event is shortened until its length is
at most 2 CLOSE u max(|t|, |t'|, |t' - t|), where u is the unit roundoff.
"""

RISING, FALLING = 1, 2
"""Values of the array ``stops``, which has one entry for each event function.

The run ends if the function changes from negative to positive (RISING), from positive to negative (FALLING),
or in either direction (RISING + FALLING)."""


class Observation:
    """Builds the functions for output times and events. Most attributes are variables of the emitted code."""

    times, amount = real("times", 0, optional=True), count("count")
    written = count("written", 1, cell=True)
    now, following, end = real("now"), real("then"), real("end")
    room, event_count = count("room"), count("event_count", 1, cell=True)
    low, middle, target, high = real("low"), real("middle"), real("target"), real("high", 1)
    stop = real("stop_time", 1, cell=True)

    def __init__(self, plan: Plan) -> None:
        assert plan.kernel.observed is not None
        self.plan, self.events = plan, plan.kernel.observed.events
        n, k = plan.size, self.events
        self.rows = real("rows", 0, n, optional=True)
        self.after, self.inner, self.reached = plan.state("after"), plan.state("inner"), plan.state("reached")
        self.stops = count("stops", k)
        self.event_times = real("event_times", 0, optional=True)
        self.event_rows = real("event_rows", 0, n, optional=True)
        self.numbers = count("event_numbers", 0, optional=True)
        # The values of the event functions are in ``values`` (lower end of the searched interval), ``ahead``
        # (upper end) and ``measured`` (latest evaluation).
        self.signs, self.values, self.measured = (real(x, k) for x in ("signs", "values", "measured"))
        self.ahead = real("ahead", k)
        extension = plan.kernel.observed.extension
        self.dense = None if extension is None else DenseOutput(plan, extension)

    @property
    def length(self) -> Term:
        """The step size, negative in a run backwards in time."""
        return self.following - self.now

    @property
    def sound(self) -> Term:
        """The condition for success: the status is OK or EVENT."""
        good = STATUS.equals(code(OK))
        return either(good, STATUS.equals(code(EVENT))) if self.events else good

    @property
    def outputs(self) -> tuple[Term, ...]:
        """The output times, the number of times, the array of states, and the number of stored states."""
        return self.times, self.amount, self.rows, self.written

    @property
    def buffers(self) -> tuple[Term, ...]:
        """The event arguments of the emitted functions. Without events, the tuple is empty."""
        if not self.events:
            return ()
        return (
            *(EVENT_FUNCTIONS, self.stops, self.room),
            *(self.event_times, self.event_rows, self.numbers, self.event_count),
        )

    @property
    def memory(self) -> tuple[Term, ...]:
        """The arrays that keep the signs and values of the event functions from step to step."""
        return (self.signs, self.values) if self.events else ()

    def begin(self, state: Term, now: Term, end: Term) -> tuple[Statement, ...]:
        """Return the statements at the beginning of a run. These statements check the output times, write
        the state at the initial time, and evaluate the event functions."""
        ordered = flag("ordered")
        place = self.written[0]
        first = (Assign(self.rows[place], state), Assign(place, place + 1))
        same = negated(either(self.times[place] < now, self.times[place] > now))
        # An earlier error has priority over wrong output times.
        checked = both(STATUS.equals(code(OK)), negated(ordered))
        # Several output times may equal the initial time, so this is a loop.
        written = While(both(STATUS.equals(code(OK)), place < self.amount, same), first)
        events: tuple[Statement, ...] = ()
        if self.events:
            # Without the zeros, some compilers would warn that entries may be read before they are assigned.
            arrays = tuple(Array(x, zero=True) for x in (*self.memory, self.measured))
            measured = (*self.measure(now, state), Assign(self.values, self.measured), *self.signed())
            events = (Assign(self.event_count[0], whole(0)), *arrays, If(STATUS.equals(code(OK)), measured))
        return (
            Assign(place, whole(0)),
            Call(ORDERED, (now, end, self.times, self.amount), (ordered,)),
            If(checked, (Assign(STATUS, code(BAD_TIMES)),)),
            written,
            *events,
        )

    def observe(self, state: Term, trial: Term, now: Term, following: Term, stop: Term) -> Call:
        """Return the call that observes the step from ``state`` to ``trial``.

        If an event ends the run, the call writes the state at the event into ``trial``, writes the time of
        the event into ``stop``, and returns EVENT.
        """
        passed = (*self.plan.parameters, *self.plan.sampled(), *self.outputs, *self.buffers, *self.memory)
        return Call(OBSERVE, (state, trial, now, following, *passed, stop), (STATUS,))

    def functions(self) -> tuple[Function, ...]:
        """Return the emitted functions. Each function comes after the functions that it calls."""
        located = (self.crossed(), self.locate(), self.find()) if self.events else ()
        dense = () if self.dense is None else self.dense.functions()
        # INSIDE is an emitted function that computes the state at a time inside a step. INSIDE is needed for
        # the search for events, and for output times if there is no continuous extension (``dense`` is None).
        inside = (self.inside(),) if self.events or self.dense is None else ()
        return *inside, self.in_order(), *located, *dense, self.observed()

    def inside(self) -> Function:
        """Return the function that computes a state between the beginning and the end of a step."""
        plan = self.plan
        state, inner = plan.state(), self.inner
        time = (TIME,) if plan.time else ()
        nothing = (absent(Rows(plan).trajectory), whole(0), *map(absent, plan.counted), absent(COMPLETED))
        run = (inner, *time, STEP, whole(1), *plan.parameters, *plan.sampled(), *nothing)
        body = (Assign(inner, state), Call("run", run, (STATUS,)), Return(STATUS))
        parameters = (state, *plan.moment(), *plan.parameters, *plan.sampled(), inner)
        about = "Copy the state to 'inner', and make one step of size h with the copy."
        return Function(INSIDE, about, parameters, body, Kind.STATUS)

    def state_at(self, state: Term, elapsed: Term) -> tuple[Statement, ...]:
        """Return the call that computes the state at the time ``elapsed`` after the beginning of the step."""
        plan = self.plan
        moment = plan.moment(self.now, elapsed)
        return (Call(INSIDE, (state, *moment, *plan.parameters, *plan.sampled(), self.inner), (STATUS,)),)

    def in_order(self) -> Function:
        """Return the function that tests whether the output times are sorted and inside the run."""
        k, ordered, last = count("k"), flag("ordered"), real("last_time")
        time = self.times[k]
        # In a run backwards in time, the output times must decrease.
        forward = both(self.end >= self.now, time >= last, time <= self.end)
        backward = both(self.end < self.now, time <= last, time >= self.end)
        body = (
            Assign(ordered, truth(True)),
            Assign(last, self.now),
            Assign(k, whole(0)),
            While(
                both(ordered, k < self.amount),
                (
                    # Comparisons with a NaN are false, so a NaN fails the test.
                    Assign(ordered, both(either(forward, backward), is_finite(time))),
                    Assign(last, time),
                    Assign(k, k + 1),
                ),
            ),
            Return(ordered),
        )
        about = "True if the output times are sorted in the direction of the run and lie inside the run."
        return Function(ORDERED, about, (self.now, self.end, self.times, self.amount), body, Kind.FLAG)

    def measure(self, time: Term, state: Term) -> tuple[Statement, ...]:
        """Return the statements that evaluate the event functions.

        If a value is not finite, the status becomes BAD_EVENT.
        """
        return (
            Call("measure", (EVENT_FUNCTIONS, time, state), (self.measured,)),
            If(negated(all_finite(self.measured)), (Assign(STATUS, code(BAD_EVENT)),)),
        )

    def signed(self) -> tuple[Statement, ...]:
        """Return the statements that store the sign (1, -1 or 0) of each event function."""
        i = count("i")
        value = self.measured[i]
        sign = select(value > 0.0, number(1.0), select(value < 0.0, number(-1.0), number(0.0)))
        return (For(i, whole(self.events), (Assign(self.signs[i], sign),)),)

    def changed(self, i: Term, values: Term) -> Term:
        """Return the condition that the sign of ``values[i]`` differs from the stored sign."""
        # If the stored sign is 0, the event function starts at zero, and no change is reported.
        known = either(self.signs[i] > 0.0, self.signs[i] < 0.0)
        return both(known, self.signs[i] * values[i] <= 0.0)

    def crossed(self) -> Function:
        """Return the function that tests whether at least one event function has changed its sign."""
        i, any_changed = count("i"), flag("any_changed")
        inner = (If(self.changed(i, self.measured), (Assign(any_changed, truth(True)),)),)
        body = (
            Assign(any_changed, truth(False)),
            For(i, whole(self.events), inner),
            Return(any_changed),
        )
        about = "True if the sign of an event function has changed."
        return Function(CROSSED, about, (self.signs, self.measured), body, Kind.FLAG)

    def locate(self) -> Function:
        """Return the function that finds a short interval around the first event after ``low``."""
        plan, state, high, ahead = self.plan, self.plan.state(), self.high[0], self.ahead
        trials, side, change = count("trials"), real("side"), flag("change")
        width, longer = real("width"), real("longer")
        low_weight, high_weight = real("low_weight"), real("high_weight")
        moved_high, moved_low = self._moved(high, side, low_weight, high_weight)
        tested = (
            Call(CROSSED, (self.signs, self.measured), (change,)),
            If(change, moved_high, moved_low),
        )
        body: tuple[Statement, ...] = (
            Array(self.inner),
            Array(self.measured),
            Assign(STATUS, code(OK)),
            *(Assign(x, number(1.0)) for x in (low_weight, high_weight)),
            Assign(side, number(0.0)),
            Assign(trials, whole(0)),
            Assign(
                longer, select(size(self.now) > size(self.following), size(self.now), size(self.following))
            ),
            # The rounding error of a time is at most ``width`` times the step size.
            Assign(width, CLOSE * plan.format.unit * longer / size(self.length)),
            # ``width`` must not be smaller than the rounding errors of the fractions ``low`` and ``high``.
            # Therefore ``width`` is at least CLOSE unit roundoffs.
            If(width < CLOSE * plan.format.unit, (Assign(width, number(CLOSE * plan.format.unit)),)),
            While(
                both(STATUS.equals(code(OK)), high - self.low > 2.0 * width, trials < TRIALS),
                (
                    *self._guess(high, ahead, trials, width, low_weight, high_weight),
                    *self.state_at(state, self.middle * self.length),
                    If(STATUS.equals(code(OK)), self.measure(self.time_at(self.middle), self.inner)),
                    If(STATUS.equals(code(OK)), tested),
                    Assign(trials, trials + 1),
                ),
            ),
            Return(STATUS),
        )
        parameters = (state, self.now, self.following, *plan.parameters, *plan.sampled(), EVENT_FUNCTIONS)
        parameters += (self.signs, self.values, self.low, self.high, self.reached, ahead)
        about = (
            "Enclose the first event in a short interval from 'low' to 'high' (fractions of the step). "
            "Write the state at 'high' into 'reached', and the values of the event functions into 'ahead'."
        )
        return Function(LOCATE, about, parameters, body, Kind.STATUS)

    def _guess(
        self, high: Term, ahead: Term, trials: Term, width: Term, low_weight: Term, high_weight: Term
    ) -> tuple[Statement, ...]:
        """Return the statements that choose ``middle``, the next point between ``low`` and ``high``."""
        i, estimate, difference = count("i"), real("estimate"), real("difference")
        # For each event function with a change of sign, let a and b be the values at ``low`` and ``high``,
        # multiplied by the weights of the Illinois method (:meth:`_moved`). The secant through a and b has
        # one zero z. The smallest z of these functions is chosen, or the midpoint in every third iteration.
        a, b = self.values[i] * low_weight, ahead[i] * high_weight
        # Either a and b have opposite signs, or b is zero. Therefore 0 <= a/(a - b) <= 1. If a and b
        # underflow, the divisor a - b is 0. In this case the midpoint is the estimate.
        bisected, secant = 0.5 * (self.low + high), self.low + (high - self.low) * (a / difference)
        candidate = (
            Assign(difference, a - b),
            Assign(estimate, select(either(difference > 0.0, difference < 0.0), secant, bisected)),
            If(estimate < self.middle, (Assign(self.middle, estimate),)),
        )
        halved = either((trials % 3).equals(2), negated(is_finite(self.middle)))
        return (
            Assign(self.middle, high),
            For(i, whole(self.events), (If(self.changed(i, ahead), candidate),)),
            If(halved, (Assign(self.middle, bisected),)),
            # ``middle`` must be at least ``width`` away from ``low`` and ``high``.
            If(self.middle > high - width, (Assign(self.middle, high - width),)),
            If(self.middle < self.low + width, (Assign(self.middle, self.low + width),)),
        )

    def _moved(
        self, high: Term, side: Term, low_weight: Term, high_weight: Term
    ) -> tuple[tuple[Statement, ...], tuple[Statement, ...]]:
        """Return two tuples of statements that shorten the interval from ``low`` to ``high``.

        The numbers ``low`` < ``middle`` < ``high`` are fractions of the step. The first tuple sets ``high``
        to ``middle``. The second tuple sets ``low`` to ``middle``.
        """
        # If one end of the interval moves twice in a row, the Illinois method halves the weight of the other
        # end. ``side`` is 1 if the upper end moved last, and -1 if the lower end moved last.
        moved_high: tuple[Statement, ...] = (
            Assign(high, self.middle),
            Assign(self.ahead, self.measured),
            Assign(self.reached, self.inner),
            Assign(low_weight, select(side > 0.0, 0.5 * low_weight, number(1.0))),
            Assign(high_weight, number(1.0)),
            Assign(side, number(1.0)),
        )
        moved_low: tuple[Statement, ...] = (
            Assign(self.low, self.middle),
            Assign(self.values, self.measured),
            Assign(high_weight, select(side < 0.0, 0.5 * high_weight, number(1.0))),
            Assign(low_weight, number(1.0)),
            Assign(side, number(-1.0)),
        )
        return moved_high, moved_low

    def time_at(self, fraction: Term) -> Term:
        """Return the time at a fraction of the step. Fraction 1 gives exactly the end time of the step."""
        inner = self.now + fraction * self.length
        return select(fraction >= 1.0, self.following, inner)

    def find(self) -> Function:
        """Return the function that finds all events of a step in the order of time."""
        plan, state, high, change = self.plan, self.plan.state(), self.high[0], flag("change")
        located = (state, self.now, self.following, *plan.parameters, *plan.sampled(), EVENT_FUNCTIONS)
        located += (self.signs, self.values, self.low, self.high, self.inner, self.measured)
        good = STATUS.equals(code(OK))
        body: tuple[Statement, ...] = (
            *(Array(x, zero=True) for x in (self.inner, self.measured, self.high)),
            Assign(STATUS, code(OK)),
            Assign(self.stop[0], self.following),
            Assign(self.low, number(0.0)),
            Assign(self.target, number(1.0 / PARTS)),
            While(
                both(good, self.low < 1.0),
                (
                    If(
                        # The state at the end of the step is already known.
                        self.target < 1.0,
                        self.state_at(state, self.target * self.length),
                        (Assign(self.inner, self.after),),
                    ),
                    If(good, self.measure(self.time_at(self.target), self.inner)),
                    Assign(change, truth(False)),
                    Assign(high, self.target),
                    If(good, (Call(CROSSED, (self.signs, self.measured), (change,)),)),
                    # The function LOCATE moves ``high`` back to a point just after the first event.
                    If(change, (Call(LOCATE, located, (STATUS,)),)),
                    If(both(good, change), self.recorded()),
                    If(either(good, STATUS.equals(code(EVENT))), self.passed()),
                ),
            ),
            Return(STATUS),
        )
        parameters = (state, self.after, self.now, self.following, *plan.parameters, *plan.sampled())
        parameters += (*self.buffers, *self.memory, self.stop)
        about = "Find events in a step. If an event ends the run, the state at the event is the new state."
        return Function(EVENTS, about, parameters, body, Kind.STATUS)

    def recorded(self) -> tuple[Statement, ...]:
        """Return the statements that test all event functions and store an event for each change of sign."""
        i, rising, place = count("i"), count("rising"), self.event_count[0]
        # ``stops[i]`` has two bits for event function i. If the bit RISING = 1 is set, a rising zero ends the
        # run. If the bit FALLING = 2 is set, a falling zero ends the run.
        ends = select(rising > 0, self.stops[i] % 2, self.stops[i] // 2)
        stored = (
            Assign(rising, select(self.signs[i] < 0.0, whole(1), whole(0))),
            Assign(self.event_times[place], self.time_at(self.high[0])),
            Assign(self.event_rows[place], self.inner),
            # The stored number encodes the index of the event function and the direction of the crossing.
            Assign(self.numbers[place], 2 * i + rising),
            Assign(place, place + 1),
            If(ends > 0, (Assign(STATUS, code(EVENT)),)),
        )
        stopped = (Assign(self.stop[0], self.time_at(self.high[0])), Assign(self.after, self.inner))
        return (
            For(i, whole(self.events), (If(self.changed(i, self.measured), stored),)),
            # The run ends here unless the buffer has room for one more event of every event function.
            If(place + self.events > self.room, (Assign(STATUS, code(EVENT)),)),
            If(STATUS.equals(code(EVENT)), stopped),
        )

    def passed(self) -> tuple[Statement, ...]:
        """Return the statements that prepare the search for the next event in the step."""
        return (
            Assign(self.low, self.high[0]),
            Assign(self.values, self.measured),
            *self.signed(),
            # A step has PARTS parts. At the end of a part, ``target`` becomes the end of the next part.
            If(self.low >= self.target, (Assign(self.target, self.target + 1.0 / PARTS),)),
        )

    known = flag("known")

    def begin_extension(self) -> tuple[Statement, ...]:
        """Return the statements that prepare a continuous extension, or () without an extension."""
        if self.dense is None:
            return ()
        # A compiler may warn that entries of the array have no values, so the array is set to zero.
        return Array(self.dense.powers, zero=True), Assign(self.known, truth(False))

    def inner_state(self, state: Term, time: Term) -> tuple[Statement, ...]:
        """Return the statements that compute the state at an output time inside a step."""
        if self.dense is None:
            return self.state_at(state, time - self.now)
        # The coefficients of the extension are computed only at the first output time in the step.
        first = (self.dense.coefficients(state, self.now, self.length), Assign(self.known, truth(True)))
        return (
            If(negated(self.known), first),
            self.dense.state_at(state, (time - self.now) / self.length),
            If(negated(all_finite(self.inner)), (Assign(STATUS, code(NOT_FINITE)),)),
        )

    def observed(self) -> Function:
        """Return the function that finds the events in a step and the states at the output times in the step.

        If an event ends the run, later output times are omitted.
        """
        plan, state, place = self.plan, self.plan.state(), self.written[0]
        outcome, due, stop = Term("name", (), Kind.STATUS, "outcome"), flag("due"), self.stop[0]
        time = self.times[place]
        passed = (state, self.after, self.now, self.following, *plan.parameters, *plan.sampled())
        search: tuple[Statement, ...] = (Assign(stop, self.following),)
        if self.events:
            # If an event ends the run, the function EVENTS sets ``stop`` to the time of this event.
            search = (Call(EVENTS, (*passed, *self.buffers, *self.memory, self.stop), (STATUS,)),)
        # In a run backwards in time, the comparisons are reversed.
        beyond = select(self.following > self.now, time > stop, time < stop)
        inside = select(self.following > self.now, time < stop, time > stop)
        good = STATUS.equals(code(OK))
        row = (
            If(
                inside,
                (
                    *self.inner_state(state, time),
                    If(good, (Assign(self.rows[place], self.inner),)),
                ),
                (Assign(self.rows[place], self.after),),
            ),
            If(good, (Assign(place, place + 1),)),
        )
        outputs = (
            # The loop needs the status OK, but the search for events may have set the status EVENT.
            Assign(outcome, STATUS),
            Assign(STATUS, code(OK)),
            Assign(due, truth(True)),
            While(
                both(good, due, place < self.amount),
                (Assign(due, negated(beyond)), If(due, row)),
            ),
            If(good, (Assign(STATUS, outcome),)),
        )
        body: tuple[Statement, ...] = (
            Array(self.inner),
            *self.begin_extension(),
            Assign(STATUS, code(OK)),
            *search,
            If(self.sound, outputs),
            Return(STATUS),
        )
        parameters = (*passed, *self.outputs, *self.buffers, *self.memory, self.stop)
        about = "Observe a step: find its events, and write the states at output times inside it."
        return Function(OBSERVE, about, parameters, body, Kind.STATUS)
