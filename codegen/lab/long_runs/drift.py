"""The drift of a conserved quantity: a slope with its confidence interval, and the growth of the deviation.

A record contains the deviations of the quantity along one trajectory. The deviations are correlated, so the
confidence interval of a least-squares line would be far too narrow. Therefore the record is cut into blocks
that are much longer than its oscillations. The means over the blocks are nearly independent. A line is fitted
to these means, and its confidence interval follows from Student's distribution (method of batch means).

A slow modulation also has a slope. Therefore a slope is a drift only if it persists: the record is divided
into five consecutive parts, and the means of the parts must be monotone. A sinusoid passes this test only if
its period is longer than 1.2 times the record.

A random walk also has a slope. Therefore a slope is a drift only if a random walk does not explain it
(:data:`STRAIGHT`, :data:`STEADY`). The test :data:`STRAIGHT` is due to J. D. Sargan and A. Bhargava,
Econometrica 51 (1983) 153.

The growth of a deviation may end, for example at a fixed point of the method. If the growth ends, the line is
fitted only to the part of the record before the deviation saturates.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy

BLOCKS = 20
FEWEST = 2 * BLOCKS
"""The smallest number of samples to which a line is fitted."""

CONFIDENCE = 0.95
PARTS = 5
"""The record is divided into PARTS parts. For a drift, the means of the parts must be monotone."""

LOST = 1.0
"""A conserved quantity is lost if its relative deviation is at least LOST. The deviation is then as large as
the quantity.
"""

BOUNDED, WALK = 0.25, 0.75
"""Limits of the exponent p of a deviation that grows like t^p. The deviation may be bounded if p is below
BOUNDED, and may be a random walk if p is between BOUNDED and WALK.
"""

LATE, LATE_CONFINED = 1.5, 2.0
"""The largest deviation of the whole record, divided by the largest deviation of its first half, is at most
LATE if the deviation is bounded.

If a random walk is excluded, the limit is LATE_CONFINED.
"""

LEVEL, STAYS = 0.9, 0.5
"""Let d be the largest deviation of the whole record. The deviation saturates if it reaches LEVEL times d
within the first half of the record, and is never smaller than STAYS times d afterwards.
"""

WALKING = (0.5, 1.6)
"""Bounds of the variance ratio of a random walk. The ratio is V_k/(k V_1), where V_k is the variance of the
increments over k blocks. The ratio is about 1 for a random walk and about 1/k for noise.
"""

CONFINED = 0.04
"""A record is not a random walk if its ratio V/(n D) is less than CONFINED.

Here V is the variance of the means of n blocks, and D is the variance of the increments between consecutive
means. The ratio is less than CONFINED for 3 % of all random walks.
"""

STRAIGHT = 0.0225
"""A random walk does not explain the slope of a record if the ratio V/(n D) is less than STRAIGHT.

Here V is the variance of the means of n blocks about a fitted line, and D is the variance of the increments
between consecutive means. The ratio is less than STRAIGHT for 1 % of all random walks.
"""

STEADY = 3.2
"""A random walk does not explain the slope of a record if the mean increment between block means exceeds
STEADY times its standard error.

