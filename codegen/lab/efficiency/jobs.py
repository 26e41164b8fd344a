"""Determines the sequence in which the CPU times of recipes are predicted.

A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size control.
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
"""A recipe is too slow if its predicted CPU time exceeds MARGIN times the least predicted time."""

FRESH = 8
"""A constant that determines how often the limits in a :class:`Bar` are updated.

A bar contains limits on the error and the CPU time of a recipe. The limits are computed from the predictions
for earlier recipes. Limits that were computed from n predictions are updated after 1 + n // FRESH further
predictions.
"""


EVEN = 4.0
"""A constant that determines from which queue the next recipe is taken.

All recipes in a queue have the same kind K (:data:`Kind`) and the same order of convergence p. Let T1 be the
least predicted CPU time of all recipes of the kind K, whatever their order. Let T2 be the least predicted CPU
time of all recipes. Three numbers are computed for each queue:

- n is the number of recipes that were taken from the queue.
- d is the least value of abs(p - usual_order(e)) over all required errors e (:func:`usual_order`).
- s is log2(T1/T2), which is called the slowness of the queue.

The next recipe comes from the queue with the smallest value of (n + d)/EVEN + s.
"""

FAILED = 4.0
"""The slowness of a kind of recipes (:data:`Kind`) if all predicted CPU times of this kind are infinite.

Otherwise, let T1 be the least predicted CPU time of all recipes of the kind, and let T2 be the least
predicted CPU time of all recipes. Then the slowness is log2(T1/T2). The docstring of :data:`EVEN` describes
the use of the slowness.
"""


def usual_order(error: float) -> float:
    """Return the typical order of the fastest methods when the required error is ``error``.

    >>> usual_order(1e-4), usual_order(1e-12)
    (4.0, 8.0)
    """
    return 2 - math.log10(error) / 2


Kind = tuple[str, str, bool, bool]
"""A kind of recipe: (family, form of the equations, explicit, controlled).

``explicit`` is True if the tableau is explicit. ``controlled`` is True if step-size control is possible.
"""

Queue = tuple[Kind, int]
"""The key of a queue of recipes: (kind of recipe, order of convergence).

The recipes in a queue are sorted by the number of stages.
"""

Job = tuple[Recipe, tuple[Bar, ...]]


class Jobs(Sequence[Job]):
    """The sequence of jobs for the worker processes. A job is a recipe with a :class:`Bar` for each goal.

    A bar contains limits on the error and the CPU time of a recipe. The limits depend on the
    predictions that are known when the job is created. To use as many predictions as possible, a job is
    created only when a worker process is free.

    The choice of the next recipe is explained at :data:`EVEN`.

    - ``goals``: for each recipe, the goals that the recipe can meet with equal steps or step-size control.
    - ``controlled``: for each recipe, the goals that the recipe can meet with step-size control.
    - ``early``: names of the methods whose recipes are predicted first.
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
        """Return the kind of a recipe (:data:`Kind`)."""
        return recipe.family, recipe.form, recipe.explicit, bool(self.controlled.get(recipe))

    def __getitem__(self, k: int) -> Job:  # type: ignore[override]
        """Return the next job. Successive calls must have the arguments k = 0, 1, 2, and so on.

        Raises IndexError after the last job.
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
        """Return the rank of a queue. The next recipe comes from the queue with the smallest rank.

        The rank is the number (n + d)/EVEN + s. The docstring of :data:`EVEN` defines n, d and s.
        """
        distance = min(abs(queue[1] - order) for order in self.usual)
        return self._behind(queue) + (self.turns[queue] + distance) / EVEN

    def _behind(self, queue: Queue) -> float:
        """Return the slowness of a queue, computed for the recipe that is taken from the queue next.

        Let K be the kind of this recipe (:data:`Kind`). For each goal of the recipe, T1 is the least
        predicted CPU time to reach the goal with a recipe of the kind K, and T2 is the least predicted CPU
        time to reach the goal with a recipe of any kind. The slowness is the minimum of log2(T1/T2) over
        these goals.

        A goal is ignored if T1 is not known yet, or if T2 is infinite. If all goals are ignored, the slowness
        is 0. If T1 is infinite for all goals that are not ignored, the slowness is FAILED.
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
        """Store a prediction for a recipe, except in two cases.

        - The method cannot be used for the scene (``failure`` is not empty).
        - The prediction with equal steps is unreliable (``vague`` is true), and there is no prediction with
          step-size control (``controlled`` is None).
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
        """Return the limits (:class:`Bar`) on the error and the CPU time of ``recipe`` for ``goal``.

        To save time, the limits are updated only after several new predictions (:data:`FRESH`).
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
    """Return the limits (:class:`Bar`) on the error and the CPU time for methods of order ``order``.

    ``known`` contains the available predictions for the goal. ``least_seconds`` is the least predicted CPU
    time for the goal, over all recipes.
    """
    seconds = MARGIN * least_seconds
    if not math.isfinite(seconds):
        return Bar(goal.error, explicit=goal.explicit)
    # If even the best methods need many steps, runs with few steps are useless.
    steps = min((p.steps for p in known if math.isfinite(p.error)), default=FEW_STEPS)
    least: dict[tuple[str, bool], float] = {}
    for p in known:
        if order < p.order <= order + 2:
            reached = p.error_within(seconds)
            for family in (p.family, ""):
                key = family, p.explicit
                least[key] = min(least.get(key, math.inf), reached)
    return Bar(goal.error, seconds, tuple((*key, e) for key, e in least.items()), steps, goal.explicit)
