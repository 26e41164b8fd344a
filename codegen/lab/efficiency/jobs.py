"""The order in which the search predicts the times of recipes, and the bar of each recipe.

A recipe is a method with equal steps or step-size control, on one form of the equations. A bar consists of an
error and a time. The interpreter executes steps of a recipe only if the recipe may reach the error in this
time.
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
time predicted for all recipes.
"""

FRESH = 8
"""A bar (limits on the error and on the time of a recipe) is computed again when the number of predictions
has grown by the factor 1 + 1/FRESH.
"""


EVEN = 4.0
"""A constant in the delay of a queue of recipes. The next recipe is taken from the queue with the smallest
delay.

The delay is the sum of two terms. The first term is (n + d)/EVEN. Here n is the number of recipes that were
taken from the queue, and d is the difference between the order of its methods and the usual order of fast
methods. The second term increases by one for every factor of two in the predicted time of the recipes.
"""

FAILED = 4.0
"""The second term of the delay of a queue if all predictions for its kind of recipe failed."""


def usual_order(error: float) -> float:
    """Return the order that the fastest methods for an error usually have.

    >>> usual_order(1e-4), usual_order(1e-12)
    (4.0, 8.0)
    """
    return 2 - math.log10(error) / 2


Kind = tuple[str, str, bool, bool]
"""A kind of recipe: family, form, True if the tableau is explicit, and True if the recipe can also run with
step-size control. Recipes of one kind have similar costs.
"""

Queue = tuple[Kind, int]
"""The key of a queue: a kind of recipe and the order of the methods. The queue contains the recipes of this
kind and order, sorted by the number of stages.
"""

Job = tuple[Recipe, tuple[Bar, ...]]


class Jobs(Sequence[Job]):
    """The recipes to predict, each with the bars of its goals.

    A job is created only when a worker process is free, so its bars use all predictions up to this time. The
    queues take turns. If the order of a queue is usual for the error, the queue comes early. Queues of slow
    kinds of recipes are delayed by log2(a/b), where a is the least predicted time of this kind and b the
    least predicted time of all kinds.

    ``controlled`` maps each recipe that can also run with step-size control to the goals that the recipe may
    then satisfy. The recipes of the methods ``early`` are predicted first, so that slow recipes are
    recognised early.
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
        """Return the next job. The caller must read the jobs in the order 0, 1, 2, ..., each job once. After
        the last job, IndexError is raised, which ends a ``for`` loop.
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
        """Return the whole delay of a queue. The delay is small for queues with a fast family, few turns and
        a usual order. The queue with the smallest delay is next.
        """
        distance = min(abs(queue[1] - order) for order in self.usual)
        return self._behind(queue) + (self.turns[queue] + distance) / EVEN

    def _behind(self, queue: Queue) -> float:
        """Return the part of the delay that depends on predicted times.

        The result is log2(a/b), where a is the least predicted time of this kind of recipe and b the least
        predicted time of all kinds. If there are several goals, the goal with the smallest a/b is used. The
        result is FAILED if all predictions of this kind of recipe failed, and 0 if there are no predictions
        yet.
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

        Failed predictions are not used. The time for equal steps in a vague prediction is too short.
        Therefore a vague prediction is used only if it contains a prediction with step-size control.
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
        """Return the bar that a recipe must reach for a goal. The bar may not include the most recent
        predictions.

        For a recipe that can run with step-size control, rough predictions for equal steps are not used.
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
    """Return the bar for methods of an order, given the predictions ``known`` for a goal."""
    seconds = MARGIN * least_seconds
    if not math.isfinite(seconds):
        return Bar(goal.error, explicit=goal.explicit)
    # On a scene with fast motion all methods need short steps. Therefore the first run of a method has at
    # least as many steps as the earlier prediction with the fewest steps.
    steps = min((p.steps for p in known if math.isfinite(p.error)), default=FEW_STEPS)
    least: dict[tuple[str, bool], float] = {}
    for p in known:
        if order < p.order <= order + 2:
            reached = p.error_within(seconds)
            for family in (p.family, ""):
                key = family, p.explicit
                least[key] = min(least.get(key, math.inf), reached)
    return Bar(goal.error, seconds, tuple((*key, e) for key, e in least.items()), steps, goal.explicit)
