"""The time to reach an accuracy, interpolated between runs, and the fastest candidate for each decade."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from codegen.lab.efficiency.work_precision import Row


@dataclass(frozen=True)
class Place:
    """The fastest candidate for an error of 10^-decade, and the second fastest, with their CPU seconds."""

    decade: int
    winner: str
    seconds: float
    second: str = ""
    behind: float | None = None


def seconds_to(rows: Sequence[Row], error: float) -> float | None:
    """Return the CPU seconds that a candidate needs to reach ``error``; None if it does not reach it.

    The search begins at the row with the smallest error and continues to coarser runs while their errors are
    at most ``error``. In this way an accidentally small error of a coarse run is not used. Time and error are
    interpolated logarithmically between the last row found and the next coarser row. If there is no coarser
    row, the time of the coarsest row is returned. If a finer row took less time, its time is returned, so
    that the result never increases with ``error``.

    >>> from codegen.lab.efficiency.work_precision import Row
    >>> row = lambda e, s: Row("", "", "", 0, None, None, e, s, None, None, None, None, None, 0.0, 0.0)
    >>> round(seconds_to([row(1e-2, 1.0), row(1e-4, 4.0)], 1e-3), 9)
    2.0
    >>> seconds_to([row(1e-2, 1.0)], 1e-3) is None
    True
    >>> seconds_to([row(1e-2, 8.0), row(1e-4, 4.0), row(1e-5, 3.0)], 1e-3)
    3.0
    """
    good = [r for r in rows if r.error is not None and r.seconds]
    if not good or _error(min(good, key=_error)) > error:
        return None
    finest = k = good.index(min(good, key=_error))
    while k > 0 and _error(good[k - 1]) <= error:
        k -= 1
    least = min(_time(r) for r in good[k : finest + 1])
    if k == 0 or _error(good[k]) == 0:
        return least
    a, b = good[k - 1], good[k]
    part = math.log(_error(a) / error) / math.log(_error(a) / _error(b))
    return min(least, float(_time(a) * (_time(b) / _time(a)) ** part))


def _error(row: Row) -> float:
    assert row.error is not None
    return row.error


def _time(row: Row) -> float:
    assert row.seconds is not None
    return row.seconds


def places(entries: Mapping[str, Sequence[Row]], decades: Sequence[int] = range(2, 15)) -> tuple[Place, ...]:
    """Return the fastest candidate for each decade of accuracy that some candidate reaches."""
    result = []
    for decade in decades:
        times = {label: seconds_to(rows, 10.0**-decade) for label, rows in entries.items()}
        ordered = sorted((t, label) for label, t in times.items() if t is not None)
        if ordered:
            (best, winner), *others = ordered
            behind, second = others[0] if others else (None, "")
            result.append(Place(decade, winner, best, second, behind))
    return tuple(result)
