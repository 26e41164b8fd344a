"""The search for the fastest recipes of the library for several goals.

A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size control.
A goal is a bound on the error and a list of requirements. The search has three stages:

- The CPU time of each recipe is predicted from short runs (:mod:`codegen.lab.efficiency.prediction`).
- Recipes with short predicted times are emitted as C and measured.
- The fastest recipes are timed again with more repetitions.
"""

from __future__ import annotations

import math
import time
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from codegen.lab.default_methods import REPORT_ADAPTIVE
from codegen.lab.efficiency.candidates import Recipe
from codegen.lab.efficiency.goal import Goal, possible_needs
from codegen.lab.efficiency.jobs import Jobs
from codegen.lab.efficiency.prediction import Prediction
from codegen.lab.efficiency.race import Entry, Racer, Result
from codegen.lab.efficiency.task import Task, emitted, predicted
from codegen.lab.long_runs.drift import LOST
from codegen.lab.long_runs.trajectory import record
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference, cached_reference
from orderconds.processes import in_processes

SAFETY = 2.5
"""A recipe is measured if its predicted time is at most SAFETY times the best measured time.

Before the comparison, the predicted time is multiplied by a correction factor.
"""

UNSEEN = 4.0
"""The safety factor for a :class:`Recipe` if no recipe of the same kind (:data:`Kind`) has been measured."""

LEADERS, CLOSE = 4, 1.4
"""Limits for the recipes that are timed again.

LEADERS limits the number of these recipes. CLOSE limits the ratio of their CPU times to the least CPU time.
"""

CONTROLLED = 100.0
"""Unreliable estimates of CPU times are divided by CONTROLLED (:meth:`Search.hoped`).

Such an estimate is based on runs with a constant step size. On stiff scenes, it can be a hundred times the
time that a method with step-size control needs.
"""

ROUND = 6
"""The largest number of recipes that are measured between two corrections of the predicted times.

A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size control.
"""

GROUP = 50
"""The number of predictions between two progress messages."""

REFERRING = 0.6
"""The largest fraction of the time budget that may be used to compute the reference solution."""

PREDICTING = 0.5
"""The fraction of the remaining time budget that may be used for predictions.

The remaining budget is the time that is left after the computation of the reference solution.
"""

UNREACHED = 1e-3
"""A default value for the gain of a recipe, used if the estimated CPU times do not give a positive gain.

This happens, for example, if the estimated CPU times of all recipes are infinite. Recipes with larger gains
are measured earlier (:meth:`Search._next`).
"""

LONG_STEPS = 20_000
"""The number of steps of the long run that tests whether a method preserves conserved quantities."""

SHORTER = 5
"""The largest number of times that the step size of a method is halved because a test fails.

The test is a long run. The test fails if a step fails, or if the relative deviation of a conserved quantity
is at least :data:`LOST`. Then the step size is halved, and the test is repeated.
"""

Kind = tuple[str, bool, bool]
"""A kind of recipe: the triple (family, explicit, adaptive).

``family`` is the name of the method family. ``explicit`` is True if the method is explicit. ``adaptive`` is
True if the recipe has step-size control.

All recipes of a kind have similar ratios of measured to predicted times.
"""

Key = tuple[str, str]
"""The key of a prediction: the method and the form of the equations."""


