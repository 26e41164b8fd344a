"""What a run costs: CPU time of repeated calls in one process, the least over several batches.

The least time is the one that the machine disturbed least; a mean would measure the neighbours as well. What
a call costs before its first step (crossing from Python, copying the state) is measured with runs of no step
and taken off, so that short runs compare with long ones.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

BATCH = 0.004
"""Seconds that a batch of calls must last, far above the clock's resolution."""

BATCHES = 7
FEWER = 3
"""Batches, and those of a call that takes longer than :data:`LONG` seconds."""

LONG = 0.2


@dataclass(frozen=True)
class Timing:
    """A run of ``steps`` steps took ``seconds`` of CPU time."""

    steps: int
    seconds: float

    @property
    def ns_per_step(self) -> float:
        """Nanoseconds a step."""
        return 1e9 * self.seconds / self.steps


def samples(call: Callable[[], Any], batch: float = BATCH, batches: int = BATCHES) -> tuple[float, ...]:
    """Return the CPU seconds of one call by several batches, each long enough for the clock, sorted."""
    calls, first = 1, _batch(call, 1)
    while first < batch:
        calls *= 2 if first > batch / 8 else 8
        first = _batch(call, calls)
    more = (min(batches, FEWER) if first > LONG else batches) - 1
    return tuple(sorted(s / calls for s in (first, *(_batch(call, calls) for _ in range(more)))))


def cost(call: Callable[[], Any], batch: float = BATCH, batches: int = BATCHES) -> float:
    """Return the CPU seconds of one call: the least of several batches, each long enough for the clock."""
    return samples(call, batch, batches)[0]


def _batch(call: Callable[[], Any], calls: int) -> float:
    start = time.process_time()
    for _ in range(calls):
        call()
    return time.process_time() - start


def timings(run: Callable[[int], Any], steps: Sequence[int], batch: float = BATCH) -> tuple[Timing, ...]:
    """Return the time of ``run(n)`` for each n of ``steps``, without what ``run(0)`` takes."""
    idle = cost(lambda: run(0), batch)
    return tuple(Timing(n, max(cost(lambda n=n: run(n), batch) - idle, 0.0)) for n in steps)  # type: ignore[misc]
