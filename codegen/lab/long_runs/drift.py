"""Decides whether a conserved quantity drifts in a long run.

Consecutive deviations of the quantity are correlated. Therefore the record of the deviations is cut into long
blocks. A line is fitted to the means over the blocks, and the confidence interval of its slope follows from
Student's distribution (method of batch means).

A slope different from zero can have three causes:

- The deviation varies slowly.
- The deviation is a random walk.
- The deviation grows systematically.

Only systematic growth is called a drift. The slope counts as a drift only if both of the following conditions
hold:

- The record is cut into five sections, and the means of the five sections are monotone. If the deviation
  only varies slowly, these means are usually not monotone.
- At least one of two tests shows that the deviation is not a random walk. The limits of the tests are
  :data:`STRAIGHT` and :data:`STEADY`. The test with :data:`STRAIGHT` is due to J. D. Sargan and A. Bhargava,
  Econometrica 51 (1983) 153.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy

BLOCKS = 20
FEWEST = 2 * BLOCKS
"""A line is fitted to the deviations of a run only if there are at least FEWEST samples."""

CONFIDENCE = 0.95
PARTS = 5
"""A record of deviations is cut into PARTS sections.

A drift is found only if the mean deviations of these sections form a monotone sequence.
"""

ROUNDING = "rounding"
"""The verdict on a deviation that rounding errors can cause."""

LOST = 1.0
"""A conserved quantity counts as lost if its relative deviation is at least LOST."""

BOUNDED, WALK = 0.25, 0.75
"""Limits for the exponent p of a deviation that grows like t^p, where t is the time.

A value between BOUNDED and WALK suggests a random walk.
"""

LATE, LATE_CONFINED = 1.5, 2.0
"""Two limits for the growth factor of the deviations in a run.

The growth factor is the largest deviation in the run, divided by the largest deviation in the first half of
the run. The scatter of the deviations is defined at :data:`CONFINED`. LATE_CONFINED is used only if the
scatter is below CONFINED. LATE is used in all other cases.
"""

LEVEL, STAYS = 0.9, 0.5
"""Constants that define the saturation of a deviation.

Let t be the time at which the deviation first reaches LEVEL times its largest value. The deviation saturates
at t if t is in the first half of the record, and if all later deviations are at least STAYS times the largest
value.
"""

WALKING = (0.5, 1.6)
"""Limits for the variance ratio V_k/(k V_1) of a random walk.

The record of the deviations is cut into blocks. A line is fitted to the means of the deviations over the
blocks. Let r_i be the residual for block i, which is the mean over block i minus the value of the line. V_k
is the mean of (r_(i+k) - r_i)^2 over all i. Both limits are used for k = :data:`NEAR`. Only the lower limit
is used for k = :data:`FAR`.
"""

CONFINED = 0.04
"""A scatter below CONFINED is evidence that a record of deviations is not a random walk.

The record is cut into n blocks. The scatter is V/(n D). V is the variance of the block means, and D is the
variance of the differences between consecutive block means. Only 3 % of all random walks have a scatter below
CONFINED.
"""

STRAIGHT = 0.0225
"""A record does not count as a random walk if its scatter about a line is below STRAIGHT.

The record is cut into n blocks, and the mean of each block is computed. A line is fitted to these n means.
Let V be the variance of the residuals, and let D be the variance of the differences between consecutive
means. The scatter is V/(n D). Only 1 % of all random walks have a scatter below STRAIGHT.
"""

STEADY = 3.2
"""A limit for the steadiness of a record of deviations.

The record is cut into blocks, and the mean of each block is computed. Let m be the average difference between
consecutive means, and let s be the standard error of m. The steadiness is |m|/s. The steadiness is large if
the means grow or fall at a nearly constant rate. A record does not count as a random walk if its steadiness
is above STEADY. Only 1 % of all random walks have a steadiness above STEADY.
"""

TINY = 1e-24
"""A limit for differences that are caused by rounding errors.

A deviation is the difference between a conserved quantity and its exact value. The deviations in a run are
divided into blocks, and the mean of each block is computed. Let d be the largest absolute deviation in the
run, and let V be the variance of the differences between consecutive means. If V is below TINY times d^2, the
differences count as rounding errors.
"""

FINE, NEAR, FAR = 100, 5, 20
"""Constants for the tests with :data:`WALKING`, :data:`CONFINED` and :data:`STRAIGHT`.

