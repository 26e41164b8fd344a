"""The observed order, computed from the errors at a sequence of step sizes and compared with the stated
order.

A slope is the logarithm of the error ratio of consecutive runs, divided by the logarithm of the ratio of
their step sizes. Runs whose errors may be rounding errors are excluded. Of the runs that are not excluded,
the longest consecutive sequence is used.

For a smooth problem and a method of order p, the error is C h^p (1 + O(h)), so a slope differs from p by
O(h). If h is divided by r, this difference is also divided by r. Therefore the last change of the slope,
divided by r - 1, estimates the remaining difference. Slopes have *settled* when this estimate is at most
:data:`SETTLED` for two consecutive slopes. The last settled slope is compared with the stated order. The
tolerance :data:`TOLERANCE` applies in both directions, so a method whose order is higher than stated also
fails.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

SETTLED = 0.1
TOLERANCE = 0.25
CLEAR = 100.0
"""A run is used if its error is more than CLEAR times the possible rounding error. Rounding then changes a
slope by less than 0.03.
"""

ZERO = 0.5
"""An order of very short steps is ignored if it is at most ZERO, because rounded coefficients can cause such
a low order.
"""

FIRST = 5
"""Number of steps in the first run."""

LONGER = (2, 3, 4)
"""The numbers of steps of additional long-step runs. These runs are made if rounding errors dominate before
the slopes settle.
"""


@dataclass(frozen=True)
class Run:
    """One run of ``steps`` steps of size ``h``. ``excluded`` is the reason why the run is not used, or ''."""

    steps: int
    h: float
    error: float
    excluded: str = ""


@dataclass(frozen=True)
class Refinement:
    """Runs from long to short steps, and the order estimated from their slopes.

    ``short`` is the order of very short steps (:mod:`codegen.lab.orders.short_steps`), or None if it is
    unknown.
    """

    runs: tuple[Run, ...]
    short: float | None = None

    @property
    def clean(self) -> tuple[Run, ...]:
        """The runs that are used: the longest sequence of consecutive runs that are not excluded."""
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
        """The slopes log(error ratio)/log(step ratio) of consecutive runs that are not excluded."""
        return slopes(self.clean)

    @property
    def settled(self) -> bool:
        """True if the estimated error of each of the last two slopes is at most :data:`SETTLED`."""
        last, ratio = self.slopes[-3:], [a.h / b.h for a, b in pairwise(self.clean)][-2:]
        changes = [abs(b - a) for a, b in pairwise(last)]
        return len(last) == 3 and all(c <= SETTLED * (r - 1) for c, r in zip(changes, ratio, strict=True))

    @property
    def observed(self) -> float | None:
        """The last slope of the runs that are not excluded, or None if there are fewer than two such runs."""
        return self.slopes[-1] if self.slopes else None

    def verdict(self, stated: int) -> str:
        """Return ``holds``, ``fails`` or ``undecided``. :data:`TOLERANCE` is the tolerance for slopes.

        Here s is the order of very short steps. If s is at most :data:`ZERO`, the first case does not apply.

        - If the slopes have settled and s is below ``stated``, the verdict is ``fails``.
        - If the slopes have settled at ``stated``, the verdict is ``holds``.
        - If the slopes have settled above ``stated`` and s is ``stated``, the verdict is ``holds``, because a
          small parameter hides the leading term.
        - If the slopes have settled below ``stated`` and s is ``stated``, the verdict is ``undecided``.
        - In all other cases of settled slopes, the verdict is ``fails``.
        - If the slopes have not settled, the verdict is usually ``undecided``. The verdict is ``holds`` if
          some errors are too small to be used (:attr:`too_fine`), s is ``stated``, and the last slope is not
          below ``stated``.
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
        """True if a run is excluded because its error is close to rounding errors or to the error of the
        reference.
        """
        return any(r.excluded and math.isfinite(r.error) for r in self.runs)


def slopes(runs: Sequence[Run]) -> tuple[float, ...]:
    """Return the slopes between consecutive runs.

    >>> slopes([Run(10, 0.1, 1e-2), Run(30, 0.1 / 3, 1e-2 / 9)])
    (2.0,)
    """
    return tuple(round(math.log(a.error / b.error) / math.log(a.h / b.h), 12) for a, b in pairwise(runs))


def refine(run: Callable[[int], Run], most: int, to_rounding: bool = False) -> Refinement:
    """Double the number of steps, from :data:`FIRST` up to ``most``, and return the runs.

    ``run`` makes a run with a given number of steps. The refinement ends when the slopes have settled, or
    when rounding errors dominate. With ``to_rounding`` the refinement ends only when rounding errors
    dominate. Failed runs do not end the refinement. If rounding errors dominate before the slopes have
    settled, runs with longer steps and intermediate runs are added.
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
    """Return a bound of the accumulated rounding error: number of steps times epsilon times size of the
    state.
    """
    return steps * epsilon * max(1.0, size)
