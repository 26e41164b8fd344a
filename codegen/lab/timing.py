"""The CPU time of a call: the least time of several batches of repeated calls in one process.

Other processes can only increase a measured time. Therefore the least time is the best estimate. A call from
Python takes some time before the first step. A run of zero steps measures this overhead. The overhead is
subtracted, so that short and long runs can be compared.

The function :func:`span_times` times all runs that are compared, both of emitted methods and of other
integrators.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

BATCH = 0.002
"""A batch of calls takes at least this number of seconds, which is far above the resolution of the clock."""

BATCHES = 5
FEWER = 3
"""BATCHES is the least number of batches. If a batch takes longer than :data:`LONG` seconds, the number is
FEWER.
"""

LONG = 0.2

LEAST_STEPS, RESOLVED = 200, 1e-4
"""Runs with few steps are timed over several time spans (:func:`spans`), up to LEAST_STEPS steps or RESOLVED
seconds.

The overhead of a call is about a hundredth of RESOLVED.
"""

CONFIRMED, MOST = 0.03, 21
"""The least time is confirmed if some other batch takes at most (1 + CONFIRMED) times as long.

Further batches are run until the least time is confirmed, at most MOST batches in all.
"""

SHORT = 1e-3
"""A run of less than SHORT seconds is measured again if its time without the overhead is too uncertain
(:data:`RESOLUTION`).
"""

RESOLUTION = 0.1
"""The largest accepted uncertainty of the time of a run without the overhead, as a fraction of the time.

The uncertainty is the difference of the two fastest batches of the run, plus the difference of the two
fastest batches of the overhead.
"""

AGAIN = 3
"""The largest number of repeated measurements of a run whose time is too uncertain."""

LEAST_SHARE = 0.1
"""The time of a run without the overhead is at least LEAST_SHARE times the time with the overhead. Therefore
no run has the time zero.
"""


@dataclass(frozen=True)
class Timing:
    """A run of ``steps`` steps took ``seconds`` of CPU time."""

    steps: int
    seconds: float

    @property
    def ns_per_step(self) -> float:
        """Nanoseconds per step."""
        return 1e9 * self.seconds / self.steps


def samples(call: Callable[[], object], batch: float = BATCH, batches: int = BATCHES) -> tuple[float, ...]:
    """Return the CPU seconds of one call, measured in several batches, in increasing order.

    If a batch takes at most :data:`LONG` seconds, further batches are run until the two least times agree up
    to the fraction :data:`CONFIRMED`. At most :data:`MOST` batches are run.
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
    """Return the CPU seconds of one call: the least of several batches."""
    return samples(call, batch, batches)[0]


def spans(run: Callable[[int], object], steps: int) -> int:
    """Return the number of time spans over which a run is timed.

    ``run(n)`` runs over n spans, with ``steps`` steps for each span. The number of spans is doubled while the
    run takes less than :data:`RESOLVED` seconds. The doubling ends before a run has more than
    :data:`LEAST_STEPS` steps or fails.
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
    # The least of three times is used, because the first call of a module is slow.
    return min(_batch(lambda: run(count), 1) for _ in range(3))


@dataclass
class Overhead:
    """The overhead of a call: the CPU time of ``idle``, a call that makes no step. The overhead is zero if
    ``idle`` is None.

    All runs of one module in this process have the same overhead. The overhead is measured when it is first
    needed. :func:`net_times` measures it again if its uncertainty is large compared with the time of a run.
    """

    idle: Callable[[], object] | None

    @cached_property
    def times(self) -> tuple[float, ...]:
        """The CPU seconds of the call in several batches, in increasing order."""
        return (0.0,) if self.idle is None else samples(self.idle)

    @property
    def least(self) -> float:
        """The least time of all batches in seconds."""
        return self.times[0]

    @property
    def uncertainty(self) -> float:
        """The difference of the two fastest batches in seconds."""
        return self.times[1] - self.times[0] if len(self.times) > 1 else 0.0

    def refine(self) -> None:
        """Measure the call in further batches."""
        if self.idle is not None:
            self.times = tuple(sorted([*self.times, *samples(self.idle)]))


def span_times(
    run: Callable[[int], int], overhead: Overhead, batch: float = BATCH, batches: int = BATCHES
) -> list[float]:
    """Return the CPU seconds of a run over one time span, without the overhead of a call.

    The result contains one value for each batch, in increasing order. ``run(n)`` runs over n time spans and
    returns the number of steps. A short run is timed over several time spans (:func:`spans`), and its time is
    then scaled to one time span.
    """
    steps = run(1)
    count = spans(run, steps)
    taken = run(count) if count > 1 else steps
    share = steps / taken if steps and taken else 1 / count
    return [share * s for s in net_times(lambda: samples(lambda: run(count), batch, batches), overhead)]


def net_times(sample: Callable[[], Sequence[float]], overhead: Overhead) -> list[float]:
    """Return the times of a run without the overhead of a call, sorted.

    ``sample()`` measures the run and returns its times in seconds, with the overhead. If the times of a short
    run are too uncertain (:data:`SHORT`, :data:`RESOLUTION`), the run and the overhead are measured again, at
    most :data:`AGAIN` times. Each result is at least :data:`LEAST_SHARE` times the time with the overhead.
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
    """Return the relative spread s of sorted times, or None if the smallest time t is zero.

    Three quarters of the times are at most (1 + s) t.

    >>> spread((1.0, 1.25, 1.5, 9.0)), spread((0.0, 1.0))
    (0.5, None)
    """
    return times[3 * (len(times) - 1) // 4] / times[0] - 1 if times and times[0] > 0.0 else None


def _batch(call: Callable[[], object], calls: int) -> float:
    # Under a limit on CPU time (ulimit -t), Linux updates the CPU clock of the process only every few
    # milliseconds. The thread's clock stays exact, but does not count other threads. The larger of the two
    # times is used.
    start, own = time.process_time(), time.thread_time()
    for _ in range(calls):
        call()
    own = time.thread_time() - own
    return max(time.process_time() - start, own)


def timings(run: Callable[[int], object], steps: Sequence[int], batch: float = BATCH) -> tuple[Timing, ...]:
    """Return the CPU time of ``run(n)`` without the time of ``run(0)``, for each n of ``steps``.

    A negative difference is replaced by zero.
    """
    overhead = cost(lambda: run(0), batch)

    def timing(n: int) -> Timing:
        return Timing(n, max(cost(lambda: run(n), batch) - overhead, 0.0))

    return tuple(map(timing, steps))
