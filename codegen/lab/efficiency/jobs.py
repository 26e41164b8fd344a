"""The order in which recipes are predicted, and what each of them must reach to be interpreted."""

from __future__ import annotations

import math
from collections import defaultdict, deque
from collections.abc import Iterable, Mapping, Sequence

from codegen.lab.efficiency.candidates import Recipe
from codegen.lab.efficiency.goal import Goal
from codegen.lab.efficiency.prediction import Bar, Prediction

MARGIN = 5.0
"""A prediction ends if a step takes so long that MARGIN times the least predicted time is exceeded."""

FRESH = 8
"""Results that depend on all predictions are computed again when 1/FRESH of the predictions are new."""


EVEN = 4.0
"""EVEN turns, or a distance of EVEN from the usual order, count as much as a family that is twice as slow."""


def usual_order(error: float) -> float:
    """Return the order of methods that are usually the fastest for an error.

    >>> usual_order(1e-4), usual_order(1e-12)
    (4.0, 8.0)
    """
    return 2 - math.log10(error) / 2


Kind = tuple[str, str, bool]
"""Family, form, and whether the tableau is explicit: recipes of one kind have similar costs."""

Queue = tuple[Kind, int]
"""Kind and order: a queue contains their recipes, those with few stages first."""

Job = tuple[Recipe, tuple[Bar, ...]]


class Jobs(Sequence[Job]):
    """The recipes to predict, each with the bars of its goals.

    A job is formed when a worker is ready for it, so it depends on the predictions until then. The queues
    take turns; orders that are usual for an error are first. A kind that is predicted to be slower than
    another one waits: the wait increases with the logarithm of the ratio.
    """

    def __init__(self, goals: Mapping[Recipe, Iterable[Goal]]) -> None:
        self.goals = {recipe: tuple(dict.fromkeys(own)) for recipe, own in goals.items()}
        self.given: list[Recipe] = []
        self.known: dict[Goal, list[Prediction]] = defaultdict(list)
        self.fastest: dict[tuple[Goal, Kind], float] = {}
        self.least: dict[Goal, float] = {}
        self.bars: dict[tuple[Goal, int], tuple[int, Bar]] = {}
        self.usual = {usual_order(goal.error) for own in self.goals.values() for goal in own}
        self.queues: dict[Queue, deque[Recipe]] = defaultdict(deque)
        self.turns: dict[Queue, int] = defaultdict(int)
        for recipe in sorted(self.goals, key=lambda r: r.stages):
            self.queues[kind_of(recipe), recipe.order].append(recipe)

    def __len__(self) -> int:
        return len(self.goals)

    def __getitem__(self, k: int) -> Job:  # type: ignore[override]
        """Return the next job; jobs are read once, in order. IndexError ends an iteration."""
        if k >= len(self):
            raise IndexError(k)
        queue = min((q for q in self.queues if self.queues[q]), key=self._place)
        self.turns[queue] += 1
        recipe = self.queues[queue].popleft()
        self.given.append(recipe)
        bars = (self._bar(goal, recipe.order) for goal in self.goals[recipe])
        return recipe, tuple(bar for bar in bars if not bar.hopeless(recipe.family))

    def _place(self, queue: Queue) -> float:
        """Return the priority of a queue: small for a fast family, few turns and an order that is usual."""
        distance = min(abs(queue[1] - order) for order in self.usual)
        return self._behind(queue) + (self.turns[queue] + distance) / EVEN

    def _behind(self, queue: Queue) -> float:
        """Return the turns for which a queue waits: log2 of its time relative to the least time."""
        kind, _ = queue
        goals = self.goals[self.queues[queue][0]]
        ratios = [
            self.fastest[goal, kind] / self.least[goal]
            for goal in goals
            if self.least.get(goal, math.inf) < math.inf and (goal, kind) in self.fastest
        ]
        return min(math.log2(min(ratios)), 100.0) if ratios else 0.0

    def add(self, recipe: Recipe, prediction: Prediction) -> None:
        """Use a prediction for later jobs."""
        if prediction.failure:
            return
        for goal in self.goals[recipe]:
            if prediction.explicit or not goal.explicit:
                self.known[goal].append(prediction)
                key, seconds = (goal, kind_of(recipe)), prediction.seconds(goal.error)
                self.fastest[key] = min(self.fastest.get(key, math.inf), seconds)
                self.least[goal] = min(self.least.get(goal, math.inf), seconds)

    def _bar(self, goal: Goal, order: int) -> Bar:
        """Return the bar of a goal for an order; it may be older than the last few predictions."""
        known = self.known[goal]
        age, bar = self.bars.get((goal, order), (0, None))
        if bar is None or len(known) >= age + 1 + age // FRESH:
            bar = bar_of(goal, order, known, self.least.get(goal, math.inf))
            self.bars[goal, order] = len(known), bar
        return bar


def kind_of(recipe: Recipe) -> Kind:
    """Return the kind of a recipe."""
    return recipe.family, recipe.form, recipe.explicit


def bar_of(goal: Goal, order: int, known: Sequence[Prediction], least_seconds: float) -> Bar:
    """Return what a method of an order must reach to be interpreted, given the predictions for a goal."""
    seconds = MARGIN * least_seconds
    if not math.isfinite(seconds):
        return Bar(goal.error, explicit=goal.explicit)
    # All methods need short steps on a fast scene, so that long steps need not be tried again.
    steps = min(p.steps for p in known if math.isfinite(p.error))
    least: dict[tuple[str, bool], float] = {}
    for p in known:
        if order < p.order <= order + 2:
            reached = p.error_within(seconds)
            for family in (p.family, ""):
                key = family, p.explicit
                least[key] = min(least.get(key, math.inf), reached)
    return Bar(goal.error, seconds, tuple((*key, e) for key, e in least.items()), steps, goal.explicit)
