"""The CPU time of a call: the least over several batches of repeated calls in one process.

Other processes can only increase a time. The least time is therefore the best estimate; a mean would include
the load by other processes. A call from Python takes some time before the first step. This overhead is
measured with a run of zero steps and subtracted, so that short and long runs can be compared.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

BATCH = 0.004
"""Seconds that a batch of calls must last, far above the resolution of the clock."""

BATCHES = 7
FEWER = 3
"""The number of batches is BATCHES. It is FEWER if a call takes longer than :data:`LONG` seconds."""

LONG = 0.2

LEAST_STEPS, RESOLVED = 200, 1e-4
"""Runs with fewer steps are continued beyond the span while they are timed, unless they take RESOLVED
seconds. The overhead of a call is about a hundredth of this time."""

CONFIRMED, MOST = 0.03, 21
"""The least time is confirmed if a second batch takes at most CONFIRMED longer. Otherwise batches are
repeated, up to MOST of them."""


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
    """Return the CPU seconds of one call, measured in several batches long enough for the clock, sorted.

    Batches of short calls are repeated until two of them agree on the least time.
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
    """Return the number of spans over which a run of ``steps`` steps a span is timed.

    ``run(n)`` runs over n spans. The number is doubled until the run takes :data:`RESOLVED` seconds, has
    :data:`LEAST_STEPS` steps, or fails because the solution ends beyond the span.
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
    # The first call of a module is slow.
    return min(_batch(lambda: run(count), 1) for _ in range(3))


def spread(times: Sequence[float]) -> float | None:
    """Return the relative interval of sorted times: three quarters of them are at most 1 + spread times the
    least. None if the least time is zero.

    >>> spread((1.0, 1.25, 1.5, 9.0)), spread((0.0, 1.0))
    (0.5, None)
    """
    return times[3 * (len(times) - 1) // 4] / times[0] - 1 if times and times[0] > 0.0 else None


def _batch(call: Callable[[], object], calls: int) -> float:
    # Under a limit on CPU time (ulimit -t), Linux advances the clock of the process every few milliseconds
    # only, and a batch may take no time by it. The clock of the thread stays exact, but misses other threads.
    start, own = time.process_time(), time.thread_time()
    for _ in range(calls):
        call()
    own = time.thread_time() - own
    return max(time.process_time() - start, own)


def timings(run: Callable[[int], object], steps: Sequence[int], batch: float = BATCH) -> tuple[Timing, ...]:
    """Return the CPU time of ``run(n)`` minus the CPU time of ``run(0)``, for each n of ``steps``."""
    overhead = cost(lambda: run(0), batch)

    def timing(n: int) -> Timing:
        return Timing(n, max(cost(lambda: run(n), batch) - overhead, 0.0))

    return tuple(map(timing, steps))
