"""Decides in which order the search predicts the times of recipes.

A recipe is a method with equal steps or step-size control, on one form of the equations. Each recipe has a
bar: limits on its error and on its time. The interpreter runs steps of a recipe only if the recipe may
satisfy both limits.
"""

from __future__ import annotations

import math
from collections import defaultdict, deque
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from codegen.lab.efficiency.candidates import Recipe
from codegen.lab.efficiency.goal import Goal
from codegen.lab.efficiency.prediction import FEW_STEPS, Bar, Prediction

MARGIN = 5.0
"""The interpreted runs of a recipe end when the recipe is certain to take more than MARGIN times the least
predicted time of all recipes.
"""

FRESH = 8
"""The bar of a recipe (limits on its error and its time) is computed again after enough new predictions.

The number of predictions must have grown by the factor 1 + 1/FRESH.
"""


EVEN = 4.0
"""A constant in the delay of a queue of recipes. The queue with the smallest delay is next.

The delay is (n + d)/EVEN plus a term for slow recipes. Here n is the number of recipes already taken from the
queue. The number d is the difference between the order of its methods and the usual order of fast methods.
"""

FAILED = 4.0
"""The term for slow recipes in the delay of a queue, if all predictions for the queue's kind failed."""


def usual_order(error: float) -> float:
    """Return the order that the fastest methods for an error usually have.

    >>> usual_order(1e-4), usual_order(1e-12)
    (4.0, 8.0)
    """
    return 2 - math.log10(error) / 2


Kind = tuple[str, str, bool, bool]
"""A kind of recipe: the family, the form, and two truth values. The first is True for an explicit tableau.
The second is True if the recipe can also run with step-size control.

Recipes of one kind have similar costs.
"""

Queue = tuple[Kind, int]
"""The key of a queue: a kind of recipe and the order of the methods.

The queue contains the recipes of this kind and order, sorted by the number of stages.
"""

Job = tuple[Recipe, tuple[Bar, ...]]


