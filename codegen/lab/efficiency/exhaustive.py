"""An exhaustive search for the fastest recipe, to test the results of ``orderconds recommend``.

A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size control.

1. For each recipe r and each required error e, the CPU time T(r, e) is predicted from a few runs in the
   interpreter.
2. T(r, e)/SAFE is used as a lower bound of the true CPU time, where SAFE is a safety factor.
3. Let K(e) be the CPU time of the best recipe of ``orderconds recommend`` for the error e. The time limit is
   L(e) = WORST K(e), where WORST is a factor slightly above 1. The recipe r is excluded if
   T(r, e)/SAFE > L(e) for all required errors e.
4. The remaining recipes are emitted, compiled and timed.
5. A sample of the excluded recipes is also timed, to test the lower bounds.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TypeVar

from codegen.lab.efficiency.candidates import Recipe
from codegen.lab.efficiency.prediction import CALL, FEWEST_SWEEPS, Bar, Prediction
from codegen.lab.efficiency.race import Entry, Result
from codegen.lab.efficiency.recommend import Request
from codegen.lab.efficiency.search import Key, Search
from codegen.lab.efficiency.task import emitted, predicted
from codegen.lab.progress import Progress
from orderconds.processes import in_processes

WORST = 1.25
"""A recommended recipe is accepted if (its CPU time)/(CPU time of the fastest recipe) is at most WORST."""

SAFE = 8.0
"""A safety factor: the true CPU time is assumed to be at least (predicted CPU time)/SAFE."""

T = TypeVar("T")

SAMPLE = 12
"""The largest number of recipes that are timed although their predicted CPU times are too long.

