"""Limits on the work of a check. If a check reaches a limit, the reported orders are lower bounds."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

MAX_CONDITIONS = 50_000
"""The default limit on the number of conditions of one order."""


@dataclass(frozen=True)
class Limits:
    """The limits of one check. A limit that is None has no effect.

    - ``conditions``: the largest number of conditions of one order.
    - ``seconds``: the longest time of the check.
    - ``megabytes``: the largest memory of the process.

    Time and memory are measured only before each batch of conditions.
    """

    conditions: int = MAX_CONDITIONS
    seconds: float | None = None
    megabytes: int | None = None


@dataclass
class Meter:
    """Counts the conditions that one check evaluates, and compares the work with the limits of the check.

    >>> meter = Meter(Limits(conditions=10))
    >>> meter.count(8)
    >>> meter.stops(2), meter.stops(3), meter.total
    (False, True, 8)
    """

    limits: Limits = Limits()
    total: int = 0
    of_order: int = 0
    started: float = field(default_factory=time.monotonic)

    def next_order(self) -> None:
        """Reset the number of conditions of the current order to zero."""
        self.of_order = 0

    def count(self, conditions: int) -> None:
        """Add ``conditions`` to the total count and to the count of the current order."""
        self.total += conditions
        self.of_order += conditions

    def stops(self, more: int) -> bool:
        """Return True if the check exceeds a limit on time, on memory or on the number of conditions.

        ``more`` is the number of conditions to be evaluated next. The limit ``limits.conditions`` applies to
        the sum of ``more`` and the number of evaluated conditions of the current order.
        """
        limits = self.limits
        if self.of_order + more > limits.conditions:
            return True
        if limits.seconds is not None and time.monotonic() - self.started > limits.seconds:
            return True
        return limits.megabytes is not None and resident_megabytes() > limits.megabytes


def resident_megabytes() -> float:
    """Return the memory that this process uses, in megabytes.

    If the system does not report this number, return the peak memory of the process. On Windows, return 0.

    >>> resident_megabytes() >= 0
    True
    """
    try:
        with open("/proc/self/statm", encoding="ascii") as stream:
            pages = int(stream.read().split()[1])
    except (OSError, IndexError, ValueError):
        return _largest_megabytes()
    import resource

    return pages * resource.getpagesize() / 2**20


def _largest_megabytes() -> float:
    try:
        import resource
    except ImportError:  # Python on Windows has no module ``resource``.
        return 0.0
    import sys

    largest = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return largest / (2**20 if sys.platform == "darwin" else 2**10)
