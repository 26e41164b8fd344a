"""Observed order from errors on a ladder of step sizes, with a verdict that is wrong neither way.

Slopes are taken between neighbouring rungs and divided by the true log ratio of their steps. Rungs whose
error may be rounding are left out, and so is everything finer. For a smooth problem the error is
C h^p (1 + O(h)), so a slope misses p by O(h): dividing h by r divides what is missing by r, and what is then
still missing is the last change of slope divided by r - 1. Slopes have *settled* when that estimate has been
at most :data:`SETTLED` twice running. The last slope must then be within :data:`TOLERANCE` of the stated
order, from below *and* from above: two and a half times the estimate, and a quarter of the distance to the
next order, so that a method better than it says is found out like one that is worse.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

SETTLED = 0.1
TOLERANCE = 0.25
CLEAR = 100.0
"""A rung counts when its error is this many times the rounding it may have gathered: then rounding moves a
slope by less than 0.03."""

FIRST = 5
"""Steps on the first rung of a ladder that nobody prescribed."""

LONGER = (2, 3, 4)
"""Steps on rungs before the first."""


@dataclass(frozen=True)
class Rung:
    """One run: ``steps`` of size ``h``, its error, and why it does not count (or '')."""

    steps: int
    h: float
    error: float
    excluded: str = ""


@dataclass(frozen=True)
class Ladder:
    """All rungs, coarse to fine, and what their slopes say."""

    rungs: tuple[Rung, ...]

    @property
    def clean(self) -> tuple[Rung, ...]:
        """The rungs that count: a run of neighbours with none excluded between, the longest such."""
        runs: list[list[Rung]] = [[]]
        for rung in self.rungs:
            if rung.excluded:
                runs.append([])
            else:
                runs[-1].append(rung)
        longest: list[Rung] = max(runs, key=len)
        return tuple(longest)

    @property
    def slopes(self) -> tuple[float, ...]:
        """log(error ratio)/log(step ratio) of neighbouring clean rungs."""
        return slopes(self.clean)

    @property
    def settled(self) -> bool:
        """Whether the last three slopes say that at most :data:`SETTLED` is missing, twice."""
        last, ratio = self.slopes[-3:], [a.h / b.h for a, b in pairwise(self.clean)][-2:]
        changes = [abs(b - a) for a, b in pairwise(last)]
        return len(last) == 3 and all(c <= SETTLED * (r - 1) for c, r in zip(changes, ratio, strict=True))

    @property
    def observed(self) -> float | None:
        """The last clean slope, or None where there is none."""
        return self.slopes[-1] if self.slopes else None

    def verdict(self, stated: int) -> str:
        """Return ``holds``, ``fails`` or, where slopes have not settled, ``undecided``."""
        if self.observed is None or not self.settled:
            return "undecided"
        return "holds" if abs(self.observed - stated) <= TOLERANCE else "fails"


def slopes(rungs: Sequence[Rung]) -> tuple[float, ...]:
    """Return the slopes between neighbours.

    >>> slopes([Rung(10, 0.1, 1e-2), Rung(30, 0.1 / 3, 1e-2 / 9)])
    (2.0,)
    """
    return tuple(round(math.log(a.error / b.error) / math.log(a.h / b.h), 12) for a, b in pairwise(rungs))


def climb(run: Callable[[int], Rung], most: int, to_rounding: bool = False) -> Ladder:
    """Double the number of steps from :data:`FIRST` until slopes settle, rounding is met or ``most`` is.

    With ``to_rounding`` the climb does not end where the slopes have settled. A run that failed ends nothing:
    Newton's method may find some solution with a long step, none with half of it, and the right one beyond.
    Where a high order meets rounding before three slopes have settled, runs of longer steps and runs in
    between are added: their slopes say the same, if each must settle to less.
    """
    rungs: list[Rung] = []
    steps = FIRST
    while steps <= most:
        rungs.append(run(steps))
        ladder = Ladder(tuple(rungs))
        last = rungs[-1]
        too_fine = bool(last.excluded) and math.isfinite(last.error)
        if (ladder.settled and not to_rounding) or (ladder.clean and too_fine):
            break
        steps *= 2
    ladder = Ladder(tuple(rungs))
    if ladder.settled or not ladder.clean or not ladder.rungs[-1].excluded:
        return ladder
    known = {r.steps: r for r in rungs}
    more = [*LONGER, *(k * r.steps // FIRST for r in ladder.clean for k in (6, 7))]
    known |= {n: run(n) for n in more if n <= most}
    return Ladder(tuple(known[n] for n in sorted(known)))


def rounding(steps: int, epsilon: float, size: float) -> float:
    """Return what rounding may add up to: an epsilon of the state's size for each step.

    That is the worst case; errors of random sign grow like the square root.
    """
    return steps * epsilon * max(1.0, size)
