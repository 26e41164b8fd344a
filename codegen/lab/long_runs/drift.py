"""Decides whether a conserved quantity drifts in a long run.

A record contains the deviations of the quantity along one trajectory. The usual confidence interval of a
fitted line assumes independent deviations. Consecutive deviations are correlated, so the usual interval would
be far too narrow. Therefore the record is cut into long blocks. The means over the blocks are nearly
independent. A line is fitted to these means, and the confidence interval of its slope follows from Student's
distribution (method of batch means).

A slope different from zero can have three causes:

- The deviation may vary slowly. To exclude a slow variation, the record is divided into five consecutive
  sections. The slope counts as a drift only if the means over the sections are monotone. For a sinusoid with
  a period longer than two sections, the means are monotone only if the period is longer than 1.2 times
  the record.
- The deviation may be a random walk. Two tests compare the record with random walks (:data:`STRAIGHT`,
  :data:`STEADY`). The slope counts as a drift only if at least one of the two tests excludes a random walk.
  The test with STRAIGHT is due to J. D. Sargan and A. Bhargava, Econometrica 51 (1983) 153.
- The deviation may grow systematically. Only systematic growth is called a drift.

A deviation may stop growing, for example because the method reaches a fixed point. The line is then fitted
only to the part of the record in which the deviation grows.
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
"""The number of consecutive sections of a record.

The slope of a record counts as a drift only if the means over the sections are monotone.
"""

LOST = 1.0
"""A conserved quantity counts as lost if its relative deviation is at least LOST."""

BOUNDED, WALK = 0.25, 0.75
"""Limits for the exponent p of a deviation that grows like t^p, where t is the time.

A value of p below BOUNDED suggests a bounded deviation. A value between BOUNDED and WALK suggests a random
walk.
"""

LATE, LATE_CONFINED = 1.5, 2.0
"""Limits for the growth factor of a deviation that counts as bounded.

The growth factor is the largest deviation of the record, divided by the largest deviation of its first half.
The usual limit is LATE. The limit is LATE_CONFINED if the scatter is below :data:`CONFINED`.
"""

LEVEL, STAYS = 0.9, 0.5
"""Limits for a deviation that saturates: it grows and then remains large.

Let d be the largest deviation of the record. A saturating deviation reaches LEVEL times d in the first half
of the record. After this time, the deviation is at least STAYS times d.
"""

WALKING = (0.5, 1.6)
"""Limits for the variance ratio of a random walk. For the distance FAR, only the lower limit is used.

The record is divided into blocks, and a line is fitted to the means over the blocks. Let r_i be the residual
of block i in this fit, and V_k the mean of (r_(i+k) - r_i)^2 over all i. The variance ratio is V_k/(k V_1),
where k is the distance in blocks. The variance ratio is about 1 for a random walk, and about 1/k for
independent deviations.
"""

CONFINED = 0.04
"""A limit for the scatter of a record. If the scatter is below the limit, a random walk is excluded.

The record of the deviation is divided into n blocks. Let V be the variance of the means over the blocks, and
D the variance of the differences between consecutive means. The scatter is V/(n D). Only 3 % of all random
walks have a scatter below CONFINED.
"""

STRAIGHT = 0.0225
"""A limit for the scatter about a line. If the scatter is below the limit, a random walk is excluded.

The record is divided into n blocks, and a line is fitted to the means over the blocks. Let V be the variance
of the residuals of this fit, and D the variance of the differences between consecutive means. The scatter is
V/(n D). Only 1 % of all random walks have a scatter below STRAIGHT.
"""

STEADY = 3.2
"""A limit for the steadiness of a record. If the steadiness is above the limit, a random walk is excluded.

The record is divided into BLOCKS blocks. Let m be the average difference between the means of consecutive
blocks, and s the standard error of m. The steadiness is |m|/s. Only 1 % of all random walks have a steadiness
above STEADY.
"""

TINY = 1e-24
"""A limit for the variance of the differences between block means.

The limit is TINY times the square of the largest deviation. A smaller variance is attributed to rounding
errors.
"""

FINE, NEAR, FAR = 100, 5, 20
"""FINE is the number of blocks for the scatter and for two variance ratios (:data:`WALKING`).

