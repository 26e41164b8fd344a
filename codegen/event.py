"""Events of a run: zeros of functions g(t, y) of the time t and the state y."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from codegen.argument import described, real

EventFunction = Callable[[float, Any], float]
"""A function of the time and the state. The state has the type of the initial state of the run."""

RISING, FALLING = 1, -1
"""The direction in which an event function passes through zero: to positive or to negative values."""


@dataclass(frozen=True)
class Event:
    """A function g(t, y) whose zeros are found in a run.

    - ``direction`` selects zeros: RISING (1), FALLING (-1), or 0 for all zeros.
    - If ``terminal`` is true, the first selected zero ends the run.
    """

    function: EventFunction
    terminal: bool = False
    direction: int = 0

    @property
    def stops(self) -> int:
        """A code that says which zeros of ``function`` end the run.

        The code is 1 for RISING zeros, 2 for FALLING zeros, 3 for all zeros, and 0 for no zeros.
        """
        return {RISING: 1, FALLING: 2, 0: 3}[self.direction] if self.terminal else 0


@dataclass(frozen=True)
class Crossing:
    """A zero of an event function.

    - ``event`` is the index of the event.
    - ``t`` is the time of the zero, and ``state`` is the state at this time.
    - ``direction`` is RISING or FALLING.
    """

    event: int
    t: float
    direction: int
    state: Any


def events_of(given: object, most: int) -> tuple[Event, ...]:
    """Return the entries of the list ``given`` as events. An entry is an event or a function.

    A function becomes an event that does not end the run. ValueError is raised if ``given`` contains more
    than ``most`` events, or if the direction of an event is not 1, -1 or 0. TypeError is raised if
    ``given`` is not a sequence, or if an entry is neither an event nor a function.

    >>> events_of([lambda t, y: y[0]], 1)[0].stops
    0
    >>> events_of([Event(len, terminal=True, direction=2)], 1)
    Traceback (most recent call last):
    ValueError: expected 1, -1 or 0 for the direction of an event, found 2
    """
    if not isinstance(given, Sequence):
        raise TypeError(
            "expected a list of functions or Event objects as the argument 'events', "
            f"found {described(given)}"
        )
    if len(given) > most:
        raise ValueError(
            f"expected at most {most} events, found {len(given)}; emit the module with events={len(given)}"
        )
    events = []
    for x in given:
        event = x if isinstance(x, Event) else Event(x)
        if not callable(event.function):
            raise TypeError(f"expected a function of time and state for an event, found {described(x)}")
        if event.direction not in (RISING, FALLING, 0):
            raise ValueError(f"expected 1, -1 or 0 for the direction of an event, found {event.direction}")
        events.append(event)
    return tuple(events)


class EventValues:
    """A callable object that computes the values of all event functions.

    ``restore`` converts a flat state to the type of the initial state of the run. If an event function raises
    an error, the error is stored, and all values are NaNs.
    """

    def __init__(self, events: Sequence[Event], size: int, restore: Callable[[Sequence[float]], Any]) -> None:
        self.events, self.size, self.restore = events, size, restore
        self.failure: BaseException | None = None

    def __call__(self, t: float, state: Sequence[float]) -> list[float]:
        """Return the values of all event functions at the time t. The state is a flat list of numbers."""
        try:
            form = self.restore(list(state))
            values = [
                real(event.function(t, form), "the value of an event function") for event in self.events
            ]
        except BaseException as error:  # a Python exception must not pass through C code
            self.failure = self.failure or error
            values = [float("nan")] * len(self.events)
        # Emitted code reads ``size`` values, so ones are appended to the list. The constant value 1 has no
        # zero and causes no event.
        return values + [1.0] * (self.size - len(values))
