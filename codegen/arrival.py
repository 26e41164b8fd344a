"""The results of runs with step control, and of runs to a given end time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from codegen.event import Crossing
from codegen.state_form import Batch, State


class Status(IntEnum):
    """The result of a step; emitted code returns these numbers."""

    OK = 0
    NOT_CONVERGED = 1
    NOT_FINITE = 2
    BAD_STEP = 3
    LIMIT = 4
    TOO_FAR = 5
    SINGULAR = 6
    TOO_SHORT = 7
    EVENT = 8
    BAD_TIMES = 9
    LEAST_STEP = 10
    BAD_EVENT = 11


@dataclass(frozen=True)
class Arrival:
    """The result of an adaptive run: the last state and its time, the proposed size of the next step, and the
    numbers of accepted and rejected steps."""

    state: State
    t: float
    h: float
    accepted: int
    rejected: int
    states: State = None
    """The states at the times ``t_eval``; None without such times."""
    crossings: tuple[Crossing, ...] = ()
    """The events that a run of ``integrate`` has found, in order."""
    status: Status = Status.OK
    """EVENT if a terminal event ended the run."""


@dataclass(frozen=True)
class Reached:
    """The results of one call of the emitted run to an end time, before they have the form of the caller's
    state. Each of the ``events`` is (index, time, direction, state)."""

    status: int
    state: Sequence[float]
    t: float
    h: float
    rows: Sequence[Sequence[float]]
    events: Sequence[tuple[int, float, int, Sequence[float]]]
    accepted: int
    rejected: int
    reason: str


def joined(arrivals: Sequence[Arrival], batch: Batch) -> Arrival:
    """Return the result of adaptive runs from all states of a batch."""
    last = arrivals[-1]
    states = None if last.states is None else batch.joined([x.states for x in arrivals])
    accepted, rejected = sum(x.accepted for x in arrivals), sum(x.rejected for x in arrivals)
    return Arrival(batch.joined([x.state for x in arrivals]), last.t, last.h, accepted, rejected, states)
