"""Drift of what should stay: a slope with its confidence interval, and the law by which deviations grow.

Errors along one trajectory are correlated, so the interval of a least-squares line would be far too narrow.
The record is cut into blocks much longer than its oscillations; block means are nearly independent, and a
line through them has an honest interval from Student's distribution (batch means).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

BLOCKS = 20
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Drift:
    """The slope per unit of time with its half width at 95 %, the largest deviation, and the growth exponent.

    ``exponent`` p says that the largest deviation so far grows like t^p: 0 where it is bounded, 1/2 for the
    random walk of rounding errors, 1 for a drift.
    """

    slope: float
    half_width: float
    largest: float
    exponent: float

    @property
    def is_drift(self) -> bool:
        """Whether the interval of the slope leaves out zero."""
        return abs(self.slope) > self.half_width

    @property
    def law(self) -> str:
        """The growth in words."""
        if self.largest == 0.0:
            return "exact"
        if self.exponent < 0.25:
            return "bounded"
        return "random walk" if self.exponent < 0.75 else "drift"


def fit(times: Sequence[float], deviations: Sequence[float]) -> Drift:
    """Return the drift of deviations from an initial value, sampled after the start at times that increase,
    or that decrease, as in a run backwards.

    >>> found = fit([float(k) for k in range(1, 401)], [1e-9 * k for k in range(1, 401)])
    >>> f"{found.slope:.1e}", found.law, found.is_drift
    ('1.0e-09', 'drift', True)
    """
    import numpy
    import scipy.stats

    t, y = numpy.array(times, dtype=float), numpy.array(deviations, dtype=float)
    if len(t) < 2 * BLOCKS:
        raise ValueError(f"expected at least {2 * BLOCKS} samples, found {len(t)}")
    whole = float(t[-1])
    t /= whole  # squares of very short and very long times are no doubles
    blocks = [(a.mean(), b.mean()) for a, b in _cut(t, y)]
    x, z = numpy.array(blocks).T
    centred = x - x.mean()
    slope = float(centred @ z / (centred @ centred))
    residual = z - z.mean() - slope * centred
    error = math.sqrt(float(residual @ residual) / (BLOCKS - 2) / float(centred @ centred))
    half = float(scipy.stats.t.ppf((1 + CONFIDENCE) / 2, BLOCKS - 2)) * error
    return Drift(slope / whole, half / abs(whole), float(numpy.abs(y).max()), _exponent(t, numpy.abs(y)))


def _cut(t: Any, y: Any) -> list[tuple[Any, Any]]:
    import numpy

    return list(zip(numpy.array_split(t, BLOCKS), numpy.array_split(y, BLOCKS), strict=True))


def _exponent(t: Any, size: Any) -> float:
    """Return the slope of log(largest so far) against log t over the later nine tenths of the record."""
    import numpy

    largest = numpy.maximum.accumulate(size)
    late = (t >= t[0] + 0.1 * (t[-1] - t[0])) & (largest > 0)
    if late.sum() < 2:
        return 0.0
    return float(numpy.polyfit(numpy.log(t[late]), numpy.log(largest[late]), 1)[0])
