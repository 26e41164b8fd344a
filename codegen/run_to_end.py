"""Runs to a given end time. A run can have output at given times, and it can find zeros of event functions.
The step sizes can be bounded.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import replace

from codegen.argument import count, end_of_run, monotone, real
from codegen.arrival import Arrival, Begun, Reached, Signals, Statistics, Status
from codegen.event import Crossing, Event, EventFunction, EventValues, events_of
from codegen.printers.interface import Interface
from codegen.state_form import State


class RunToEnd(ABC):
    """The base class of integrators that can run to a given end time."""

    interface: Interface

    def integrate(
        self,
        state: State,
        t: float = 0.0,
        end: float | None = None,
        h: float = 0.0,
        *,
        rtol: float = 1e-6,
        atol: float = 1e-9,
        least: float = 0.0,
        greatest: float = math.inf,
        limit: int = 100_000,
        events: Sequence[Event | EventFunction] = (),
        statistics: Statistics | None = None,
        inputs: Signals | None = None,
        t_eval: Sequence[float] | None = None,
        **parameters: float,
    ) -> Arrival:
        """Integrate from t to end, with output at the times ``t_eval``, and find zeros of event functions.

        An adaptive module chooses step sizes between ``least`` and ``greatest``. The first step size is
        ``h``. If ``h`` is 0, the module chooses the first step size. A module without step control makes
        steps of size ``h``, but the last step can be shorter. A module without step control ignores ``rtol``,
        ``atol``, ``least`` and ``greatest``. Output times and events do not change the step sizes. If ``end``
        is None, the integration ends at the last time in ``t_eval``.

        TypeError is raised for a module that was emitted without ``integrate=True``. ValueError is raised if
        output times are not monotone, or if an output time is not between t and end. StepFailed is raised if
        a step fails, or if ``limit`` steps do not reach the end. The attribute ``arrival`` of the exception
        contains all results before the failure.
        """
        if not self.interface.integrated:
            raise TypeError("this module cannot integrate to a given end time; emit it with integrate=True")
        t, h, limit = real(t, "t"), real(h, "h"), count(limit, "limit")
        times = monotone(t, () if t_eval is None else t_eval)
        end = end_of_run(t, end, times)
        bounds = tuple(
            real(x, n) for x, n in ((rtol, "rtol"), (atol, "atol"), (least, "least"), (greatest, "greatest"))
        )
        begun = self._begin(state, parameters, inputs, statistics)
        functions = events_of(events, self.interface.events)
        arrival = self._arrival(begun, functions, (t, end, h), bounds, limit, times)
        return arrival if t_eval is not None else replace(arrival, states=None)

    def _arrival(
        self,
        begun: Begun,
        events: Sequence[Event],
        span: tuple[float, float, float],
        bounds: tuple[float, ...],
        limit: int,
        times: Sequence[float],
    ) -> Arrival:
        """Call the emitted function, and return its results in the form of the caller's state."""
        restore = begun.form.restore
        values = EventValues(events, self.interface.events, restore)
        run = self._integrate(begun, values, span, bounds, limit, times)
        if values.failure is not None:
            raise values.failure
        crossings = [
            Crossing(k, time, direction, restore(state))
            for k, time, direction, state in run.events
            if events[k].direction in (0, direction)
        ]
        arrival = Arrival(
            *(restore(run.state), run.t, run.h, run.accepted, run.rejected),
            *(restore(list(run.rows)), tuple(crossings)),
        )
        if run.status not in (Status.OK, Status.EVENT):
            # The failed step may contain events, but a run that continues from ``arrival`` finds them again.
            done = tuple(x for x in crossings if (x.t <= run.t if span[1] > span[0] else x.t >= run.t))
            arrival = replace(arrival, crossings=done)
            failed = begun.failed(run.status, run.accepted, run.state, run.reason)
            failed.arrival = replace(arrival, status=failed.status)
            raise failed
        return replace(arrival, status=Status(run.status))

    @abstractmethod
    def _begin(
        self,
        state: State,
        parameters: Mapping[str, float],
        inputs: Signals | None,
        statistics: Statistics | None,
    ) -> Begun:
        """Check the arguments of a run, and return them in the form that ``_integrate`` accepts.

        TypeError is raised for wrong parameter names or inputs, ValueError for a wrong state.
        """

    @abstractmethod
    def _integrate(
        self,
        begun: Begun,
        values: EventValues,
        span: tuple[float, float, float],
        bounds: tuple[float, ...],
        limit: int,
        times: Sequence[float],
    ) -> Reached:
        """Call the emitted function. All events of the run are stored, whatever their number.

        ``span`` is (t, end, h): the initial time, the end time, and the first step size. ``bounds`` is
        (rtol, atol, least, greatest): the relative and the absolute tolerance, and the least and the greatest
        step size.
        """
