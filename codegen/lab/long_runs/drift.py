"""The drift of a conserved quantity: a slope with its confidence interval, and the growth of the deviation.

Errors along one trajectory are correlated, so the interval of a least-squares line would be far too narrow.
The record is cut into blocks much longer than its oscillations. Block means are nearly independent, and a
line through them has a valid interval from Student's distribution (batch means).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy

BLOCKS = 20
CONFIDENCE = 0.95

LOST = 1.0
"""Relative deviation from which a quantity counts as lost: the error is as large as the quantity itself."""

BOUNDED, WALK = 0.25, 0.75
"""A deviation counts as bounded if its growth exponent is below BOUNDED, and as a random walk if the exponent
is between BOUNDED and WALK."""


@dataclass(frozen=True)
class Drift:
    """The slope per unit of time, the half width of its 95 % interval, the largest deviation, and its growth.

    ``exponent`` p means that the largest deviation grows like t^p: 0 if it is bounded, 1/2 for a random
    walk, 1 for a drift. ``rounding`` is the largest deviation that rounding errors can explain. If too few
    values are finite, the slope is NaN.
    """

    slope: float
    half_width: float
    largest: float
    exponent: float
    rounding: float = 0.0

    @property
    def is_drift(self) -> bool:
        """Whether the interval of the slope excludes zero."""
        return abs(self.slope) > self.half_width

    @property
    def law(self) -> str:
        """The verdict in words.

        ``lost``: the deviation reaches the size of the quantity. ``exact``: there is no deviation.
        ``rounding``: rounding errors can explain the deviation. Otherwise the growth exponent decides between
        ``bounded``, ``random walk`` and ``drift``. The verdict is ``too short to tell`` if the deviation
        grows but the interval of the slope contains zero.
        """
        if not self.largest < LOST:
            return "lost"
        if self.largest == 0.0:
            return "exact"
        if self.largest <= self.rounding:
            return "rounding"
        if self.exponent < BOUNDED:
            return "bounded"
        if not self.is_drift:
            return "too short to tell"
        return "random walk" if self.exponent < WALK else "drift"

    def as_json(self) -> dict[str, object]:
        """Return plain data; numbers that are not finite are null."""
        numbers = {
            "largest": self.largest,
            "slope": self.slope,
            "half_width": self.half_width,
            "exponent": self.exponent,
        }
        return {name: x if math.isfinite(x) else None for name, x in numbers.items()} | {"law": self.law}


def fit(
    times: Sequence[float],
    deviations: Sequence[float],
    peaks: Sequence[float] | None = None,
    rounding: float = 0.0,
) -> Drift:
    """Return the drift of a quantity from its relative deviations at sampled times.

    ``times`` are measured from the start; they decrease in a backward run. A peak is the largest absolute
    deviation in the interval that ends at a sample; ``peaks`` are by default the absolute values of the
    samples. If a value is not finite, the slope is fitted to the values before it, and the largest deviation
    is infinite.

    >>> found = fit([float(k) for k in range(1, 401)], [1e-9 * k for k in range(1, 401)])
    >>> f"{found.slope:.1e}", found.law, found.is_drift
    ('1.0e-09', 'drift', True)
    """
    if len(times) < 2 * BLOCKS:
        raise ValueError(f"expected at least {2 * BLOCKS} samples, found {len(times)}")
    t, y = numpy.array(times, dtype=float), numpy.array(deviations, dtype=float)
    size = numpy.abs(y) if peaks is None else numpy.array(peaks, dtype=float)
    finite = numpy.isfinite(y) & numpy.isfinite(size)
    count = len(t) if finite.all() else int(numpy.argmin(finite))
    largest = float(size.max()) if count == len(t) else math.inf
    if count < 2 * BLOCKS:
        return Drift(math.nan, math.nan, largest, math.nan, rounding)
    whole, scale = float(t[count - 1]), float(size[:count].max()) or 1.0
    # The values are scaled, so that their squares do not overflow.
    t, y, size = t[:count] / whole, y[:count] / scale, size[:count] / scale
    slope, half = _slope(t, y)
    factor = scale / whole
    return Drift(slope * factor, half * abs(factor), largest, _exponent(t, size), rounding)


def _slope(t: numpy.ndarray, y: numpy.ndarray) -> tuple[float, float]:
    """Return the slope of a line through block means, and the half width of its interval."""
    import scipy.stats

    pairs = zip(numpy.array_split(t, BLOCKS), numpy.array_split(y, BLOCKS), strict=True)
    x, z = numpy.array([(a.mean(), b.mean()) for a, b in pairs]).T
    centred = x - x.mean()
    slope = float(centred @ z / (centred @ centred))
    residual = z - z.mean() - slope * centred
    error = math.sqrt(float(residual @ residual) / (BLOCKS - 2) / float(centred @ centred))
    return slope, float(scipy.stats.t.ppf((1 + CONFIDENCE) / 2, BLOCKS - 2)) * error


def _exponent(t: numpy.ndarray, size: numpy.ndarray) -> float:
    """Return the slope of log(largest so far) against log t over the later nine tenths of the record."""
    largest = numpy.maximum.accumulate(size)
    late = (t >= t[0] + 0.1 * (t[-1] - t[0])) & (largest > 0)
    if late.sum() < 2:
        return 0.0
    return float(numpy.polyfit(numpy.log(t[late]), numpy.log(largest[late]), 1)[0])
