"""The data of a run of an emitted integrator: its arguments, its results, and its status codes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import IntEnum

from codegen.event import Crossing
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON
from codegen.state_form import Batch, State, StateForm

Signals = Callable[[float], Sequence[float]]
"""A function of time that returns the values of all run-time inputs."""


SOLVERS = (NEWTON, SIMPLIFIED_NEWTON, FIXED_POINT)
"""The solvers of implicit equations, from the most robust to the least robust."""


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
    """Raised if a step of a run fails.

    The error contains the status of the failed step, the number of completed steps, and the state after the
    last completed step.

    If :meth:`Integrator.adaptive` or :meth:`Integrator.integrate` raises the error, the attribute ``arrival``
    contains the last state, its time, and the proposed size of the next step.
    """

    arrival: Arrival | None = None

    def __init__(self, status: Status, step: int, state: State, reason: str) -> None:
        super().__init__(f"step {step + 1}: {reason}")
        self.status, self.step, self.state, self.reason = status, step, state, reason


@dataclass(frozen=True)
class Arrival:
    """The result of :meth:`Integrator.adaptive` or :meth:`Integrator.integrate`.

    ``state`` is the last state, ``t`` is its time, and ``h`` is the proposed size of the next step.
    ``accepted`` and ``rejected`` are the numbers of accepted and of rejected steps.
    """

    state: State
    t: float
    h: float
    accepted: int
    rejected: int
    states: State = None
    """The states at the times ``t_eval``, or None if ``t_eval`` was not given."""
    crossings: tuple[Crossing, ...] = ()
    """The zeros of the event functions, in the order in which the run found the zeros."""
    status: Status = Status.OK
    """The reason for the end of the run.

    The value is OK if the run reached its end time, and EVENT if a terminal event ended the run.
    """


@dataclass(frozen=True)
class Reached:
    """The results of one call of the emitted function that integrates to a given end time.

    - ``state``, ``t``, ``h``: the last state, its time, and the proposed size of the next step.
    - ``rows``: the states at the output times.
    - ``events``: a tuple for each zero of an event function. The tuple contains the index of the function,
      the time, the direction (1 for a rising and -1 for a falling function), and the state.
    - ``accepted``, ``rejected``: the numbers of accepted and of rejected steps.
    - ``reason``: the reason for a failed step.

    A state is a flat sequence of numbers.
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
    """Statistics of the iterations in a run.

    A block is a system of equations that each step solves by iteration.

    - ``sweeps``: for each block, the number of iterations in the whole run.
    - ``most``: the largest number of iterations for one block in one step.
    - ``failed``: the index of the block that could not be solved, or 0. The first block has the index 1.
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
        """Return the error of a failed step. The state in the error has the type of the caller's state."""
        if status == Status.NOT_CONVERGED:
            others = [s for s in SOLVERS if s not in self.solvers]
            options = f", or emit the module with the solver {' or '.join(others)}" if others else ""
            reason += f"; take shorter steps{options}"
        return StepFailed(Status(status), step, self.form.restore(state), reason)


def joined(arrivals: Sequence[Arrival], batch: Batch) -> Arrival:
    """Return one result for the adaptive runs of a batch of independent systems.

    ``accepted`` and ``rejected`` are sums over the systems. ``t`` and ``h`` are taken from the run of the
    last system.
    """
    last = arrivals[-1]
    states = None if last.states is None else batch.joined([x.states for x in arrivals])
    accepted, rejected = sum(x.accepted for x in arrivals), sum(x.rejected for x in arrivals)
    return Arrival(batch.joined([x.state for x in arrivals]), last.t, last.h, accepted, rejected, states)