These runs test the predictions.
"""


@dataclass
class Exhausted:
    """The result of an exhaustive search.

    - ``known``: maps each required error to the least CPU time in seconds that ``orderconds recommend``
      measured. The time is infinite if no recipe was found.
    - ``recipes``: the number of recipes of the library.
    - ``results``: maps each required error to the measured runs.
    - ``raced``: the number of recipes that were emitted and timed.
    - ``refused``: the number of recipes that cannot be compiled for the scene.
    - ``copies``: the number of recipes that were not timed, because their code equals that of a timed recipe.
    - ``excluded``: the number of recipes that were not timed, because their predicted CPU times were too
      long.
    - ``nearest``: the result of a test of the predictions. A few recipes with too long predicted CPU times
      are timed, too. Let t be the CPU time of such a recipe for a required error, and let b be the least CPU
      time that was measured earlier for this error, by ``orderconds recommend`` or by this search.
      ``nearest`` is the least quotient t/b. If ``nearest`` is below 1, a faster recipe was wrongly excluded.
    - ``complete``: False if the time limit ended the search.
    """

    known: Mapping[float, float]
    recipes: int
    results: dict[float, list[Result]] = field(default_factory=dict)
    raced: int = 0
    refused: int = 0
    copies: int = 0
    excluded: int = 0
    nearest: float = math.inf
    complete: bool = True
    codes: set[str] = field(default_factory=set)

    def best(self, error: float) -> float:
        """Return the least measured CPU time in seconds for the required error ``error``.

        ``known`` contains the CPU times from ``orderconds recommend``, and ``results`` contains the runs of
        this exhaustive search. A run in ``results`` counts only if the run reached the required error.
        """
        times = (r.seconds for r in self.results.get(error, ()) if r.reached)
        return min(self.known[error], min(times, default=math.inf))

    def text(self) -> str:
        """Return a summary of the search in words."""
        counts = (
            f"{self.raced} recipes measured, {self.excluded} excluded because their predicted time is too "
            f"long, {self.refused} cannot be compiled, {self.copies} have the same code as others"
        )
        if math.isfinite(self.nearest):
            counts += (
                "; to test the predictions, a few recipes with long predicted times were measured last; each "
                f"took at least {self.nearest:.1f} times as long as the fastest of the earlier recipes"
            )
        return counts if self.complete else f"{counts}; the time limit ended the search"


def exhaust(
    request: Request,
    known: Mapping[float, float],
    progress: Progress = str,
    most: float = math.inf,
) -> Exhausted:
    """Search the whole library for the fastest recipe for each required error.

    ``known`` maps each required error to the best known CPU time in seconds, or to infinity. ``most`` is the
    time limit of this search in seconds.
    """
    search = Search(request.task, (request.goal,))
    limits = {error: WORST * SAFE * seconds for error, seconds in known.items()}
    predictions = _predicted(search, limits, progress)
    recipes = list(search.suited)
    done = Exhausted(known, len(recipes), {error: [] for error in known})
    done.refused = sum(bool(predictions[_key(r)].failure) for r in recipes)
    open_ = [r for r in recipes if not predictions[_key(r)].failure]
    ratios = {r: least_ratio(predictions[_key(r)], limits, r.adaptive) for r in open_}
    ordered = sorted(open_, key=lambda r: (math.isinf(ratios[r]), ratios[r]))
    kept = [r for r in ordered if ratios[r] <= 1.0]
    above = [r for r in ordered if ratios[r] > 1.0]
    sample = sampled(above)
    done.excluded = len(above) - len(sample)
    for number, candidate in enumerate(in_processes(partial(emitted, request.task), [*kept, *sample]), 1):
        progress(f"{search.problem.name}: racing recipe {number} of {len(kept) + len(sample)}")
        if not isinstance(candidate, Entry):
            done.refused += 1
        elif candidate.code in done.codes:
            done.copies += 1
        else:
            ratio = _raced(done, search, candidate)
            if number > len(kept):
                done.nearest = min(done.nearest, ratio)
        if time.monotonic() - search.start > most:
            done.complete = number == len(kept) + len(sample)
            break
    return done


def _predicted(search: Search, limits: Mapping[float, float], progress: Progress) -> dict[Key, Prediction]:
    """Predict CPU times for each pair (method, form of the equations), for runs with a constant step size."""
    recipes = list(dict.fromkeys(replace(r, adaptive=False) for r in search.suited))
    bars = tuple(Bar(error, seconds) for error, seconds in limits.items())
    jobs = [(recipe, bars) for recipe in recipes]
    predictions: dict[Key, Prediction] = {}
    for k, prediction in enumerate(in_processes(partial(predicted, search.task), jobs)):
        progress(f"{search.problem.name}: running recipe {k + 1} of {len(jobs)} in the interpreter")
        assert prediction is not None  # The prediction is None only if ``bars`` is empty.
        predictions[_key(recipes[k])] = prediction
    return predictions


def _key(recipe: Recipe) -> Key:
    return recipe.method, recipe.form


def least_ratio(prediction: Prediction, limits: Mapping[float, float], adaptive: bool = False) -> float:
    """Return the minimum of (predicted CPU time)/(time limit) over all required errors.

    ``limits`` maps each required error to its time limit in seconds. The time limits include the safety
    factor SAFE.

    A prediction is based on runs of the method in the interpreter. The prediction is unreliable in two cases:

    - No run succeeded.
    - The runs had large errors, and the method is implicit or has step-size control.

    For an unreliable prediction, let q be the predicted time of a single step, divided by the longest time
    limit. The result is q if q > 1, and otherwise 0.

    >>> slow = Prediction("rk", 2, outside=1e6 - CALL, steps=10, error=1e-2)
    >>> round(least_ratio(slow, {1e-4: 1e-3}), 9)
    100.0
    >>> least_ratio(replace(slow, error=math.inf), {1e-4: 1e-2})
    0.0
    >>> least_ratio(replace(slow, rough=True), {1e-4: 1e-2}, adaptive=True)
    0.0
    """
    step = 1e-9 * (CALL + prediction.outside + FEWEST_SWEEPS * prediction.sweep)
    unknown = prediction.rough and (adaptive or not prediction.explicit)
    if unknown or not math.isfinite(prediction.error):
        longest = max(limits.values())
        return step / longest if step > longest else 0.0
    return min(prediction.seconds(error) / limit for error, limit in limits.items())


def sampled(excluded: Sequence[T]) -> list[T]:
    """Return a sample of at most :data:`SAMPLE` excluded recipes.

    ``excluded`` must be sorted by :func:`least_ratio`. The first half of the sample is the beginning of
    ``excluded``. The second half is distributed evenly over the remaining recipes.

    >>> sampled(range(102))
    [0, 1, 2, 3, 4, 5, 6, 22, 38, 54, 70, 86]
    >>> sampled(range(3))
    [0, 1, 2]
    """
    if len(excluded) <= SAMPLE:
        return list(excluded)
    near = SAMPLE // 2
    far = SAMPLE - near
    rest = len(excluded) - near
    return [*excluded[:near], *(excluded[near + k * rest // far] for k in range(far))]


def _raced(done: Exhausted, search: Search, candidate: Entry) -> float:
    """Measure the CPU time of a recipe for each required error, and add the results to ``done``.

    Return the minimum of (measured CPU time)/(best earlier CPU time) over all required errors that the recipe
    reaches. The result is infinity if the recipe reaches no required error.
    """
    done.codes.add(candidate.code)
    done.raced += 1
    racer = search.racer(candidate)
    ratio = math.inf
    for error, known in done.results.items():
        best = done.best(error)
        result = racer.reach(error, best)
        known.append(result)
        if result.reached:
            ratio = min(ratio, result.seconds / best)
    return ratio
