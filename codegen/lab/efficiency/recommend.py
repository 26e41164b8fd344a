"""The search for the fastest recipe of the library that reaches an error and meets the needs.

The search has three stages. First, each recipe is predicted by a few interpreted steps
(:mod:`codegen.lab.efficiency.prediction`). Methods are dropped without a run if their steps take too long,
or if methods of higher order are far from the error. Then recipes are emitted and raced in C in the order of
their predicted times. The ratio of measured to predicted times of each kind of recipe corrects the later
predictions. A recipe is left out if its corrected prediction exceeds the best measured time by a safety
factor. Last, the leaders are timed again, with more repetitions.
"""

from __future__ import annotations

import math
import time
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache, partial

from codegen import scenes
from codegen.build import build
from codegen.emitter import compile_method
from codegen.lab.efficiency.candidates import Recipe, candidates, in_turns
from codegen.lab.efficiency.equations import Equations, all_equations
from codegen.lab.efficiency.prediction import Bar, Prediction, Predictor
from codegen.lab.efficiency.race import Entry, Racer, Result, entry
from codegen.lab.efficiency.requirements import Features
from codegen.lab.long_runs.drift import LOST
from codegen.lab.long_runs.trajectory import record
from codegen.lab.progress import Progress
from codegen.lab.reference import Reference, cached_reference
from codegen.lower import families_for, lowering
from codegen.method import Method, parse
from codegen.scene.classical_forms import PRINTED
from codegen.scene.problem import Problem
from orderconds.errors import InputError, UnknownName
from orderconds.families import family_class
from orderconds.processes import in_processes

SAFETY = 2.5
"""A recipe is raced if its corrected prediction is at most SAFETY times the best measured time."""

UNSEEN = 4.0
"""The safety factor for a kind of recipe of which none was raced yet."""

LEADERS, CLOSE = 4, 1.4
"""At most LEADERS recipes within a factor CLOSE of the best are timed again."""

ROUND = 6
"""Recipes that are emitted between two corrections."""

GROUP = 16
"""Methods that are predicted between two updates of the bar."""

PREDICTING = 0.5
"""The part of the budget that predictions may take."""

BUDGET = 50.0
"""Seconds that a search may take by default; the recipe in work is finished."""

LONG_STEPS = 2000
"""Steps of the long run that a symplectic recommendation must survive."""


@dataclass(frozen=True)
class Need:
    """A requirement on recipes: its name, its meaning; ``long`` says that it includes long times."""

    name: str
    meaning: str
    long: bool = False


NEEDS = (
    Need("manifold", "the state stays on the manifold up to rounding"),
    Need(
        "symplectic", "steps are symplectic maps, and no conserved quantity is lost in a long run", long=True
    ),
    Need("explicit", "no equations are solved; each step takes the same time"),
    Need("adaptive", "step sizes are controlled by an error estimate"),
)


@dataclass(frozen=True)
class Request:
    """What is asked for: ``scene`` as the user names it, the error at the end of the span, and the needs.

    ``stack`` are the bytes that a call may use. ``span`` replaces the span of the scene. ``budget`` are the
    seconds that the search may take. ``tableaux`` restrict the library.
    """

    scene: str
    error: float
    needs: tuple[str, ...] = ()
    stack: int | None = None
    span: tuple[Fraction, Fraction] | None = None
    budget: float = BUDGET
    tableaux: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        known = [need.name for need in NEEDS]
        for name in self.needs:
            if name not in known:
                raise UnknownName(f"unknown need {name!r}", where="--need", expected=", ".join(known))
        if not 0 < self.error < math.inf:
            raise InputError(f"the error {self.error:g}", where="--error", expected="a number above 0")

    def problem(self) -> Problem:
        """Return the scene with the span of the request."""
        return _problem(self.scene, self.span)

    def equations(self, form: str) -> Equations:
        """Return the equations of the scene in a form."""
        return _equations(self.scene, self.span, form)

    @property
    def long(self) -> bool:
        """Whether a need includes long times."""
        return any(need.long for need in NEEDS if need.name in self.needs)

    def possible(self, recipe: Recipe, problem: Problem) -> bool:
        """Whether a recipe may meet the needs; the others are known when it is compiled."""
        kind = family_class(recipe.family)
        if "adaptive" in self.needs and not recipe.adaptive:
            return False
        kept = recipe.form == PRINTED and (kind.keeps_manifold or problem.group.abelian)
        if "manifold" in self.needs and not kept:
            return False
        if "symplectic" not in self.needs:
            return True
        if recipe.adaptive or not problem.is_hamiltonian:
            return False
        return lowering(recipe.family).symplectic(problem, _method(problem, recipe))

    def met(self, properties: Features) -> bool:
        """Whether a compiled recipe meets the needs."""
        given = {
            "manifold": properties.on_manifold,
            "symplectic": properties.symplectic,
            "explicit": properties.explicit,
            "adaptive": properties.adaptive,
        }
        return all(given[name] for name in self.needs) and (
            self.stack is None or 0 < properties.stack <= self.stack
        )


