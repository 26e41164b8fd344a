"""Measures the order of a method in runs with different step sizes, and compares it with the stated order.

A slope is the logarithm of the ratio of the errors of two consecutive runs, divided by the logarithm of the
ratio of their step sizes. A run is excluded if it fails or if its error is too small to be measured. Slopes
are computed only for the longest sequence of consecutive runs that are not excluded.

Let k be the order of the method, and let r > 1 be the ratio of consecutive step sizes. Let p and q be two
consecutive slopes, where p belongs to the larger step sizes. For a smooth problem, the difference between a
slope and k is approximately proportional to the step size. Hence p - k is approximately r (q - k), and p - q
is approximately (r - 1) (q - k). Therefore |p - q|/(r - 1) is an estimate of |q - k|. The slopes have
*settled* if the last two of these estimates are at most :data:`SETTLED`.

The last slope and the stated order may differ by at most :data:`TOLERANCE`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

SETTLED = 0.1
TOLERANCE = 0.25
CLEAR = 100.0
"""A run is used for slopes only if the error of the run is larger than three bounds.

The bounds are CLEAR times the estimated rounding error of the state, CLEAR times the estimated error from the
rounding of the time, and CLEAR times the uncertainty of the reference solution. Let h and h/2 be the step
sizes of two such runs. Then each of the three errors changes the slope by less than 0.03.
"""

ZERO = 0.5
"""If the order measured with very short steps is at most ZERO, this order is ignored.

If the coefficients of a method are rounded, the measured order can be close to 0.
"""

FIRST = 5
"""The number of steps in the first run."""

LONGER = (2, 3, 4)
"""Numbers of steps of additional runs (:func:`refine`).

