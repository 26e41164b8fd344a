"""The results of runs, and the checked arguments of calls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import IntEnum

from codegen.event import Crossing
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON
from codegen.state_form import Batch, State, StateForm

Signals = Callable[[float], Sequence[float]]
"""A function that returns the values of the run-time inputs at a given time."""


SOLVERS = (NEWTON, SIMPLIFIED_NEWTON, FIXED_POINT)
"""The solvers of implicit equations, the most robust first."""


class Status(IntEnum):
    """The status code of a step or a run. Emitted code returns the integer value."""

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
    BAD_SHAPE = 12
    BAD_OPERATOR = 13


class StepFailed(ArithmeticError):
    """The error of a failed step.

    The error contains the status of the failed step, the number of completed steps, and the state after the
    last completed step. The run can be continued from the state in the error. After an adaptive run or a call
    of ``integrate``, ``arrival`` contains the same state, its time, and the size of the next step.
    """

    arrival: Arrival | None = None

    def __init__(self, status: Status, step: int, state: State, reason: str) -> None:
        super().__init__(f"step {step + 1}: {reason}")
        self.status, self.step, self.state, self.reason = status, step, state, reason


@dataclass(frozen=True)
class Arrival:
    """The result of an adaptive run.

    ``state`` is the last state, ``t`` is its time, and ``h`` is the proposed size of the next step.
    ``accepted`` and ``rejected`` are numbers of steps.
    """

    state: State
    t: float
    h: float
    accepted: int
    rejected: int
    states: State = None
    """The states at the times ``t_eval``, or None if ``t_eval`` was not given."""
    crossings: tuple[Crossing, ...] = ()
    """The zeros of event functions, in the order in which the run found them."""
    status: Status = Status.OK
    """EVENT if a terminal event ended the run, otherwise OK. In the arrival of a :class:`StepFailed` error,
    ``status`` is the status of the failed step."""


@dataclass(frozen=True)
class Reached:
    """The results of one call of the emitted function that integrates to a given end time.

    States are flat sequences of numbers. Each event is a tuple: the index of the event function, the time,
    the direction of the zero, and the state.
    """

    status: int
    state: Sequence[float]
    t: float
    h: float
    rows: Sequence[Sequence[float]]
    events: Sequence[tuple[int, float, int, Sequence[float]]]
    accepted: int
    rejected: int
    reason: str


@dataclass
class Statistics:
    """Counts of the iterations of a run. An implicit block is a system of equations that each step solves by
    iteration.

    - ``sweeps``: the number of iterations of each block in the whole run.
    - ``most``: the largest number of iterations of a block in one step.
    - ``failed``: the index of the block that failed, counted from 1, or 0 if no block failed.
    - ``matrices``: the number of Newton matrices that were computed.
    """

    sweeps: list[int] = field(default_factory=list)
    most: int = 0
    failed: int = 0
    matrices: int = 0


@dataclass(frozen=True)
class Begun:
    """The checked arguments of a run.

    - ``form`` converts results to the type of the caller's state.
    - ``numbers`` are the coordinates of the state.
    - ``values`` are the values of the parameters.
    - ``solvers`` are the solvers of implicit equations that the emitted module uses.
    """

    form: StateForm
    numbers: list[float]
    values: list[float]
    inputs: Signals | None = None
    statistics: Statistics | None = None
    solvers: tuple[str, ...] = ()

    def failed(self, status: int, step: int, state: Sequence[float], reason: str) -> StepFailed:
        """Return the error of a failed step. The state in the error has the type of the caller's state.

        If the iteration for an implicit stage did not converge, the message recommends shorter steps, or a
        solver that the module does not use.
        """
        if status == Status.NOT_CONVERGED:
            others = [s for s in SOLVERS if s not in self.solvers]
            options = f", or emit with the solver {' or '.join(others)}" if others else ""
            reason += f"; take shorter steps{options}"
        return StepFailed(Status(status), step, self.form.restore(state), reason)


def joined(arrivals: Sequence[Arrival], batch: Batch) -> Arrival:
    """Return one result for the adaptive runs of a batch of independent systems.

    The result contains all final states, the total numbers of steps, and t and h of the last run.
    """
    last = arrivals[-1]
    states = None if last.states is None else batch.joined([x.states for x in arrivals])
    accepted, rejected = sum(x.accepted for x in arrivals), sum(x.rejected for x in arrivals)
    return Arrival(batch.joined([x.state for x in arrivals]), last.t, last.h, accepted, rejected, states)