@dataclass(frozen=True)
class Failed:
    """A recipe that the compiler refuses, with the reason."""

    recipe: Recipe
    reason: str


@dataclass(frozen=True)
class Recommendation:
    """The result of a search: the recipes that reach the error, fastest first, and what was examined.

    ``best`` is the most accurate run if no recipe reaches the error. ``predicted`` and ``raced`` are numbers
    of recipes. ``complete`` is false if the budget ended the search. ``lost`` names the recipes that were
    excluded by a long run.
    """

    request: Request
    places: tuple[Result, ...]
    best: Result | None
    predicted: int
    raced: int
    seconds: float
    complete: bool = True
    lost: tuple[str, ...] = ()

    def as_json(self) -> dict[str, object]:
        """Return plain data."""
        asked = self.request
        return {
            "scene": asked.scene,
            "error": asked.error,
            "needs": list(asked.needs),
            "stack": asked.stack,
            "span": [float(x) for x in asked.problem().span],
            "recommended": place_json(asked, self.places[0]) if self.places else None,
            "runner_up": place_json(asked, self.places[1]) if len(self.places) > 1 else None,
            "most_accurate": place_json(asked, self.best) if self.best else None,
            "predicted": self.predicted,
            "raced": self.raced,
            "complete": self.complete,
            "lost": list(self.lost),
            "search_seconds": self.seconds,
        }


def place_json(asked: Request, place: Result) -> dict[str, object]:
    """Return a run as plain data, with the command that emits its integrator."""
    first, last = map(float, asked.problem().span)
    recipe, properties = place.entry.recipe, place.entry.features
    return {
        "method": recipe.method,
        "form": recipe.form,
        "adaptive": recipe.adaptive,
        "h": None if recipe.adaptive or not place.steps else (last - first) / place.steps,
        "steps": place.steps,
        "tolerance": place.tolerance,
        "error": place.error,
        "seconds": place.seconds if math.isfinite(place.seconds) else None,
        "on_manifold": properties.on_manifold,
        "symplectic": properties.symplectic,
        "explicit": properties.explicit,
        "stack": properties.stack,
        "command": recipe.command(asked.scene),
    }


@cache
def _problem(scene: str, span: tuple[Fraction, Fraction] | None) -> Problem:
    problem = scenes.load(scene)
    return problem if span is None else replace(problem, span=span)


@cache
def _equations(scene: str, span: tuple[Fraction, Fraction] | None, form: str) -> Equations:
    (equations,) = all_equations(_problem(scene, span), (form,))
    return equations


def _method(problem: Problem, recipe: Recipe) -> Method:
    """Return the method of a recipe; MethodError if the scene or the family refuses it."""
    method = replace(parse(recipe.method, families_for(problem)), adaptive=recipe.adaptive)
    method.embedded()
    return method


@dataclass(frozen=True)
class _Predicting:
    """The arguments that all predictions of a round share."""

    request: Request
    bar: Bar


def _predicted(shared: _Predicting, recipe: Recipe) -> Prediction:
    """Return the prediction of a recipe; runs in a worker process."""
    problem = shared.request.problem()
    try:
        method = replace(_method(problem, recipe), adaptive=False)
        return _predictor(shared.request, recipe.form).predict(method, recipe.order, shared.bar)
    except (InputError, ArithmeticError) as error:
        return Prediction(recipe.method, recipe.order, failure=str(error))


@cache
def _predictor(request: Request, form: str) -> Predictor:
    return Predictor(request.equations(form), cached_reference(request.problem()))


def _emitted(request: Request, recipe: Recipe) -> Entry | Failed:
    """Return a recipe as a compiled module in the cache; runs in a worker process."""
    problem = request.problem()
    try:
        candidate = entry(recipe, compile_method(problem, _method(problem, recipe), form=recipe.form))
        build(candidate.artifact.files)
    except (InputError, ArithmeticError) as error:
        return Failed(recipe, str(error))
    return candidate


Kind = tuple[str, bool, bool]
"""Family, explicit or not, adaptive or not: predictions of one kind have similar errors."""