class Jobs(Sequence[Job]):
    """The recipes to predict, each with the bars of its goals.

    A job is created only when a worker process is free, so its bars use all predictions up to this time. The
    queues take turns. A queue comes early if the order of its methods is usual for the error. Queues of slow
    recipes come later.

    ``controlled`` maps each recipe to the goals that it may satisfy with step-size control. The recipes of
    the methods ``early`` are predicted first, so that slow recipes are recognised early.
    """

    def __init__(
        self,
        goals: Mapping[Recipe, Iterable[Goal]],
        controlled: Mapping[Recipe, Collection[Goal]] = MappingProxyType({}),
        early: Collection[str] = (),
    ) -> None:
        self.controlled = controlled
        self.goals = {recipe: tuple(dict.fromkeys(own)) for recipe, own in goals.items()}
        self.given: list[Recipe] = []
        self.known: dict[Goal, list[Prediction]] = defaultdict(list)
        self.fastest: dict[tuple[Goal, Kind], float] = {}
        self.least: dict[Goal, float] = {}
        self.bars: dict[tuple[Goal, int, bool], tuple[int, Bar]] = {}
        self.usual = {usual_order(goal.error) for own in self.goals.values() for goal in own}
        self.queues: dict[Queue, deque[Recipe]] = defaultdict(deque)
        self.turns: dict[Queue, int] = defaultdict(int)
        for recipe in sorted(self.goals, key=lambda r: r.stages):
            self.queues[self.kind(recipe), recipe.order].append(recipe)
        self.early = deque(recipe for recipe in self.goals if recipe.method in early)

    def __len__(self) -> int:
        return len(self.goals)

    def kind(self, recipe: Recipe) -> Kind:
        """Return the kind of a recipe."""
        return recipe.family, recipe.form, recipe.explicit, bool(self.controlled.get(recipe))

    def __getitem__(self, k: int) -> Job:  # type: ignore[override]
        """Return the next job. Jobs must be read in the order 0, 1, 2, ..., each job once.

        Raises IndexError after the last job, which ends a ``for`` loop.
        """
        if k >= len(self):
            raise IndexError(k)
        recipe = self._next()
        self.given.append(recipe)
        bars = (self._bar(goal, recipe) for goal in self.goals[recipe])
        job = replace(recipe, adaptive=bool(self.controlled.get(recipe)))
        return job, tuple(bar for bar in bars if not bar.hopeless(recipe.family))

    def _next(self) -> Recipe:
        """Remove the next recipe from its queue and return it."""
        if self.early:
            recipe = self.early.popleft()
            queue = self.kind(recipe), recipe.order
        else:
            queue = min((q for q in self.queues if self.queues[q]), key=self._place)
            recipe = self.queues[queue][0]
        self.turns[queue] += 1
        self.queues[queue].remove(recipe)
        return recipe

    def _place(self, queue: Queue) -> float:
        """Return the delay of a queue. The queue with the smallest delay is next."""
        distance = min(abs(queue[1] - order) for order in self.usual)
        return self._behind(queue) + (self.turns[queue] + distance) / EVEN

    def _behind(self, queue: Queue) -> float:
        """Return the part of the delay that depends on predicted times.

        The result is log2(a/b), where a is the least predicted time for the kind of recipe in the queue, and
        b the least predicted time for all kinds. With several goals, the smallest a/b is used.
        """
        kind, _ = queue
        goals = self.goals[self.queues[queue][0]]
        ratios = [
            self.fastest[goal, kind] / self.least[goal]
            for goal in goals
            if self.least.get(goal, math.inf) < math.inf and (goal, kind) in self.fastest
        ]
        if not ratios:
            return 0.0
        return math.log2(min(ratios)) if math.isfinite(min(ratios)) else FAILED

    def add(self, recipe: Recipe, prediction: Prediction) -> None:
        """Use a prediction for later jobs.

        A failed prediction is not used. A vague prediction has a time for equal steps that is too short.
        Therefore it is used only if it also predicts step-size control.
        """
        if prediction.failure or (prediction.vague and prediction.controlled is None):
            return
        recipe = replace(recipe, adaptive=False)
        for goal in self.goals[recipe]:
            if prediction.explicit or not goal.explicit:
                self.known[goal].append(prediction)
                key, seconds = (goal, self.kind(recipe)), prediction.seconds(goal.error)
                if prediction.controlled is not None and goal in self.controlled.get(recipe, ()):
                    seconds = min(seconds, prediction.controlled.seconds(goal.error))
                self.fastest[key] = min(self.fastest.get(key, math.inf), seconds)
                self.least[goal] = min(self.least.get(goal, math.inf), seconds)

    def _bar(self, goal: Goal, recipe: Recipe) -> Bar:
        """Return the bar that a recipe must reach for a goal. The bar may be older than the most recent
        predictions.

        A rough prediction comes from runs with large errors. If the recipe can run with step-size control,
        rough predictions for equal steps are not used.
        """
        controlled = goal in self.controlled.get(recipe, ())
        known, key = self.known[goal], (goal, recipe.order, controlled)
        age, bar = self.bars.get(key, (0, None))
        if bar is None or len(known) >= age + 1 + age // FRESH:
            if controlled:
                known = [p.controlled or p for p in known if p.controlled or not p.rough]
            bar = bar_of(goal, recipe.order, known, self.least.get(goal, math.inf))
            self.bars[key] = len(self.known[goal]), bar
        return bar


def bar_of(goal: Goal, order: int, known: Sequence[Prediction], least_seconds: float) -> Bar:
    """Return the bar for methods of an order. ``known`` are the predictions for a goal."""
    seconds = MARGIN * least_seconds
    if not math.isfinite(seconds):
        return Bar(goal.error, explicit=goal.explicit)
    # On a scene with fast motion all methods need short steps. Therefore the first run of a recipe has the
    # least number of steps that any earlier prediction used.
    steps = min((p.steps for p in known if math.isfinite(p.error)), default=FEW_STEPS)
    least: dict[tuple[str, bool], float] = {}
    for p in known:
        if order < p.order <= order + 2:
            reached = p.error_within(seconds)
            for family in (p.family, ""):
                key = family, p.explicit
                least[key] = min(least.get(key, math.inf), reached)
    return Bar(goal.error, seconds, tuple((*key, e) for key, e in least.items()), steps, goal.explicit)