These tests cut a record of deviations into at most FINE blocks.

The variance ratio V_k/(k V_1) is defined at :data:`WALKING`. The variance ratio is computed for k = NEAR and
for k = FAR. If a record has too few blocks for k = FAR, a smaller k is used.
"""


@dataclass(frozen=True)
class Drift:
    """The results of the tests for a drift of a conserved quantity.

    - ``slope``: the slope of the fitted line per unit of time, or NaN if too few deviations are finite.
    - ``half_width``: the half width of the 95 % confidence interval of the slope.
    - ``largest``: the largest absolute deviation of the record.
    - ``exponent``: the slope of log(d(t)) against log(t) in a linear fit. Here d(t) is the largest absolute
      deviation of the record up to the time t.
    - ``rounding``: the largest deviation that rounding errors can cause.
    - ``persists``: True if the means over consecutive sections of the record are monotone.
    - ``later``: the largest deviation of the record, divided by the largest deviation in the first half.
    - ``ratios``: two variance ratios (:data:`WALKING`), both about 1 for a random walk.
    - ``confined``: True if the deviation varies much less than a random walk (:data:`CONFINED`).
    - ``unlike_walk``: True if at least one of two tests shows that the deviation is not a random walk. One
      test measures the distance of the deviation from a line (:data:`STRAIGHT`). The other test measures
      whether the deviation grows steadily (:data:`STEADY`). Neither test uses :data:`CONFINED`.
    - ``until``: the time at which the deviation saturates, or None.
    - ``brief``: True if the run is shorter than the time span of the scene. A periodic deviation can look
      like a drift in such a run.
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
    brief: bool = False

    @property
    def is_drift(self) -> bool:
        """True if the confidence interval of the slope does not contain zero."""
        return abs(self.slope) > self.half_width

    @property
    def law(self) -> str:
        """The verdict on the deviation: the first of the following strings whose condition is true.

        - ``lost``: the largest deviation, relative to the size of the quantity, is at least 1. If the
          deviation saturates, the bound is 1/2 instead of 1.
        - ``exact``: all deviations are zero.
        - ``rounding``: the deviation is so small that rounding errors can cause it.
        - ``drift``: the attributes ``is_drift``, ``persists`` and ``unlike_walk`` are all True. If ``brief``
          is True, too, the verdict is ``too short to tell``.
        - ``bounded``: there is no drift, and the deviation does not grow.
        - ``random walk``: there is no drift, and the deviation grows like a random walk.
        - ``too short to tell``: the run is too short for a verdict.
        """
        if not self.largest < LOST or (self.until is not None and self.largest >= STAYS * LOST):
            return "lost"
        if self.largest == 0.0:
            return "exact"
        if self.largest <= self.rounding:
            return ROUNDING
        near, far = self.ratios
        walks = WALKING[0] < near < WALKING[1]
        grows_like_a_walk = walks and far > WALKING[0] and BOUNDED <= self.exponent < WALK
        if self.is_drift and self.persists and self.unlike_walk:
            return "too short to tell" if self.brief else "drift"
        if self.until is not None:
            return "bounded"
        ends = not walks and (self.exponent < BOUNDED or near < WALKING[0])
        steady = self.exponent < WALK and not self.is_drift
        confined = self.confined and steady and self.later <= LATE_CONFINED
        if confined or (ends and self.later <= LATE):
            return "bounded"
        return "random walk" if grows_like_a_walk else "too short to tell"

    @property
    def drifts(self) -> bool | None:
        """True if :attr:`law` is ``drift``, ``random walk`` or ``lost``.

        None if the run is too short for a verdict.
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

    - ``times``: the times of the samples, measured from the start of the run (decreasing in a backward run).
    - ``deviations``: the relative deviation at each sample.
    - ``peaks``, ``lows``: the largest and the smallest absolute deviation in the interval that ends at each
      sample. The default for both is the absolute value of the deviation at the sample.
    - ``rounding``: the largest deviation that rounding errors can cause.

    If a sample is not finite, only the samples before this sample are used, and the attribute ``largest`` of
    the result is infinite. If :func:`saturation` returns an index of at least :data:`FEWEST`, the fits use
    only the samples before this index.

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
    least[1:][signs[1:] * signs[:-1] < 0] = 0.0
    level = None if count < len(t) else saturation(size, least)
    until = None if level is None else float(t[level])
    if level is not None and level >= FEWEST:
        count = level
    fitted = _fitted(t[:count], y[:count], size[:count])
    return replace(fitted, largest=largest, rounding=rounding, until=until)


def saturation(peaks: Sequence[float] | numpy.ndarray, lows: Sequence[float] | numpy.ndarray) -> int | None:
    """Return the index of the sample at which a deviation saturates (see :data:`LEVEL`), or None.

    For each sample, ``peaks`` contains the largest absolute deviation since the previous sample. For each
    sample, ``lows`` contains the smallest absolute deviation since the previous sample.

    >>> saturation([0.1 * min(k, 10) for k in range(40)], [0.1 * min(k, 10) for k in range(40)])
    9
    """
    largest = max(peaks)
    first = int(numpy.argmax(numpy.asarray(peaks) >= LEVEL * largest))
    if not 0.0 < largest < math.inf or 2 * first >= len(peaks):
        return None
    return first if min(lows[first + 1 :]) >= STAYS * largest else None


def _fitted(t: numpy.ndarray, y: numpy.ndarray, size: numpy.ndarray) -> Drift:
    """Return the drift for finite deviations ``y`` at the times ``t``.

    For each of these times, ``size`` contains the largest absolute deviation since the previous time.
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
    x, z = _means(t, y, min(FINE, len(y) // 2))
    rest = z - numpy.polyval(numpy.polyfit(x, z, degree), x)
    increments = float(numpy.diff(z).var())
    # A variance of at most TINY is attributed to rounding errors.
    return float(rest.var()) / (len(z) * increments) if increments > TINY else 0.0


def _steadiness(t: numpy.ndarray, y: numpy.ndarray) -> float:
    """Return the steadiness |m|/s of a record, as defined at :data:`STEADY`."""
    increments = numpy.diff(_means(t, y, BLOCKS)[1])
    error = float(increments.std(ddof=1)) / math.sqrt(len(increments))
    return abs(float(increments.mean())) / error if error > 0.0 else math.inf


def _variance_ratios(t: numpy.ndarray, y: numpy.ndarray) -> tuple[float, float]:
    """Return the variance ratios for k = NEAR and k = FAR, as defined at :data:`WALKING`."""
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

    The weights are Hann's window. Fast oscillations nearly cancel in the weighted mean.
    """
    rows = []
    for a, b in zip(numpy.array_split(t, blocks), numpy.array_split(y, blocks), strict=True):
        weights = numpy.sin(math.pi * (numpy.arange(len(a)) + 0.5) / len(a)) ** 2
        rows.append((weights @ a / weights.sum(), weights @ b / weights.sum()))
    x, z = numpy.array(rows).T
    return x, z


def _slope(t: numpy.ndarray, y: numpy.ndarray) -> tuple[float, float]:
    """Return the slope of a line fitted to block means, and the half width of its confidence interval."""
    import scipy.stats

    x, z = _means(t, y, BLOCKS)
    centred = x - x.mean()
    slope = float(centred @ z / (centred @ centred))
    residual = z - z.mean() - slope * centred
    square = float(residual @ residual)
    error = math.sqrt(square / (BLOCKS - 2) / float(centred @ centred))
    # Let r be the correlation of consecutive residuals. The variance of the slope gets the factor
    # (1 + r)/(1 - r).
    r = max(float(residual[1:] @ residual[:-1]) / square, 0.0) if square > 0.0 else 0.0
    error *= math.sqrt((1 + r) / (1 - r))
    return slope, float(scipy.stats.t.ppf((1 + CONFIDENCE) / 2, BLOCKS - 2)) * error


def _exponent(t: numpy.ndarray, size: numpy.ndarray) -> float:
    """Return the slope of log(d) against log(t), where d is the largest deviation up to the time t."""
    largest = numpy.maximum.accumulate(size)
    late = (t >= t[0] + 0.1 * (t[-1] - t[0])) & (largest > 0)
    if late.sum() < 2:
        return 0.0
    return float(numpy.polyfit(numpy.log(t[late]), numpy.log(largest[late]), 1)[0])
