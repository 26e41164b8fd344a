"""Recommendations: needs are never violated, runs reach the error, predictions agree with measured errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import combinations
from types import SimpleNamespace

import pytest

from codegen import scenes
from codegen.commands.recommend import searched, unreached
from codegen.emitter import compile_method
from codegen.errors import SceneError
from codegen.ir.program import Solve
from codegen.lab import reference as references
from codegen.lab import timing
from codegen.lab.distance import distance
from codegen.lab.efficiency import prediction, race, search
from codegen.lab.efficiency.candidates import Recipe, candidates
from codegen.lab.efficiency.equations import Equations
from codegen.lab.efficiency.goal import Goal, possible, possible_needs
from codegen.lab.efficiency.interpreted_runs import run
from codegen.lab.efficiency.jobs import Jobs
from codegen.lab.efficiency.prediction import Bar, Prediction, Predictor, widths_of_inputs
from codegen.lab.efficiency.race import Entry, Racer, Result, entry
from codegen.lab.efficiency.recommend import Recommendation, Request, recommend
from codegen.lab.efficiency.search import Search
from codegen.lab.efficiency.task import Task, emitted, predicted
from codegen.lab.reference import Reference, cached_reference, reference
from codegen.lower import families_for, lower, problem_for
from codegen.method import parse
from codegen.scene.classical_forms import PRINTED
from codegen.scene.problem import Problem
from orderconds.errors import InputError

SCENE = "linear_oscillator+u"
FEW = ("rk4", "dormand_prince5", "gauss2", "strang", "dop853")
NEEDS = (
    (),
    ("symplectic",),
    ("adaptive",),
    ("explicit",),
    ("explicit", "symplectic"),
    ("manifold",),
    ("explicit", "fixed"),
)
QUICK_NEEDS = (("adaptive",), ("explicit", "symplectic"), ("manifold",), ("explicit", "fixed"))
"""Each need occurs in one of them; the slow run tries the others."""


@pytest.fixture(scope="module", autouse=True)
def _short_samples() -> Iterator[None]:
    """Times of these races are coarse, because no test depends on them."""

    def coarse(run: Callable[[int], int], overhead: timing.Overhead, batch: float, _: int) -> list[float]:
        return timing.span_times(run, overhead, batch / 10, 2)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(race, "span_times", coarse)
        yield


@pytest.fixture(
    scope="module",
    params=[pytest.param(n, marks=() if n in QUICK_NEEDS else pytest.mark.slow) for n in NEEDS],
    ids=lambda needs: "+".join(needs) or "none",
)
def found(request: pytest.FixtureRequest) -> Recommendation:
    return recommend(Request(SCENE, 1e-6, request.param, tableaux=FEW))


def test_every_place_meets_the_needs(found: Recommendation) -> None:
    assert found.places
    for place in found.places:
        known = place.entry.features
        given = {
            "manifold": known.on_manifold,
            "symplectic": known.symplectic,
            "explicit": known.explicit,
            "adaptive": known.adaptive,
            "fixed": not known.adaptive,
        }
        assert all(given[need] for need in found.request.needs), place.entry.recipe.label


def test_every_place_reaches_the_error_when_it_is_run_again(found: Recommendation) -> None:
    problem = scenes.load(SCENE)
    exact = cached_reference(problem)
    for place in found.places:
        state, steps = Racer(Equations(problem), exact, place.entry).run(place.control)
        assert distance(problem, state, exact.state) <= found.request.error
        assert steps == place.steps


def test_the_places_are_sorted_by_time(found: Recommendation) -> None:
    times = [place.seconds for place in found.places]
    assert times == sorted(times)


@pytest.mark.slow
def test_the_stack_of_every_place_is_within_the_limit() -> None:
    free = recommend(Request(SCENE, 1e-6, tableaux=FEW))
    stacks = sorted(place.entry.features.stack for place in free.places)
    limit = stacks[0]
    assert limit < stacks[-1]
    bound = recommend(Request(SCENE, 1e-6, stack=limit, tableaux=FEW))
    assert bound.places
    assert max(place.entry.features.stack for place in bound.places) <= limit


@pytest.mark.slow
def test_a_method_that_loses_a_conserved_quantity_is_not_recommended_for_long_times(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from codegen.lab.efficiency import search as module

    free = recommend(Request(SCENE, 1e-4, ("symplectic",), tableaux=FEW))
    first = free.places[0].entry.recipe.label
    real = module.Search._loses
    monkeypatch.setattr(
        module.Search, "_loses", lambda s, r, n: r.entry.recipe.label == first or real(s, r, n)
    )
    without = recommend(Request(SCENE, 1e-4, ("symplectic",), tableaux=FEW))
    # The first two places have survived a long run.
    assert first not in [place.entry.recipe.label for place in without.places[:2]]
    assert without.places, "further recipes are measured if the measured ones are lost"
    monkeypatch.setattr(module.Search, "_loses", lambda s, r, n: True)
    nothing = recommend(Request(SCENE, 1e-4, ("symplectic",), tableaux=FEW))
    assert first in nothing.lost
    assert not nothing.places
    assert nothing.best is None or nothing.best.entry.recipe.label not in nothing.lost


@pytest.mark.slow
def test_shorter_steps_are_tried_if_a_long_run_loses_a_conserved_quantity(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from codegen.lab.efficiency import search as module

    free = recommend(Request(SCENE, 1e-4, ("symplectic",), tableaux=("lobatto3a2",)))
    steps = {place.entry.recipe: place.steps for place in free.places}
    durations: set[float] = set()

    def loses(search: module.Search, result: Result, count: int) -> bool:
        durations.add(count / result.steps)
        return result.steps < 4 * steps[result.entry.recipe]

    monkeypatch.setattr(module.Search, "_loses", loses)
    kept = recommend(Request(SCENE, 1e-4, ("symplectic",), tableaux=("lobatto3a2",)))
    assert not kept.lost
    assert kept.places[0].steps == 4 * steps[kept.places[0].entry.recipe]
    assert kept.places[0].error < free.places[0].error


def test_a_method_that_fails_the_long_run_is_not_the_most_accurate_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(search.Search, "_loses", lambda s, r, n: True)
    found = recommend(Request(SCENE, 1e-3, ("symplectic",), tableaux=("midpoint",)))
    assert found.lost
    assert found.as_json()["recommended"] is None
    assert found.as_json()["most_accurate"] is None
    assert "loses a conserved quantity in a long run" in unreached(found)


def test_an_error_that_nothing_reaches_gives_the_most_accurate_run() -> None:
    found = recommend(Request(SCENE, 1e-30, ("explicit",), tableaux=("rk4", "dop853")))
    assert not found.places
    assert found.best is not None
    assert 1e-30 < found.best.error < 1e-10


@pytest.mark.parametrize("need", ["fast", "Manifold", ""])
def test_an_unknown_need_is_refused(need: str) -> None:
    with pytest.raises(InputError, match="unknown need"):
        Request(SCENE, 1e-6, (need,))


def test_every_recipe_is_a_method_of_the_scene() -> None:
    problem = scenes.load("free_rigid_body")
    recipes = list(candidates(problem, FEW))
    families = families_for(problem)
    assert {parse(r.method, families).label for r in recipes} == {r.method for r in recipes}
    assert len(set(recipes)) == len(recipes)


def test_only_families_in_coordinates_have_recipes_for_other_forms() -> None:
    forms: dict[str, set[str]] = {}
    for recipe in candidates(scenes.load("dipole"), ("rk4",)):
        forms.setdefault(recipe.family, set()).add(recipe.form)
    assert PRINTED in forms["ambient"]
    assert len(forms.pop("ambient")) > 1
    assert all(known == {PRINTED} for known in forms.values())


def test_methods_with_an_embedded_row_have_recipes_with_and_without_step_control() -> None:
    recipes = list(candidates(scenes.load("free_rigid_body"), ("dormand_prince5",)))
    assert {r.adaptive for r in recipes if r.family == "ambient"} == {False, True}


@pytest.mark.parametrize("label", ["rkmk:rk4", "ambient:dop853", "cf:cf4", "ambient:gauss2"])
def test_the_predicted_steps_reach_nearly_the_error(label: str) -> None:
    """The number of steps for the error agrees with the emitted code up to a factor 1.5."""
    problem = scenes.load("free_rigid_body")
    equations, exact = Equations(problem), cached_reference(problem)
    method = parse(label, families_for(problem))
    order = {"rkmk:rk4": 4, "ambient:dop853": 8, "cf:cf4": 4, "ambient:gauss2": 4}[label]
    prediction = Predictor(equations, exact).predict(method, order, Bar(1e-9))
    recipe = Recipe(label, order, 4, method.name)
    racer = Racer(equations, exact, entry(recipe, compile_method(problem, method)))
    result = racer.reach(1e-9)
    assert 1 / 1.5 < (result.steps + 0.5) / (prediction.count(1e-9) + 0.5) < 1.5


@pytest.mark.slow  # the reference solution of a stiff scene
@pytest.mark.parametrize("label", ["ambient:dop853", "taylor(8)", "rkmk:rk4"])
def test_methods_that_need_many_steps_for_stability_are_predicted(label: str) -> None:
    """The prediction agrees with the emitted code up to a factor of four in the number of steps.

    It is too large, because this scene damps the errors that a prediction adds up.
    """
    task = Task("stiff_driven_spin")
    recipe = next(r for r in task.recipes() if r.method == label and not r.adaptive)
    prediction = predicted(task, (recipe, (Bar(1e-8),)))
    assert prediction is not None
    known = emitted(task, recipe)
    assert isinstance(known, Entry)
    racer = Racer(task.equations(PRINTED), cached_reference(task.problem()), known)
    assert 1 / 4 < racer.reach(1e-8).steps / prediction.count(1e-8) < 4


def test_a_prediction_scales_with_the_order() -> None:
    known = Prediction("m", 4, steps=8, error=1e-4, outside=10.0)
    assert math.isclose(known.count(1e-8), 80.0)
    assert math.isclose(replace(known, order=2).count(1e-8), 800.0)
    assert known.seconds(1e-8) > known.seconds(1e-6)


def test_a_bar_drops_slow_steps_and_orders_below_those_that_are_far_from_the_error() -> None:
    bar = Bar(1e-12, 1e-6, (("cf", True, 1e-9), ("", True, 1e-13), ("", False, 1.0)))
    assert bar.too_high("cf", True)  # methods of higher order in this family are a thousand times off
    assert not bar.too_high("rkmk", True)
    assert bar.too_high("rkmk", True, 1e-5)
    assert bar.hopeless("cf")
    assert not bar.hopeless("rkmk")
    assert not Bar(1e-12).too_high("cf", False, 1.0)


def test_jobs_of_slow_families_wait() -> None:
    """A family that is predicted to be 1000 times slower has its second turn after all others."""
    goal = Goal(1e-6)
    recipes = [Recipe(f"{f}:m{k}", 4, k, f"m{k}") for f in ("slow", "fast") for k in range(6)]
    jobs = Jobs({recipe: [goal] for recipe in recipes})
    order = []
    for k in range(len(jobs)):
        recipe, bars = jobs[k]
        order.append(recipe.method)
        assert len(bars) == 1
        outside = 1e3 if recipe.family == "slow" else 1.0
        jobs.add(recipe, Prediction(recipe.method, 4, recipe.family, error=1e-6, outside=outside))
    assert order.index("fast:m5") < order.index("slow:m1")
    assert sorted(order) == sorted(r.method for r in recipes)


def test_methods_with_an_error_estimate_have_an_early_turn() -> None:
    """In a slow kind, the first method with step-size control is predicted before most other methods."""
    recipes = [Recipe(f"{f}:m{k}", 4, k, f"m{k}") for f in ("slow", "fast") for k in range(9)]
    jobs = Jobs({recipe: [Goal(1e-6)] for recipe in recipes}, {recipes[8]: [Goal(1e-6)]})
    order = []
    for k in range(len(jobs)):
        recipe, _ = jobs[k]
        order.append(recipe.method)
        outside = 1e3 if recipe.family == "slow" else 1.0
        jobs.add(recipe, Prediction(recipe.method, 4, recipe.family, error=1e-6, outside=outside))
    assert order.index("slow:m8") < 3
    assert order.index("slow:m1") > 8


@pytest.mark.parametrize("controlled", [False, True])
def test_rough_predictions_exclude_only_recipes_without_step_size_control(controlled: bool) -> None:
    """Equal steps of a higher order are slow, which says nothing about controlled steps of a lower order."""
    goal = Goal(1e-12)
    low, high, other = (Recipe(f"{f}:m{k}", k, k, f"m{k}") for f, k in (("f", 5), ("f", 6), ("g", 6)))
    jobs = Jobs({r: [goal] for r in (low, high, other)}, {low: [goal]} if controlled else {})
    jobs.add(other, Prediction(other.method, 6, "g", outside=1e3, error=1e-12))
    jobs.add(high, Prediction(high.method, 6, "f", outside=1e3, error=1e-2, rough=True))
    assert jobs._bar(goal, low).too_high("f", True) != controlled
    # A prediction for step-size control is used.
    slow = Prediction(high.method, 6, "f", outside=1e3, error=1e-2)
    jobs.add(high, replace(slow, rough=True, controlled=slow))
    assert jobs._bar(goal, low).too_high("f", True)


def test_a_prediction_is_rough_if_no_run_on_the_whole_span_is_accurate(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = scenes.load("free_rigid_body")
    method = parse("ambient:explicit_midpoint", families_for(problem))

    def rough() -> bool:
        predictor = Predictor(Equations(problem), cached_reference(problem))
        return predictor.predict(method, 2, Bar(1e-9)).rough

    assert not rough()
    monkeypatch.setattr(prediction, "MANY_STEPS", prediction.FEW_STEPS)
    monkeypatch.setattr(prediction, "SMALL", 1e-9)
    assert rough()


@pytest.mark.parametrize("rough", [False, True])
def test_step_size_control_is_tried_if_equal_steps_have_large_errors(rough: bool) -> None:
    """One method with step-size control is measured although equal steps are predicted to be slow."""
    goal = Goal(1e-6)
    search = Search(Task(SCENE, tableaux=("rk4", "dormand_prince5")), (goal,))
    for recipe in search.suited:
        slow = 100.0 if recipe.tableau == "dormand_prince5" else 1.0
        known = Prediction(recipe.method, 4, recipe.family, outside=1e3 * slow, error=1e-6, rough=rough)
        search.predictions[recipe.method, recipe.form] = known
    search._correct()
    chosen = search._next()
    assert not any(r.tableau == "dormand_prince5" and not r.adaptive for r in chosen)
    kinds = [search.kind(r) for r in chosen if r.adaptive]
    assert bool(kinds) == rough
    assert len(set(kinds)) == len(kinds)


@pytest.mark.slow  # a search in the whole library
def test_methods_with_step_size_control_are_found_on_a_stiff_scene() -> None:
    """Most of the steps of these methods are spent in the first thousandth of the span."""
    request = Request("stiff_driven_spin", 1e-8)
    found = recommend(request)
    task = request.task
    recipe = next(r for r in task.recipes() if r.label == "adaptive ambient:lobatto3a4")
    known = emitted(task, recipe)
    assert isinstance(known, Entry)
    exact = cached_reference(task.problem())
    racers = [Racer(task.equations(e.recipe.form), exact, e) for e in (found.places[0].entry, known)]
    controls = [racer.reach(1e-8).control for racer in racers]
    # The two runs are timed in turns, so that the load of the machine affects both.
    times = [[r.seconds(c) for r, c in zip(racers, controls, strict=True)] for _ in range(5)]
    best, lobatto = map(min, zip(*times, strict=True))
    assert best <= 1.25 * lobatto


def test_functions_of_doubles_agree_with_the_operations_that_they_replace() -> None:
    problem = scenes.load("dipole")
    equations, exact = Equations(problem), cached_reference(problem)
    predictor = Predictor(equations, exact)
    for label in ("vcg:midpoint", "rkmk(2):rk4", "splitting:strang", "taylor(6)"):
        method = parse(label, families_for(problem))
        own, program = problem_for(problem, method), lower(problem, method)
        widths = widths_of_inputs(program, own)
        predictor.cost(program, own, widths)
        numeric = predictor.numeric.of(program, own, widths)
        states = [run(p, own, 8)[0] for p in (program, numeric)]
        assert max(abs(a - b) for a, b in zip(*states, strict=True)) < 1e-8
        assert all(isinstance(s, Solve) or s.operation.name for s in numeric.body)


def test_one_search_serves_several_goals() -> None:
    """Each goal has the places that meet its own error and needs; runs are shared."""
    goals = (Goal(1e-4), Goal(1e-8), Goal(1e-8, ("symplectic",)))
    search = Search(Task(SCENE, tableaux=FEW), goals)
    search.run()
    for goal in goals:
        places, _ = search.leaders(goal)
        assert places
        assert all(p.error <= goal.error and goal.met(p.entry.features) for p in places)
    assert search.results[1e-8].keys() >= {p.entry.recipe for p in search.leaders(goals[2])[0]}


def test_a_racer_reaches_the_same_error_after_it_has_reached_larger_errors() -> None:
    problem = scenes.load("free_rigid_body")
    equations, exact = Equations(problem), cached_reference(problem)
    known = entry(Recipe("cf:cf4", 4, 4, "cf4"), compile_method(problem, "cf:cf4"))
    used = Racer(equations, exact, known)
    for error in (1e-2, 1e-4, 1e-6, 1e-8):
        used.reach(error)
    fresh = Racer(equations, exact, known).reach(1e-10)
    assert fresh.reached
    assert used.reach(1e-10).steps == fresh.steps


class SlowReference:
    """A clock that only the reference solution advances, by a part of the budget."""

    def __init__(self, part: float, budget: float) -> None:
        self.now, self.length = 100.0, part * budget
        self.end = 0.0

    def monotonic(self) -> float:
        return self.now

    def reference(self, problem: Problem, end: float) -> Reference:
        self.now, self.end = self.now + self.length, end
        return cached_reference(problem)


@pytest.mark.parametrize("part", [0.01, 0.59])
def test_the_budget_includes_the_reference_and_leaves_time_for_predictions(
    monkeypatch: pytest.MonkeyPatch, part: float
) -> None:
    clock = SlowReference(part, 10.0)
    monkeypatch.setattr(search, "time", clock)
    monkeypatch.setattr(search, "cached_reference", clock.reference)
    started = Search(Task(SCENE, budget=10.0, tableaux=("rk4", "dop853")), (Goal(1e-6),))
    assert math.isclose(started.spent, part)
    assert 100.0 < clock.end < 110.0
    started.predict()
    assert started.complete
    assert len(started.predictions) > 1


def test_a_reference_that_is_not_finished_in_time_is_one_error(monkeypatch: pytest.MonkeyPatch) -> None:
    times = iter(float(k) for k in range(10**6))
    monkeypatch.setattr(references, "time", SimpleNamespace(monotonic=lambda: next(times)))
    with pytest.raises(SceneError, match="the reference solution takes too long"):
        reference(scenes.load(SCENE), 5.0)
    assert next(times) < 8.0


def test_a_long_reference_is_stated() -> None:
    known = Recommendation(Request(SCENE, 1e-6), (), None, 2, 1, 10.0, referred=0.5)
    assert "the reference solution took 50% of the budget" in searched(known)
    assert "reference" not in searched(replace(known, referred=0.01))


@pytest.mark.parametrize(("seconds", "most"), [(1e-6, 32), (1.0, 1)])
@pytest.mark.parametrize("adaptive", [False, True])
def test_only_short_races_are_timed_over_several_spans(
    monkeypatch: pytest.MonkeyPatch, adaptive: bool, seconds: float, most: int
) -> None:
    """The clock advances by ``seconds`` for each span; the run has four steps."""
    problem = scenes.load("free_rigid_body")
    method = replace(parse("ambient:dormand_prince5", families_for(problem)), adaptive=adaptive)
    recipe = Recipe("ambient:dormand_prince5", 5, 7, "dormand_prince5", adaptive)
    racer = Racer(
        Equations(problem), cached_reference(problem), entry(recipe, compile_method(problem, method))
    )
    clock, asked = SimpleNamespace(now=0.0), set[int]()

    def run(control: float, spans: int = 1) -> tuple[tuple[float, ...], int]:
        asked.add(spans)
        clock.now += 1e-7 + seconds * spans
        return (), 4 * spans

    time = SimpleNamespace(process_time=lambda: clock.now, thread_time=lambda: clock.now)
    monkeypatch.setattr(timing, "time", time)
    monkeypatch.setattr(racer, "run", run)
    racer.counts[4.0] = 4
    racer.seconds(4.0)
    assert max(asked) == most


def test_named_methods_alone_are_searched() -> None:
    task = Task("dipole", methods=(("cf:cf4", False), ("ambient:dop853", True)))
    recipes = task.recipes()
    assert {(r.method, r.adaptive, r.order) for r in recipes} == {
        ("cf:cf4", False, 4),
        ("ambient:dop853", True, 8),
    }
    assert len({r.form for r in recipes if r.family == "ambient"}) > 1


def test_a_search_among_very_few_tableaux_ends() -> None:
    """A single job runs in this process, and the queue of jobs must end there too."""
    result = recommend(Request("free_rigid_body", 1e-3, tableaux=("cf4",)))
    assert all(p.entry.recipe.method.endswith("cf4") for p in result.places)
    assert result.places
    assert list(Jobs({})) == []


@pytest.mark.parametrize("scene", ["dipole", "free_rigid_body"])
def test_needs_are_possible_together_if_each_of_them_is_possible(scene: str) -> None:
    problem = scenes.load(scene)
    choices = {goal for k in range(3) for goal in combinations(("manifold", "symplectic", "fixed"), k)}
    for recipe in candidates(problem, ("rk4", "cf4", "gauss2", "dormand_prince5")):
        known = {needs for needs in choices if possible(recipe, needs, problem)}
        assert possible_needs(recipe, choices, problem) == known