@dataclass
class Search:
    """One search; :meth:`run` returns the recommendation."""

    request: Request
    progress: Progress = str
    predictions: dict[tuple[str, str], Prediction] = field(default_factory=dict)
    ratios: dict[Kind, list[float]] = field(default_factory=lambda: defaultdict(list))
    results: list[Result] = field(default_factory=list)
    raced: set[Recipe] = field(default_factory=set)
    codes: set[str] = field(default_factory=set)
    complete: bool = True

    def __post_init__(self) -> None:
        self.start = time.monotonic()
        self.problem = self.request.problem()
        self.progress(f"{self.problem.name}: reference solution")
        self.exact: Reference = cached_reference(self.problem)
        every = candidates(self.problem, self.request.tableaux)
        self.recipes = [r for r in every if self._possible(r)]

    def _possible(self, recipe: Recipe) -> bool:
        try:
            return self.request.possible(recipe, self.problem)
        except InputError:
            return False

    @property
    def spent(self) -> float:
        """The part of the budget that is used."""
        return (time.monotonic() - self.start) / self.request.budget

    def run(self) -> Recommendation:
        """Predict, race, and time the leaders again."""
        self.predict()
        self.race()
        places, lost = self.leaders()
        best = min((r for r in self.results), key=lambda r: r.error, default=None)
        return Recommendation(
            self.request,
            tuple(places),
            None if places else best,
            len(self.predictions),
            len(self.raced),
            time.monotonic() - self.start,
            self.complete,
            tuple(lost),
        )

    def predict(self) -> None:
        """Predict all recipes until the part of the budget for predictions is used.

        The usual order for the error is first. The other orders follow by their distance from it, and within
        an order the families take turns, each with few stages first.
        """
        methods = {(r.method, r.form): replace(r, adaptive=False) for r in self.recipes}
        usual = 2 - math.log10(self.request.error) / 2
        for order in sorted({r.order for r in methods.values()}, key=lambda p: (abs(p - usual), p)):
            same = in_turns(r for r in methods.values() if r.order == order)
            for k in range(0, len(same), GROUP):
                self.progress(f"{self.problem.name}: predicting methods of order {order}")
                bar = self._bar(order)
                chosen = [r for r in same[k : k + GROUP] if not bar.hopeless(r.family)]
                work = partial(_predicted, _Predicting(self.request, bar))
                for recipe, prediction in zip(chosen, in_processes(work, chosen), strict=True):
                    self.predictions[recipe.method, recipe.form] = prediction
                    if self.spent > PREDICTING:
                        self.complete = False
                        return

    def _bar(self, order: int) -> Bar:
        """Return what a method of an order must reach to be interpreted."""
        times = [p.seconds(self.request.error) for p in self.predictions.values()]
        seconds = 2 * SAFETY * min(times, default=math.inf)
        if not math.isfinite(seconds):
            return Bar(self.request.error)
        # All methods need short steps on a fast scene, so that long steps need not be tried again.
        steps = min(p.steps for p in self.predictions.values() if math.isfinite(p.error))
        least: dict[tuple[str, bool], float] = {}
        for p in self.predictions.values():
            if not p.failure and order < p.order <= order + 2:
                for family in (p.family, ""):
                    key = family, p.explicit
                    least[key] = min(least.get(key, math.inf), p.error_within(seconds))
        known = tuple((*key, error) for key, error in least.items())
        return Bar(self.request.error, seconds, known, steps)

    def expected(self, recipe: Recipe) -> float:
        """Return the predicted seconds of a recipe, corrected by the ratio of its kind."""
        prediction = self.predictions.get((recipe.method, recipe.form))
        if prediction is None or prediction.failure:
            return math.inf
        seconds = prediction.seconds(self.request.error)
        ratios = self.ratios[self.kind(recipe)]
        if not ratios:
            return seconds * self._scale() / UNSEEN
        return seconds * math.exp(sum(map(math.log, ratios)) / len(ratios)) / SAFETY

    def kind(self, recipe: Recipe) -> Kind:
        """Return the kind of a recipe."""
        prediction = self.predictions.get((recipe.method, recipe.form))
        return recipe.family, prediction is None or prediction.explicit, recipe.adaptive

    def _scale(self) -> float:
        """Return the smallest ratio of all kinds, at most 1."""
        return min((min(x) for x in self.ratios.values() if x), default=1.0)

    def race(self) -> None:
        """Emit and time recipes in the order of their expected times."""
        while True:
            ready = self._next()
            if not ready:
                return
            if self.spent > 1:
                self.complete = False
                return
            names = ", ".join(r.label for r in ready)
            self.progress(f"{self.problem.name}: racing {names}")
            self.raced.update(ready)
            for candidate in in_processes(partial(_emitted, self.request), ready):
                if (
                    isinstance(candidate, Entry)
                    and candidate.code not in self.codes
                    and self.request.met(candidate.features)
                ):
                    self.codes.add(candidate.code)
                    self._measure(candidate)

    def _next(self) -> list[Recipe]:
        """Return the next recipes to emit; each kind that was not raced yet is represented by one recipe."""
        best = self.best
        open_ = [r for r in self.recipes if r not in self.raced]
        within = sorted(
            (r for r in open_ if self.expected(r) < best or (not self.results and self._unknown(r))),
            key=self.expected,
        )
        if "explicit" in self.request.needs:
            within = [r for r in within if self.kind(r)[1]]
        chosen: list[Recipe] = []
        fresh: set[Kind] = set()
        for recipe in within:
            kind = self.kind(recipe)
            if self.ratios[kind] or kind not in fresh:
                fresh.add(kind)
                chosen.append(recipe)
        return chosen[:ROUND]

    def _unknown(self, recipe: Recipe) -> bool:
        prediction = self.predictions.get((recipe.method, recipe.form))
        return prediction is not None and not prediction.failure

    @property
    def best(self) -> float:
        """The best measured seconds so far."""
        return min((r.seconds for r in self.results if r.reached), default=math.inf)

    def racer(self, candidate: Entry) -> Racer:
        """Return a racer for an entry."""
        return Racer(self.request.equations(candidate.recipe.form), self.exact, candidate)

    def _measure(self, candidate: Entry) -> None:
        """Race an entry and record the ratio of its kind."""
        racer = self.racer(candidate)
        result = racer.reach(self.request.error, self.best)
        self.results.append(result)
        recipe = candidate.recipe
        predicted = self.predictions[recipe.method, recipe.form].seconds(self.request.error)
        if math.isfinite(predicted):
            # A recipe that left the race is slower than the best by more than its safety factor.
            seconds = result.seconds if result.reached else max(predicted, 2 * SAFETY * self.best)
            if math.isfinite(seconds):
                self.ratios[self.kind(recipe)].append(seconds / predicted)

    def leaders(self) -> tuple[list[Result], list[str]]:
        """Time the leaders again; return all places, and the labels that a long run excludes."""
        ranked = sorted((r for r in self.results if r.reached), key=lambda r: r.seconds)
        close = [r for r in ranked[:LEADERS] if r.seconds <= CLOSE * ranked[0].seconds]
        again = []
        for result in close:
            racer = self.racer(result.entry)
            racer.error(result.control)
            seconds = racer.seconds(result.control, 0.004, 9)
            again.append(replace(result, seconds=min(seconds, result.seconds)))
        ranked = sorted([*again, *ranked[len(close) :]], key=lambda r: r.seconds)
        lost: list[str] = []
        if self.request.long:
            while ranked and len(lost) < 2 * LEADERS and self._loses(ranked[0]):
                lost.append(ranked.pop(0).entry.recipe.label)
            if len(ranked) > 1 and self._loses(ranked[1]):
                lost.append(ranked.pop(1).entry.recipe.label)
        return ranked, lost

    def _loses(self, result: Result) -> bool:
        """Whether a conserved quantity is lost, or a step fails, in a long run with the step of a result."""
        racer = self.racer(result.entry)
        h = (racer.last - racer.first) / result.steps
        done = record(self.problem, racer.integrator, racer.initial, h, LONG_STEPS, racer.first)
        largest = (max(s.peaks, default=0.0) / done.scales[name] for name, s in done.series.items())
        return bool(done.failure) or any(x >= LOST for x in largest)


def recommend(request: Request, progress: Progress = str) -> Recommendation:
    """Return the recommendation for a request; errors of the scene and of the request are InputErrors."""
    return Search(request, progress).run()


def race_all(request: Request, errors: Sequence[float]) -> dict[float, list[Result]]:
    """Emit every recipe and race it for each error, without predictions; the baseline of a benchmark."""
    search = Search(request)
    results: dict[float, list[Result]] = {error: [] for error in errors}
    for candidate in in_processes(partial(_emitted, request), search.recipes):
        if isinstance(candidate, Entry) and request.met(candidate.features):
            for error, known in results.items():
                best = min((r.seconds for r in known if r.reached), default=math.inf)
                known.append(search.racer(candidate).reach(error, best))
    return results