The two variance ratios have the distances k = NEAR and k = FAR. If a record is short, it has fewer than FINE
blocks, and the second distance is at most half the number of blocks.
"""


@dataclass(frozen=True)
class Drift:
    """The results of the tests for a drift of a conserved quantity. The verdict is :attr:`law`.

    - ``slope``: the slope of the fitted line per unit of time, or NaN if too few deviations are finite.
    - ``half_width``: the half width of the 95 % confidence interval of the slope.
    - ``largest``: the largest absolute deviation of the record.
    - ``exponent``: the exponent p of growth. The largest deviation up to the time t grows like t^p. The
      exponent is about 0 for a bounded deviation, 1/2 for a random walk and 1 for a drift.
    - ``rounding``: the largest deviation that rounding errors can cause.
    - ``persists``: True if the means over consecutive sections of the record are monotone.
    - ``later``: the growth factor (:data:`LATE`) of the deviation.
    - ``ratios``: two variance ratios (:data:`WALKING`). For a random walk, both ratios are about 1.
    - ``confined``: True if the deviation varies much less than a random walk (:data:`CONFINED`).
    - ``unlike_walk``: True if :data:`STRAIGHT` or :data:`STEADY` excludes a random walk.
    - ``until``: the time at which the deviation saturates, or None. The line is fitted to the record before
      this time.
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
        """True if the confidence interval of the slope does not contain zero."""
        return abs(self.slope) > self.half_width

    @property
    def law(self) -> str:
        """The verdict on the deviation: one of the following strings.

        - ``lost``: the deviation reaches the size of the quantity. If the deviation saturates, half of this
          size is enough.
        - ``exact``: all deviations are zero.
        - ``rounding``: the deviation is so small that rounding errors can cause it.
        - ``drift``: the attributes ``is_drift``, ``persists`` and ``unlike_walk`` are all True.
        - ``bounded``: there is no drift, and the deviation does not grow.
        - ``random walk``: there is no drift, and the deviation grows like a random walk.
        - ``too short to tell``: the run is too short for a verdict.
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
        # If a deviation grows with alternating sign, the means over blocks do not grow, and ``is_drift`` is
        # False. The exponent is large in this case, so ``steady`` tests the exponent.
        steady = self.exponent < WALK and not self.is_drift
        confined = self.confined and steady and self.later <= LATE_CONFINED
        if confined or (ends and self.later <= LATE):
            return "bounded"
        return "random walk" if grows_like_a_walk else "too short to tell"

    @property
    def drifts(self) -> bool | None:
        """True if the verdict :attr:`law` is ``drift``, ``random walk`` or ``lost``.

        None if the run is too short for a verdict. False for the other verdicts.
        """
        return None if self.law == "too short to tell" else self.law in ("drift", "lost", "random walk")

    def as_json(self) -> dict[str, object]:
        """Return a dictionary that can be written as JSON. Numbers that are not finite become None."""
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
    """Return the drift of a quantity, computed from its relative deviations.

    - ``times``: the times of the samples, measured from the start of the run. In a backward run, the times
      decrease.
    - ``deviations``: the relative deviation at each sample.
    - ``peaks``, ``lows``: the largest and the smallest absolute deviation in the interval that ends at each
      sample. The default for both is the absolute value of the deviation at the sample.
    - ``rounding``: the largest deviation that rounding errors can cause.

    A line is fitted to the samples. If a sample is not finite, only the samples before this sample are used,
    and the attribute ``largest`` of the result is infinite. If the deviation saturates (:data:`STAYS`)
    after at least :data:`FEWEST` samples, only the samples before the saturation are used.

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
    # If the sign has changed since the previous sample, the smallest absolute deviation is zero.
    least[1:][signs[1:] * signs[:-1] < 0] = 0.0
    level = None if count < len(t) else saturation(size, least)
    until = None if level is None else float(t[level])
    if level is not None and level >= FEWEST:
        count = level
    fitted = _fitted(t[:count], y[:count], size[:count])
    return replace(fitted, largest=largest, rounding=rounding, until=until)


def saturation(peaks: Sequence[float] | numpy.ndarray, lows: Sequence[float] | numpy.ndarray) -> int | None:
    """Return the index of the sample at which a deviation saturates, or None if it does not saturate.

    ``peaks`` and ``lows`` contain the largest and the smallest absolute deviation in the interval that ends
    at each sample. The constants :data:`LEVEL` and :data:`STAYS` define when a deviation saturates.

    >>> saturation([0.1 * min(k, 10) for k in range(40)], [0.1 * min(k, 10) for k in range(40)])
    9
    """
    largest = max(peaks)
    first = int(numpy.argmax(numpy.asarray(peaks) >= LEVEL * largest))
    if not 0.0 < largest < math.inf or 2 * first >= len(peaks):
        return None
    return first if min(lows[first + 1 :]) >= STAYS * largest else None