@dataclass
class Search:
    """A search for the fastest recipes for several goals.

    :meth:`run` must be called before :meth:`leaders`.

    - ``predictions``: the predicted errors and times of recipes.
    - ``ratios``: the ratios of measured to predicted times, for each kind of recipe and each required error.
    - ``results``: for each required error, a dictionary of the measured recipes and their results.
    - ``lost``: for each goal (a required error and further requirements), the recipes that fail the test of
      conserved quantities in a long run.
    - ``complete``: False if the time budget ended the search.
    """

    task: Task
    goals: tuple[Goal, ...]
    progress: Progress = str
    safety: float = SAFETY
    predictions: dict[Key, Prediction] = field(default_factory=dict)
    ratios: dict[tuple[Kind, float], list[float]] = field(default_factory=lambda: defaultdict(list))
    results: dict[float, dict[Recipe, Result]] = field(default_factory=dict)
    racers: dict[Recipe, Racer] = field(default_factory=dict)
    raced: set[Recipe] = field(default_factory=set)
    codes: set[str] = field(default_factory=set)
    timed: set[tuple[Recipe, float]] = field(default_factory=set)
    lost: dict[Goal, dict[Recipe, None]] = field(default_factory=lambda: defaultdict(dict))
    complete: bool = True

    def __post_init__(self) -> None:
        self.start = time.monotonic()
        self.problem = self.task.problem()
        self.progress(f"{self.problem.name}: reference solution")
        self.exact: Reference = cached_reference(self.problem, end=self.start + REFERRING * self.task.budget)
        self.referred = self.spent
        self.results = {goal.error: {} for goal in self.goals}
        self.suited: dict[Recipe, tuple[Goal, ...]] = {}
        needs = {goal.needs for goal in self.goals}
        for recipe in self.task.recipes():
            known = possible_needs(recipe, needs, self.problem)
            if known:
                self.suited[recipe] = tuple(goal for goal in self.goals if goal.needs in known)

    @property
    def spent(self) -> float:
        """The fraction of the time budget that is already used."""
        return (time.monotonic() - self.start) / self.task.budget

    def run(self) -> None:
        """Run the search: call :meth:`predict` and :meth:`race`."""
        self.predict()
        self.race()

    def predict(self) -> None:
        """Predict the CPU time of each recipe. Stop at the time limit (:data:`PREDICTING`)."""
        methods: dict[Recipe, list[Goal]] = defaultdict(list)
        for recipe, suited in self.suited.items():
            methods[replace(recipe, adaptive=False)] += suited
        controlled = {replace(r, adaptive=False): suited for r, suited in self.suited.items() if r.adaptive}
        jobs = Jobs(methods, controlled, REPORT_ADAPTIVE)
        for k, prediction in enumerate(in_processes(partial(predicted, self.task), jobs)):
            if k % GROUP == 0:
                self.progress(f"{self.problem.name}: predicting method {k + 1} of {len(jobs)}")
            if prediction is not None:
                recipe = jobs.given[k]
                self.predictions[recipe.method, recipe.form] = prediction
                jobs.add(recipe, prediction)
            if self.spent > self.referred + PREDICTING * (1 - self.referred):
                self.complete = k + 1 == len(jobs)
                return

    def expected(self, recipe: Recipe, error: float) -> float:
        """Return an optimistic estimate of the CPU time of a recipe for a required error, in seconds.

        The predicted time is corrected by the results of measured recipes, and divided by a safety factor. If
        there is no prediction, the result is infinity.
        """
        prediction = self.prediction(recipe)
        if prediction is None or prediction.failure:
            return math.inf
        seconds, kind = prediction.seconds(error), self.kind(recipe)
        if (kind, error) in self._corrections:
            return seconds * self._corrections[kind, error] / self.safety
        if kind in self._of_kind:
            return seconds * self._of_kind[kind] / self.safety
        return seconds * self._least / UNSEEN

    def hoped(self, recipe: Recipe, error: float) -> float:
        """Return the result of :meth:`expected`, divided by :data:`CONTROLLED` if the estimate is unreliable.

        An estimate is unreliable if three conditions hold: the recipe has step-size control, the time is
        predicted from inaccurate runs with a constant step size, and no recipe of the same kind has been
        measured.
        """
        prediction, seconds = self.prediction(recipe), self.expected(recipe, error)
        unknown = recipe.adaptive and prediction is not None and prediction.rough
        return seconds / CONTROLLED if unknown and self.kind(recipe) not in self._of_kind else seconds

    def prediction(self, recipe: Recipe) -> Prediction | None:
        """Return the prediction for a recipe, or None if there is no prediction.

        If ``recipe`` has step-size control, but only equal steps were predicted for its method, the result is
        the prediction for equal steps.
        """
        known = self.predictions.get((recipe.method, recipe.form))
        return known.controlled or known if known is not None and recipe.adaptive else known

    def _correct(self) -> None:
        """Use the attribute ``ratios`` to compute correction factors for the predicted times."""
        self._corrections = {key: geometric_mean(x) for key, x in self.ratios.items() if x}
        joined: dict[Kind, list[float]] = defaultdict(list)
        for (kind, _), ratios in self.ratios.items():
            joined[kind] += ratios
        self._of_kind = {kind: geometric_mean(x) for kind, x in joined.items() if x}
        self._least = min((min(x) for x in joined.values() if x), default=1.0)

    def kind(self, recipe: Recipe) -> Kind:
        """Return the kind of a recipe (:data:`Kind`)."""
        prediction = self.predictions.get((recipe.method, recipe.form))
        return recipe.family, prediction is None or prediction.explicit, recipe.adaptive

    def race(self) -> None:
        """Emit and measure recipes until no remaining recipe can be the fastest.

        If the time budget is used up earlier, the function sets ``complete`` to False and returns.
        """
        while True:
            self._correct()
            ready = self._next()
            if not ready:
                return
            if self.spent > 1:
                self.complete = False
                return
            names = ", ".join(r.label for r in ready)
            self.progress(f"{self.problem.name}: racing {names}")
            self.raced.update(ready)
            for candidate in in_processes(partial(emitted, self.task), ready):
                if isinstance(candidate, Entry) and candidate.code not in self.codes:
                    self.codes.add(candidate.code)
                    self.racers[candidate.recipe] = self.racer(candidate)
                    self._measure(candidate.recipe)
                if self.spent > 1:
                    break

    def _next(self) -> list[Recipe]:
        """Return the recipes with the largest gains, at most :data:`ROUND` recipes.

        For each goal, let a be the best measured time for this goal, and let b be the estimated time of a
        recipe for this goal. The gain of the recipe is the sum of log(a/b) over all goals with b < a.
        """
        gains: dict[Recipe, float] = defaultdict(float)
        open_ = {r: suited for r, suited in self.suited.items() if r not in self.raced and self._known(r)}
        times = {(r, g.error): self.expected(r, g.error) for r, suited in open_.items() for g in suited}
        promises = {
            goal: [(r, times[r, goal.error]) for r, suited in open_.items() if goal in suited]
            for goal in self.goals
        }
        for goal, promised in promises.items():
            if goal.explicit:
                promised = [(r, seconds) for r, seconds in promised if self.kind(r)[1]]
            bound = self.best(goal)
            if not math.isfinite(bound) and promised:
                bound = self.safety * min(seconds for _, seconds in promised)
            for recipe, seconds in promised:
                if self.hoped(recipe, goal.error) < bound or not math.isfinite(bound):
                    gains[recipe] += math.log(bound / seconds) if seconds < bound < math.inf else UNREACHED
        chosen: list[Recipe] = []
        fresh: set[Kind] = set()
        for recipe in sorted(gains, key=lambda r: -gains[r]):
            kind = self.kind(recipe)
            if kind in self._of_kind or kind not in fresh:
                fresh.add(kind)
                chosen.append(recipe)
        return chosen[:ROUND]

    def _known(self, recipe: Recipe) -> bool:
        prediction = self.predictions.get((recipe.method, recipe.form))
        return prediction is not None and not prediction.failure

    def best(self, goal: Goal) -> float:
        """Return the least CPU time in seconds that was measured for a goal.

        The result is infinity if no recipe has reached the goal.
        """
        return min((r.seconds for r in self._reached(goal)), default=math.inf)

    def _reached(self, goal: Goal) -> Iterable[Result]:
        """For each recipe, return the fastest of the results that reach a goal.

        If a recipe does not preserve a conserved quantity in a long run, the recipe is omitted.
        """
        fastest: dict[Recipe, Result] = {}
        for error, results in self.results.items():
            for recipe, result in results.items() if error <= goal.error else ():
                if recipe in self.lost[goal]:
                    continue
                known = fastest.get(recipe)
                if result.reached and (known is None or result.seconds < known.seconds):
                    fastest[recipe] = result
        return [result for result in fastest.values() if goal.met(result.entry.features)]

    def racer(self, candidate: Entry) -> Racer:
        """Return a :class:`Racer`, which runs the emitted code of ``candidate``."""
        return Racer(self.task.equations(candidate.recipe.form), self.exact, candidate)

    def _measure(self, recipe: Recipe) -> None:
        """Measure the CPU time of a recipe for each required error, and store the results."""
        racer = self.racers[recipe]
        prediction = self.prediction(recipe)
        assert prediction is not None
        met = [goal for goal in self.suited[recipe] if goal.met(racer.entry.features)]
        for error in sorted({goal.error for goal in met}, reverse=True):
            worst = max(self.best(goal) for goal in met if goal.error == error)
            if self.hoped(recipe, error) >= worst:
                continue
            result = racer.reach(error, worst)
            self.results[error][recipe] = result
            known = prediction.seconds(error)
            if math.isfinite(known):
                # If no run reaches the required error, a large CPU time is assumed.
                seconds = result.seconds if result.reached else max(known, 2 * self.safety * worst)
                if math.isfinite(seconds):
                    self.ratios[self.kind(recipe), error].append(seconds / known)

    def time_again(self, goal: Goal) -> None:
        """Time the fastest recipes for a goal again, with more repetitions.

        Runs that were already timed by an earlier call of this function are omitted.
        """
        ranked = sorted(self._reached(goal), key=lambda r: r.seconds)
        for result in [r for r in ranked[:LEADERS] if r.seconds <= CLOSE * ranked[0].seconds]:
            recipe = result.entry.recipe
            if (recipe, result.control) not in self.timed:
                self.timed.add((recipe, result.control))
                seconds = min(result.seconds, self.racers[recipe].seconds(result.control, 0.004, 9))
                for results in self.results.values():
                    if recipe in results and results[recipe].control == result.control:
                        results[recipe] = replace(results[recipe], seconds=seconds)

    def leaders(self, goal: Goal) -> tuple[list[Result], list[str]]:
        """Return the results for a goal, from fast to slow, and the labels of excluded recipes.

        The excluded recipes did not pass the long run (:meth:`_loses`).
        """
        while True:
            ranked, raced = self._ranked(goal), len(self.raced)
            if not ranked and self.lost[goal]:
                self.race()
            if len(self.raced) == raced:
                return ranked, [recipe.label for recipe in self.lost[goal]]

    def _ranked(self, goal: Goal) -> list[Result]:
        """Return the results for a goal, from fast to slow.

        If ``goal.long`` is True, the two fastest recipes are tested in a long run. If a recipe fails the
        test, the step size is halved, and the recipe is tested again. A recipe is removed if it also fails
        after :data:`SHORTER` halvings, or if its step size cannot be halved (:meth:`Racer.halved`).
        """
        self.time_again(goal)
        ranked = sorted(self._reached(goal), key=lambda r: r.seconds)
        halvings: Counter[Recipe] = Counter()
        kept = 0
        while goal.long and kept < min(2, len(ranked)):
            result = ranked[kept]
            # The number of steps is doubled when the step size is halved.
            if not self._loses(result, LONG_STEPS << halvings[result.entry.recipe]):
                kept += 1
                continue
            del ranked[kept]
            recipe = result.entry.recipe
            halvings[recipe] += 1
            shorter = self.racers[recipe].halved(result) if halvings[recipe] <= SHORTER else None
            if shorter is None:
                self.lost[goal][recipe] = None
            else:
                # For each result in ``ranked[:kept]``, a long run has already shown that no conserved
                # quantity is lost. These results keep their places, and only the remaining results are
                # sorted.
                ranked = [*ranked[:kept], *sorted([*ranked[kept:], shorter], key=lambda r: r.seconds)]
        return ranked

    def _loses(self, result: Result, steps: int) -> bool:
        """Return True if a long run with the step size of ``result`` fails or loses a conserved quantity."""
        racer = self.racers[result.entry.recipe]
        h = (racer.last - racer.first) / result.steps
        done = record(self.problem, racer.integrator, racer.initial, h, steps, racer.first)
        largest = (max(s.peaks, default=0.0) / done.scales[name] for name, s in done.series.items())
        return bool(done.failure) or any(x >= LOST for x in largest)


def geometric_mean(values: Sequence[float]) -> float:
    """Return the geometric mean of positive numbers.

    >>> geometric_mean([1.0, 4.0])
    2.0
    """
    return math.exp(sum(map(math.log, values)) / len(values))