These numbers are smaller than :data:`FIRST`, so these runs have larger step sizes than the first run.
"""

LARGEST_UNIT = 20
"""The largest value of :attr:`Places.unit`. A larger value would allow too few runs with long steps."""

NEAR = 1e-12
"""Two times are equal if their difference is at most NEAR times the length of the time span."""


@dataclass(frozen=True)
class Places:
    """The permitted numbers of steps of a run: the multiples of ``unit``.

    If the solution crosses points where the field is not smooth, the error of a step across such a point
    depends on the position of the point in the step. Therefore the slopes settle only if this position is the
    same in all runs.

    - ``unit``: the smallest number of equal steps with which a step ends at each of the points. For example,
      ``unit`` is 3 for one point at a third of the time span. Without points, ``unit`` is 1.
    - ``known``: False if there are points, but no suitable ``unit``. Then ``unit`` is 1.
    """

    unit: int = 1
    known: bool = True

    @classmethod
    def of(
        cls, kinks: Sequence[int], times: Sequence[float], span: tuple[Fraction, Fraction], stated: int
    ) -> Places:
        """Return the permitted numbers of steps for a method of the order ``stated``.

        ``kinks`` and ``times`` are attributes of :class:`codegen.lab.reference.Reference`. All numbers of
        steps are permitted, and ``known`` is False, in the following cases:

        - At a point, the field has so few derivatives that the order is lower. Steps that end at this point
          would hide this.
        - The field jumps at a point. Because of rounding of the time, a stage at the end of a step could be
          on the wrong side of the jump.
        - No ``unit`` up to :data:`LARGEST_UNIT` is suitable.
        """
        if not kinks:
            return cls()
        if min(kinks) < max(0, stated - 2) or len(times) != len(kinks):
            return cls(known=False)
        first, length = span[0], span[1] - span[0]
        fractions = [float((Fraction(t) - first) / length) for t in times]
        near = [Fraction(x).limit_denominator(LARGEST_UNIT) for x in fractions]
        unit = math.lcm(*(x.denominator for x in near))
        exact = all(abs(x - float(y)) <= NEAR for x, y in zip(fractions, near, strict=True))
        return cls(unit) if exact and unit <= LARGEST_UNIT else cls(known=False)

    def steps(self, least: float) -> int:
        """Return the smallest permitted number of steps that is at least ``least``."""
        return math.ceil(least / self.unit) * self.unit


@dataclass(frozen=True)
class Run:
    """One run with ``steps`` steps of size ``h``, and the error of its final state.

    If the error is not used to measure the order, ``excluded`` is the reason. Otherwise ``excluded`` is
    empty.
    """

    steps: int
    h: float
    error: float
    excluded: str = ""


@dataclass(frozen=True)
class Refinement:
    """Runs of a method with different step sizes.

    In ``runs``, the step sizes decrease. ``short`` is the order measured with very short steps
    (:mod:`codegen.lab.orders.short_steps`), or None if it was not measured.
    """

    runs: tuple[Run, ...]
    short: float | None = None

    @property
    def clean(self) -> tuple[Run, ...]:
        """The longest sequence of consecutive runs that are not excluded. The slopes use only these runs."""
        stretches: list[list[Run]] = [[]]
        for run in self.runs:
            if run.excluded:
                stretches.append([])
            else:
                stretches[-1].append(run)
        longest: list[Run] = max(stretches, key=len)
        return tuple(longest)

    @property
    def slopes(self) -> tuple[float, ...]:
        """The slope of log(error) against log(h) for each pair of consecutive runs in :attr:`clean`."""
        return slopes(self.clean)

    @property
    def settled(self) -> bool:
        """True if the slopes have settled, as defined in :mod:`codegen.lab.orders.step_sizes`."""
        last, ratio = self.slopes[-3:], [a.h / b.h for a, b in pairwise(self.clean)][-2:]
        changes = [abs(b - a) for a, b in pairwise(last)]
        return len(last) == 3 and all(c <= SETTLED * (r - 1) for c, r in zip(changes, ratio, strict=True))

    @property
    def observed(self) -> float | None:
        """The observed order: the last of :attr:`slopes`, or None if there is no slope."""
        return self.slopes[-1] if self.slopes else None

    def verdict(self, stated: int) -> str:
        """Compare the measured order with ``stated``, and return ``holds``, ``fails`` or ``undecided``.

        Let p be the last slope, and let s be the order measured with very short steps (:attr:`short`). A
        number counts as equal to ``stated`` if the difference is at most :data:`TOLERANCE`. Otherwise, it is
        above or below ``stated``.

        If there is no slope, the verdict is ``undecided``. If the slopes have settled (:attr:`settled`), the
        first rule that applies gives the verdict:

        - ``fails`` if s is below ``stated`` and s > 0.5 (an s near 0 can come from rounded coefficients, see
          :data:`ZERO`),
        - ``holds`` if p equals ``stated``,
        - ``holds`` if s equals ``stated`` and p is above ``stated``,
        - ``undecided`` if s equals ``stated`` and p is below ``stated``,
        - ``fails`` if neither p nor s equals ``stated``.

        If the slopes have not settled, the verdict is ``holds`` if all of the following conditions are
        satisfied, and ``undecided`` otherwise:

        - s equals ``stated``,
        - p equals ``stated`` or is above ``stated``,
        - :attr:`too_fine` is True.
        """
        if self.observed is None:
            return "undecided"
        if self.settled and self.short is not None and ZERO < self.short < stated - TOLERANCE:
            return "fails"
        near = abs(self.observed - stated) <= TOLERANCE
        confirmed = self.short is not None and abs(self.short - stated) <= TOLERANCE
        if confirmed and (self.settled or self.too_fine) and (near or self.observed > stated):
            return "holds"
        if not self.settled:
            return "undecided"
        if near:
            return "holds"
        return "undecided" if confirmed else "fails"

    @property
    def too_fine(self) -> bool:
        """True if at least one excluded run has an error that is too small to be measured.

        Such an error is close to the rounding errors, or to the error of the reference solution.
        """
        return any(r.excluded and math.isfinite(r.error) for r in self.runs)


def slopes(runs: Sequence[Run]) -> tuple[float, ...]:
    """Return the slope of log(error) against log(step size) for each pair of consecutive runs.

    >>> slopes([Run(10, 0.1, 1e-2), Run(30, 0.1 / 3, 1e-2 / 9)])
    (2.0,)
    """
    return tuple(round(math.log(a.error / b.error) / math.log(a.h / b.h), 12) for a, b in pairwise(runs))


def refine(
    run: Callable[[int], Run], most: int, to_rounding: bool = False, places: Places | None = None
) -> Refinement:
    """Make runs with N, 2 N, 4 N, ... steps, where N is about :data:`FIRST`, and return the runs.

    N is the smallest number of steps that ``places`` permits and that is at least :data:`FIRST`.

    No run has more than ``most`` steps. If ``to_rounding`` is False, the function stops as soon as
    :attr:`Refinement.settled` is True.

    The usable runs are the runs in :attr:`Refinement.clean`. After the doubling, the function adds runs if
    all of the following four conditions hold: the slopes have not settled, the last run is excluded
    (:attr:`Run.excluded`), at least one run is usable, and ``places.known`` is True. The added runs are:

    - runs with the numbers of steps in :data:`LONGER`,
    - two runs with about 6/5 n and 7/5 n steps for each usable run with n steps.

    Each of these numbers of steps is increased to the next number that ``places`` permits.
    """
    runs: list[Run] = []
    places = places or Places()
    steps = places.steps(FIRST)
    while steps <= most:
        runs.append(run(steps))
        refinement = Refinement(tuple(runs))
        last = runs[-1]
        too_fine = bool(last.excluded) and math.isfinite(last.error)
        if (refinement.settled and not to_rounding) or (refinement.clean and too_fine):
            break
        steps *= 2
    refinement = Refinement(tuple(runs))
    if refinement.settled or not refinement.clean or not refinement.runs[-1].excluded or not places.known:
        return refinement
    known = {r.steps: r for r in runs}
    more = [*LONGER, *(k * r.steps // FIRST for r in refinement.clean for k in (6, 7))]
    permitted = sorted({places.steps(n) for n in more} - known.keys())
    known |= {n: run(n) for n in permitted if n <= most}
    return Refinement(tuple(known[n] for n in sorted(known)))


def rounding(steps: int, epsilon: float, size: float) -> float:
    """Return an estimate of the largest accumulated rounding error of a coordinate in a run.

    ``epsilon`` is the machine epsilon, and ``size`` is the size of the coordinate.
    """
    return steps * epsilon * size
