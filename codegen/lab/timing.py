"""Measures the CPU time of a call in one process.

A batch consists of repeated calls that are timed together. The result is the least time of several batches,
because other processes can only increase a measured time. A run of zero steps measures the overhead: the time
of a call before its first step.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

BATCH = 0.002
"""A batch of calls takes at least BATCH seconds, far more than the resolution of the clock."""

BATCHES = 5
FEWER = 3
"""If one batch takes longer than :data:`LONG` seconds, at most this number of batches is timed."""

LONG = 0.2

LEAST_STEPS, RESOLVED = 200, 1e-4
"""Limits for the extension of short runs to several time spans (:func:`spans`).

A run is too short if it takes less than RESOLVED seconds and has at most LEAST_STEPS/2 steps. The number of
time spans is doubled as long as the run is too short. RESOLVED is about a hundred times the overhead of a
call.
"""

CONFIRMED, MOST = 0.03, 21
"""Limits for the number of batches (:func:`samples`).

Let a and b be the two least times, with a <= b. Further batches are timed until b <= (1 + CONFIRMED) a, or
until MOST batches have been timed.
"""

SHORT = 1e-3
"""A run shorter than SHORT seconds is measured again if its relative uncertainty exceeds RESOLUTION."""

RESOLUTION = 0.1

AGAIN = 3
"""The largest number of repeated measurements of a run whose time is too uncertain."""

LEAST_SHARE = 0.1
"""The smallest time that :func:`net_times` returns, as a fraction of the measured time."""


@dataclass(frozen=True)
class Timing:
    """The CPU time ``seconds`` of a run with ``steps`` steps."""

    steps: int
    seconds: float

    @property
    def ns_per_step(self) -> float:
        """The CPU time of a step in nanoseconds."""
        return 1e9 * self.seconds / self.steps


def samples(call: Callable[[], object], batch: float = BATCH, batches: int = BATCHES) -> tuple[float, ...]:
    """For each of several batches of calls, return the mean CPU time of one call in seconds.

    The times are in ascending order. A batch contains enough calls to take ``batch`` seconds or longer. If
    the first batch takes longer than :data:`LONG` seconds, at most :data:`FEWER` batches are timed. Otherwise
    the number of batches is ``batches``, or more if the two least times differ too much (:data:`CONFIRMED`).
    """
    calls, first = 1, _batch(call, 1)
    while first < batch:
        calls *= 2 if first > batch / 8 else 8
        first = _batch(call, calls)
    more = (min(batches, FEWER) if first > LONG else batches) - 1
    spent = sorted([first, *(_batch(call, calls) for _ in range(more))])
    while len(spent) < MOST and first <= LONG and spent[1] > (1 + CONFIRMED) * spent[0]:
        spent = sorted([*spent, _batch(call, calls)])
    return tuple(s / calls for s in spent)


def cost(call: Callable[[], object], batch: float = BATCH, batches: int = BATCHES) -> float:
    """Return the CPU time of one call in seconds: the least of the mean times from :func:`samples`."""
    return samples(call, batch, batches)[0]


def spans(run: Callable[[int], object], steps: int) -> int:
    """Return a number n for which ``run(n)`` takes so long that its CPU time can be measured accurately.

    ``run(n)`` integrates over n time spans of the scene, with ``steps`` steps for each span.

    The number n is a power of 2. If ``run(1)`` takes at least :data:`RESOLVED` seconds, n is 1.
    """
    count = 1
    while 2 * count * max(steps, 1) <= LEAST_STEPS and _least(run, count) < RESOLVED:
        try:
            run(2 * count)
        except ArithmeticError:
            break
        count *= 2
    return count


def _least(run: Callable[[int], object], count: int) -> float:
    # The least of three times is used, because the first call is slow.
    return min(_batch(lambda: run(count), 1) for _ in range(3))


@dataclass
class Overhead:
    """The overhead of a call: the CPU time of ``idle()``, a call that makes no step.

    If ``idle`` is None, the overhead is zero.
    """

    idle: Callable[[], object] | None

    @cached_property
    def times(self) -> tuple[float, ...]:
        """Measured CPU times of one call ``idle()`` in seconds, in increasing order.

        Each time is the mean over one batch of calls. If ``idle`` is None, the tuple contains only the number
        zero.
        """
        return (0.0,) if self.idle is None else samples(self.idle)

    @property
    def least(self) -> float:
        """The least time of all batches in seconds."""
        return self.times[0]

    @property
    def uncertainty(self) -> float:
        """The difference between the two least values of :attr:`times`, in seconds."""
        return self.times[1] - self.times[0] if len(self.times) > 1 else 0.0

    def refine(self) -> None:
        """Measure the overhead in further batches of calls, and add the measured times to :attr:`times`."""
        if self.idle is not None:
            self.times = tuple(sorted([*self.times, *samples(self.idle)]))


def span_times(
    run: Callable[[int], int], overhead: Overhead, batch: float = BATCH, batches: int = BATCHES
) -> list[float]:
    """Return CPU times in seconds of a run over one time span, without the overhead of a call.

    The result contains one time for each batch of runs, in increasing order. ``run(n)`` integrates over n
    time spans and returns the number of steps.
    """
    steps = run(1)
    count = spans(run, steps)
    taken = run(count) if count > 1 else steps
    share = steps / taken if steps and taken else 1 / count
    return [share * s for s in net_times(lambda: samples(lambda: run(count), batch, batches), overhead)]


def net_times(sample: Callable[[], Sequence[float]], overhead: Overhead) -> list[float]:
    """Return the times of a run in seconds without the overhead of a call, in increasing order.

    ``sample()`` times the run and returns a list of times that include the overhead. Short runs with an
    uncertain time are measured again (:data:`SHORT`). A returned time is never below the fraction
    :data:`LEAST_SHARE` of the measured time.
    """
    spent = sorted(sample())
    for _ in range(AGAIN):
        net = spent[0] - overhead.least
        uncertainty = overhead.uncertainty + (spent[1] - spent[0] if len(spent) > 1 else 0.0)
        if spent[0] >= SHORT or uncertainty <= RESOLUTION * net:
            break
        overhead.refine()
        spent = sorted([*spent, *sample()])
    return [max(s - overhead.least, LEAST_SHARE * s) for s in spent]


def spread(times: Sequence[float]) -> float | None:
    """Return (q - m)/m, where q is the upper quartile of the sorted times, and m is the smallest time.

    The result is None if ``times`` is empty or m is zero.

    >>> spread((1.0, 1.25, 1.5, 9.0)), spread((0.0, 1.0))
    (0.5, None)
    """
    return times[3 * (len(times) - 1) // 4] / times[0] - 1 if times and times[0] > 0.0 else None


def _batch(call: Callable[[], object], calls: int) -> float:
    # The CPU clock of the process can lag by a few milliseconds, and the CPU clock of the thread omits other
    # threads. So both clocks are read.
    start, own = time.process_time(), time.thread_time()
    for _ in range(calls):
        call()
    own = time.thread_time() - own
    return max(time.process_time() - start, own)


def timings(run: Callable[[int], object], steps: Sequence[int], batch: float = BATCH) -> tuple[Timing, ...]:
    """Return the CPU time of a run with n steps, for each n of ``steps``.

    The time of ``run(0)`` is subtracted from the time of ``run(n)``. Negative differences become zero.
    """
    overhead = cost(lambda: run(0), batch)

    def timing(n: int) -> Timing:
        return Timing(n, max(cost(lambda: run(n), batch) - overhead, 0.0))

    return tuple(map(timing, steps))