The mean increment exceeds this limit for 1 % of all random walks over BLOCKS blocks.
"""

TINY = 1e-24
"""A variance below TINY times the square of the largest deviation is attributed to rounding errors."""

FINE, NEAR, FAR = 100, 5, 20
"""For two variance ratios the record is divided into FINE blocks. One ratio is for increments over NEAR
blocks, the other for increments over FAR blocks.
"""


@dataclass(frozen=True)
class Drift:
    """The result of a fit: the slope per unit of time, the half width of its 95 % interval, and the growth.

    - ``exponent``: the largest deviation up to the time t grows like t^``exponent``. The exponent is about 0
      for a bounded deviation, 1/2 for a random walk and 1 for a drift.
    - ``largest``: the largest deviation of the record.
    - ``rounding``: the largest deviation that rounding errors can explain.
    - ``persists``: True if the means over consecutive parts of the record are monotone.
    - ``confined``: True if the deviation varies much less than a random walk (:data:`CONFINED`).
    - ``unlike_walk``: True if a random walk does not explain the slope (:data:`STRAIGHT`, :data:`STEADY`).
    - ``later``: the largest deviation divided by the largest deviation of the first half.
    - ``ratios``: the variance ratios of increments over NEAR and over FAR blocks (:data:`WALKING`).
    - ``until``: the time at which the deviation saturates, or None. Only the record before this time is
      fitted.

    If too few values are finite, the slope is NaN.
    """

    slope: float
    half_width: float
    largest: float
    exponent: float
    rounding: float = 0.0
    persists: bool = True
    later: float = 1.0
    ratios: tuple[float, float] = (0.0, 0.0)
    confined: bool = False
    unlike_walk: bool = True
    until: float | None = None

    @property
    def is_drift(self) -> bool:
        """True if the interval of the slope excludes zero."""
        return abs(self.slope) > self.half_width

    @property
    def law(self) -> str:
        """The verdict in words.

        - ``lost``: the deviation reaches the size of the quantity, or saturates above half of this size.
        - ``exact``: there is no deviation.
        - ``rounding``: rounding errors can explain the deviation.
        - ``drift``: the interval of the slope excludes zero, the slope persists, and a random walk does not
          explain it.
        - ``bounded``: there is no drift, and the deviation does not grow.
        - ``random walk``: there is no drift, and the deviation grows like a random walk.
        - ``too short to tell``: all other cases.
        """
        if not self.largest < LOST or (self.until is not None and self.largest >= STAYS * LOST):
            return "lost"
        if self.largest == 0.0:
            return "exact"
        if self.largest <= self.rounding:
            return "rounding"
        near, far = self.ratios
        walks = WALKING[0] < near < WALKING[1]
        grows_like_a_walk = walks and far > WALKING[0] and BOUNDED <= self.exponent < WALK
        if self.is_drift and self.persists and self.unlike_walk:
            return "drift"
        if self.until is not None:
            return "bounded"
        ends = not walks and (self.exponent < BOUNDED or near < WALKING[0])
        # If the signs of a growing deviation alternate, its mean does not grow. Therefore the growth exponent
        # is also tested.
        steady = self.exponent < WALK and not self.is_drift
        confined = self.confined and steady and self.later <= LATE_CONFINED
        if confined or (ends and self.later <= LATE):
            return "bounded"
        return "random walk" if grows_like_a_walk else "too short to tell"

    @property
    def drifts(self) -> bool | None:
        """True for a drift, a random walk or a lost quantity. The value is None if the run is too short, and
        False in all other cases.
        """
        return None if self.law == "too short to tell" else self.law in ("drift", "lost", "random walk")

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON. Numbers that are not finite become None."""
        numbers = {
            "largest": self.largest,
            "slope": self.slope,
            "half_width": self.half_width,
            "exponent": self.exponent,
        }
        data: dict[str, object] = {name: x if math.isfinite(x) else None for name, x in numbers.items()}
        return data | {"saturates_at": self.until, "law": self.law, "drifts": self.drifts}


def fit(
    times: Sequence[float],
    deviations: Sequence[float],
    peaks: Sequence[float] | None = None,
    rounding: float = 0.0,
    lows: Sequence[float] | None = None,
) -> Drift:
    """Return the drift of a quantity from its relative deviations at sampled times.

    ``times`` are measured from the start, and decrease in a backward run. ``peaks`` and ``lows`` are the
    largest and the smallest absolute deviations in the intervals that end at the samples. By default they are
    the absolute values of the samples. If a value is not finite, the slope is fitted to the earlier values,
    and the largest deviation is infinite. If the deviation saturates after at least :data:`FEWEST` samples,
    the slope is fitted to the samples before the saturation.

    >>> found = fit([float(k) for k in range(1, 401)], [1e-9 * k for k in range(1, 401)])
    >>> f"{found.slope:.1e}", found.law, found.is_drift
    ('1.0e-09', 'drift', True)
    """
    if len(times) < FEWEST:
        raise ValueError(f"expected at least {FEWEST} samples, found {len(times)}")
    t, y = numpy.array(times, dtype=float), numpy.array(deviations, dtype=float)
    size = numpy.abs(y) if peaks is None else numpy.array(peaks, dtype=float)
    finite = numpy.isfinite(y) & numpy.isfinite(size)
    count = len(t) if finite.all() else int(numpy.argmin(finite))
    largest = float(size.max()) if count == len(t) else math.inf
    if count < FEWEST:
        return Drift(math.nan, math.nan, largest, math.nan, rounding)
    least = numpy.abs(y) if lows is None else numpy.array(lows, dtype=float)
    signs = numpy.sign(y)
    # If the deviation changes its sign between two samples, its smallest absolute value is zero.
    least[1:][signs[1:] * signs[:-1] < 0] = 0.0
    level = None if count < len(t) else saturation(size, least)
    until = None if level is None else float(t[level])
    if level is not None and level >= FEWEST:
        count = level
    fitted = _fitted(t[:count], y[:count], size[:count])
    return replace(fitted, largest=largest, rounding=rounding, until=until)


def saturation(peaks: Sequence[float] | numpy.ndarray, lows: Sequence[float] | numpy.ndarray) -> int | None:
    """Return the index of the sample at which a deviation saturates, or None.

    >>> saturation([0.1 * min(k, 10) for k in range(40)], [0.1 * min(k, 10) for k in range(40)])
    9
    """
    largest = max(peaks)
    first = int(numpy.argmax(numpy.asarray(peaks) >= LEVEL * largest))
    if not 0.0 < largest < math.inf or 2 * first >= len(peaks):
        return None
    return first if min(lows[first + 1 :]) >= STAYS * largest else None