def _fitted(t: numpy.ndarray, y: numpy.ndarray, size: numpy.ndarray) -> Drift:
    """Return the drift for samples at the times ``t``. All numbers must be finite.

    ``y`` contains the deviation of each sample. ``size`` contains the largest absolute deviation in the
    interval that ends at each sample.
    """
    whole, scale = float(t[-1]), float(size.max()) or 1.0
    # The scaling prevents an overflow in the squares of times and deviations.
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
    """Return the scatter of block means about a fitted polynomial of the given degree.

    The record is divided into n blocks, and the polynomial is fitted to the means over the blocks. Let V be
    the variance of the residuals of this fit, and D the variance of the differences between consecutive
    means. The scatter is V/(n D). The limit for the scatter is :data:`CONFINED` for the degree 0 and
    :data:`STRAIGHT` for the degree 1.
    """
    x, z = _means(t, y, min(FINE, len(y) // 2))
    rest = z - numpy.polyval(numpy.polyfit(x, z, degree), x)
    increments = float(numpy.diff(z).var())
    # If all increments are equal up to rounding errors, the means are on a line, and the scatter counts as 0.
    return float(rest.var()) / (len(z) * increments) if increments > TINY else 0.0


def _steadiness(t: numpy.ndarray, y: numpy.ndarray) -> float:
    """Return the steadiness of a record (:data:`STEADY`)."""
    increments = numpy.diff(_means(t, y, BLOCKS)[1])
    error = float(increments.std(ddof=1)) / math.sqrt(len(increments))
    return abs(float(increments.mean())) / error if error > 0.0 else math.inf


def _variance_ratios(t: numpy.ndarray, y: numpy.ndarray) -> tuple[float, float]:
    """Return the two variance ratios of a record (:data:`WALKING`, :data:`FINE`)."""
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
    """Return the weighted mean time and the weighted mean value of each block.

    The times ``t`` and the values ``y`` are divided into ``blocks`` consecutive blocks. The weights
    decrease towards both ends of a block (Hann's window). Short oscillations therefore nearly cancel in the
    mean.
    """
    rows = []
    for a, b in zip(numpy.array_split(t, blocks), numpy.array_split(y, blocks), strict=True):
        weights = numpy.sin(math.pi * (numpy.arange(len(a)) + 0.5) / len(a)) ** 2
        rows.append((weights @ a / weights.sum(), weights @ b / weights.sum()))
    x, z = numpy.array(rows).T
    return x, z


def _slope(t: numpy.ndarray, y: numpy.ndarray) -> tuple[float, float]:
    """Fit a line to block means. Return the slope, and the half width of its 95 % confidence interval."""
    import scipy.stats

    x, z = _means(t, y, BLOCKS)
    centred = x - x.mean()
    slope = float(centred @ z / (centred @ centred))
    residual = z - z.mean() - slope * centred
    square = float(residual @ residual)
    error = math.sqrt(square / (BLOCKS - 2) / float(centred @ centred))
    # Let r be the correlation of consecutive residuals. The variance of the slope is (1 + r)/(1 - r) times
    # the variance for independent residuals.
    r = max(float(residual[1:] @ residual[:-1]) / square, 0.0) if square > 0.0 else 0.0
    error *= math.sqrt((1 + r) / (1 - r))
    return slope, float(scipy.stats.t.ppf((1 + CONFIDENCE) / 2, BLOCKS - 2)) * error


def _exponent(t: numpy.ndarray, size: numpy.ndarray) -> float:
    """Return the exponent of growth: the slope of log(d) against log(t).

    Here t is the time, and d is the largest deviation up to this time. The first tenth of the record is not
    used.
    """
    largest = numpy.maximum.accumulate(size)
    late = (t >= t[0] + 0.1 * (t[-1] - t[0])) & (largest > 0)
    if late.sum() < 2:
        return 0.0
    return float(numpy.polyfit(numpy.log(t[late]), numpy.log(largest[late]), 1)[0])
