"""The observed order, computed from the errors of runs with a sequence of step sizes, and the verdict on the
stated order.

The slope between two consecutive runs is the logarithm of the ratio of their errors, divided by the logarithm
of the ratio of their step sizes. A run is excluded if its error may be caused by rounding. The excluded runs
divide the sequence of runs into sections. Only the longest section is used.

For a smooth problem and a method of order p, the error is C h^p (1 + O(h)) with a constant C and the step
size h. A slope therefore differs from p by O(h). If h is divided by r, this difference is also divided by r.
Let d be the difference between a slope and p. The previous slope differs from p by about r d, so the slope
has changed by about (r - 1) d. Therefore the change of the slope, divided by r - 1, is an estimate of d. The
slopes have *settled* if this estimate is at most :data:`SETTLED` for each of the last two slopes.

The last slope is compared with the stated order. The two numbers may differ by at most :data:`TOLERANCE`.
Therefore a method fails, too, if its order is higher than stated.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

SETTLED = 0.1
TOLERANCE = 0.25
CLEAR = 100.0
"""A run is used only if its error is larger than two bounds.

The bounds are CLEAR times the estimated rounding error of the run, and CLEAR times the uncertainty of the
reference solution. If the step sizes of two runs differ by a factor of 2, rounding errors then change the
slope by less than 0.03. The same holds for the uncertainty of the reference solution.
"""

ZERO = 0.5
"""An order measured with very short steps is ignored if it is at most ZERO.

If the coefficients of a method are rounded, they do not satisfy the order conditions exactly. With very short
steps, this inaccuracy dominates the error. The measured order can then be close to 0.
"""

FIRST = 5
"""The number of steps in the first run."""

LONGER = (2, 3, 4)
"""If rounding errors dominate before the slopes have settled, runs with these numbers of steps are added."""


@dataclass(frozen=True)
class Run:
    """One run with ``steps`` steps of size ``h``, and the error of its final state.

    If the run is not used for slopes, ``excluded`` is the reason. Otherwise ``excluded`` is empty.
    """

    steps: int
    h: float
    error: float
    excluded: str = ""


@dataclass(frozen=True)
class Refinement:
    """Runs of a method with different step sizes. The properties give the observed order of the method.

    In ``runs``, the step sizes decrease. ``short`` is the order measured with very short steps
    (:mod:`codegen.lab.orders.short_steps`), or None if it was not measured.
    """

    runs: tuple[Run, ...]
    short: float | None = None

    @property
    def clean(self) -> tuple[Run, ...]:
        """The runs that are used for slopes.

        The excluded runs divide the sequence of runs into sections. The longest section is used.
        """
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
        """The slopes of log(error) against log(step size).

        Each slope is computed from two consecutive runs. Only the runs in :attr:`clean` are used.
        """
        return slopes(self.clean)

    @property
    def settled(self) -> bool:
        """True if the last two slopes are close to the limit of the slopes for short steps.

        The limit is not known. The distance of a slope from the limit is therefore estimated, and both
        estimates must be at most :data:`SETTLED`. The docstring of :mod:`codegen.lab.orders.step_sizes`
        explains how the distance is estimated.
        """
        last, ratio = self.slopes[-3:], [a.h / b.h for a, b in pairwise(self.clean)][-2:]
        changes = [abs(b - a) for a, b in pairwise(last)]
        return len(last) == 3 and all(c <= SETTLED * (r - 1) for c, r in zip(changes, ratio, strict=True))

    @property
    def observed(self) -> float | None:
        """The observed order, which is the last of :attr:`slopes`. It is None if there is no slope."""
        return self.slopes[-1] if self.slopes else None

    def verdict(self, stated: int) -> str:
        """Compare the measured order with ``stated``, and return ``holds``, ``fails`` or ``undecided``.

        Let p be the last slope, and let s be the order measured with very short steps (:attr:`short`). In
        the rules, p or s equals ``stated`` if the difference is at most :data:`TOLERANCE`. It is above or
        below ``stated`` if the difference is larger.

        If there is no slope, the verdict is ``undecided``.

        If the slopes have settled (:attr:`settled`), the first rule that applies gives the verdict:

        - If s is larger than :data:`ZERO` and below ``stated``, the verdict is ``fails``.
        - If p equals ``stated``, the verdict is ``holds``.
        - If s equals ``stated`` and p is above ``stated``, the verdict is ``holds``.
        - If s equals ``stated`` and p is below ``stated``, the verdict is ``undecided``.
        - In all other cases, the verdict is ``fails``.

        If the slopes have not settled, the verdict is ``holds`` if :attr:`too_fine` is True, s equals
        ``stated``, and p is not below ``stated``. Otherwise the verdict is ``undecided``.
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
        """True if at least one run is excluded because its error is too small to be measured.

        The error of such a run is close to the rounding errors, or to the error of the reference solution.
        """
        return any(r.excluded and math.isfinite(r.error) for r in self.runs)


def slopes(runs: Sequence[Run]) -> tuple[float, ...]:
    """Return the slope of log(error) against log(step size) for each pair of consecutive runs.

    >>> slopes([Run(10, 0.1, 1e-2), Run(30, 0.1 / 3, 1e-2 / 9)])
    (2.0,)
    """
    return tuple(round(math.log(a.error / b.error) / math.log(a.h / b.h), 12) for a, b in pairwise(runs))


def refine(run: Callable[[int], Run], most: int, to_rounding: bool = False) -> Refinement:
    """Make runs with N, 2 N, 4 N, ... steps, where N is :data:`FIRST`, and return the runs.

    ``run(n)`` makes a run with n steps. No run has more than ``most`` steps. The sequence ends if rounding
    errors dominate the error of the last run. If ``to_rounding`` is False, the sequence also ends if the
    slopes have settled.

    If rounding errors dominate before the slopes have settled, the function adds runs with fewer than N steps
    and runs with intermediate numbers of steps.
    """
    runs: list[Run] = []
    steps = FIRST
    while steps <= most:
        runs.append(run(steps))
        refinement = Refinement(tuple(runs))
        last = runs[-1]
        too_fine = bool(last.excluded) and math.isfinite(last.error)
        if (refinement.settled and not to_rounding) or (refinement.clean and too_fine):
            break
        steps *= 2
    refinement = Refinement(tuple(runs))
    if refinement.settled or not refinement.clean or not refinement.runs[-1].excluded:
        return refinement
    known = {r.steps: r for r in runs}
    more = [*LONGER, *(k * r.steps // FIRST for r in refinement.clean for k in (6, 7))]
    known |= {n: run(n) for n in more if n <= most}
    return Refinement(tuple(known[n] for n in sorted(known)))


def rounding(steps: int, epsilon: float, size: float) -> float:
    """Return an estimate of the largest accumulated rounding error of a run.

    The estimate is the product of the number of steps, the machine epsilon ``epsilon`` and the size of the
    state, ``size``. If ``size`` is below 1, it is replaced by 1.
    """
    return steps * epsilon * max(1.0, size)