def _fitted(t: numpy.ndarray, y: numpy.ndarray, size: numpy.ndarray) -> Drift:
    """Return the drift for finite times ``t``, deviations ``y`` and peaks ``size``."""
    whole, scale = float(t[-1]), float(size.max()) or 1.0
    # Times and values are scaled, so that their squares do not overflow.
    t, y, size = t / whole, y / scale, size / scale
    slope, half = _slope(t, y)
    means = _means(t, y, PARTS)[1].tolist()
    early = float(size[: (len(size) + 1) // 2].max())
    factor = scale / whole
    return Drift(
        slope * factor,
        half * abs(factor),
        scale,
        _exponent(t, size),
        persists=all((b - a) * slope > 0 for a, b in pairwise(means)),
        later=1.0 / early if early else math.inf,
        ratios=_variance_ratios(t, y),
        confined=_spread(t, y, 0) < CONFINED,
        unlike_walk=_spread(t, y, 1) < STRAIGHT or _steadiness(t, y) > STEADY,
    )


def _spread(t: numpy.ndarray, y: numpy.ndarray, degree: int) -> float:
    """Return the ratio V/(n D) for the means of n blocks.

    V is the variance of the means about a fitted polynomial, and D is the variance of the increments between
    consecutive means (:data:`CONFINED`, :data:`STRAIGHT`).
    """
    x, z = _means(t, y, min(FINE, len(y) // 2))
    rest = z - numpy.polyval(numpy.polyfit(x, z, degree), x)
    increments = float(numpy.diff(z).var())
    # If the increments are constant up to rounding errors, the means lie on a line, and the variance is zero.
    return float(rest.var()) / (len(z) * increments) if increments > TINY else 0.0


def _steadiness(t: numpy.ndarray, y: numpy.ndarray) -> float:
    """Return the absolute mean increment of the block means, divided by its standard error."""
    increments = numpy.diff(_means(t, y, BLOCKS)[1])
    error = float(increments.std(ddof=1)) / math.sqrt(len(increments))
    return abs(float(increments.mean())) / error if error > 0.0 else math.inf


def _variance_ratios(t: numpy.ndarray, y: numpy.ndarray) -> tuple[float, float]:
    """Return the variance ratios (:data:`WALKING`) of the residuals of a line through the block means."""
    x, z = _means(t, y, min(FINE, len(y) // 2))
    rest = z - numpy.polyval(numpy.polyfit(x, z, 1), x)

    def variance(lag: int) -> float:
        return float(numpy.square(rest[lag:] - rest[:-lag]).mean())

    one = variance(1)
    far = min(FAR, len(rest) // 2)
    if one < TINY:
        return 0.0, 0.0
    return variance(NEAR) / (NEAR * one), variance(far) / (far * one)


def _means(t: numpy.ndarray, y: numpy.ndarray, blocks: int) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Return the means of times and values over blocks.

    The weights decrease towards both ends of a block (Hann's window), so that short oscillations nearly
    cancel.
    """
    rows = []
    for a, b in zip(numpy.array_split(t, blocks), numpy.array_split(y, blocks), strict=True):
        weights = numpy.sin(math.pi * (numpy.arange(len(a)) + 0.5) / len(a)) ** 2
        rows.append((weights @ a / weights.sum(), weights @ b / weights.sum()))
    x, z = numpy.array(rows).T
    return x, z


def _slope(t: numpy.ndarray, y: numpy.ndarray) -> tuple[float, float]:
    """Return the slope of a line through block means, and the half width of its 95 % confidence interval."""
    import scipy.stats

    x, z = _means(t, y, BLOCKS)
    centred = x - x.mean()
    slope = float(centred @ z / (centred @ centred))
    residual = z - z.mean() - slope * centred
    square = float(residual @ residual)
    error = math.sqrt(square / (BLOCKS - 2) / float(centred @ centred))
    # If consecutive residuals have the correlation r, the variance of the slope is (1 + r)/(1 - r) times the
    # variance for independent residuals.
    r = max(float(residual[1:] @ residual[:-1]) / square, 0.0) if square > 0.0 else 0.0
    error *= math.sqrt((1 + r) / (1 - r))
    return slope, float(scipy.stats.t.ppf((1 + CONFIDENCE) / 2, BLOCKS - 2)) * error


def _exponent(t: numpy.ndarray, size: numpy.ndarray) -> float:
    """Return the slope of log(d) against log(t), where d is the largest deviation up to the time t.

    The first tenth of the record is omitted.
    """
    largest = numpy.maximum.accumulate(size)
    late = (t >= t[0] + 0.1 * (t[-1] - t[0])) & (largest > 0)
    if late.sum() < 2:
        return 0.0
    return float(numpy.polyfit(numpy.log(t[late]), numpy.log(largest[late]), 1)[0])
