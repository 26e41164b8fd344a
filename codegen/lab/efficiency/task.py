"""The task of a search for the fastest methods, and the functions that run in its worker processes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, partial

from codegen import scenes
from codegen.build import build
from codegen.emitter import compile_method
from codegen.lab.efficiency.candidates import Recipe, candidates, method_of, named
from codegen.lab.efficiency.equations import Equations, all_equations
from codegen.lab.efficiency.prediction import PARTS, Bar, Prediction, Predictor
from codegen.lab.efficiency.race import Entry, entry
from codegen.lab.reference import Reference, cached_reference
from codegen.scene.problem import Problem
from orderconds.errors import InputError

BUDGET = 50.0
"""The default time of a search in seconds. The search finishes the current recipe after this time."""


@dataclass(frozen=True)
class Task:
    """The name of a scene, and the extent of the search.

    If ``span`` is not None, it replaces the span of the scene. ``budget`` is the longest time of the search
    in seconds. If ``tableaux`` is not empty, only methods with these tableaux are searched. ``methods``
    contains pairs: the label of a method, and True if the method has step-size control. If ``methods`` is
    empty, all methods of the library are searched.
    """

    scene: str
    span: tuple[Fraction, Fraction] | None = None
    budget: float = BUDGET
    tableaux: tuple[str, ...] = ()
    methods: tuple[tuple[str, bool], ...] = ()

    def problem(self) -> Problem:
        """Return the scene with the span of the task."""
        return _problem(self.scene, self.span)

    def first_part(self) -> Task:
        """Return the task on the first of :data:`PARTS` equal parts of the span."""
        first, last = self.problem().span
        return replace(self, span=(first, first + (last - first) / PARTS))

    def equations(self, form: str) -> Equations:
        """Return the equations of the scene in the classical form with the name ``form``."""
        return _equations(self.scene, self.span, form)

    def recipes(self) -> list[Recipe]:
        """Return the recipes to search."""
        if self.methods:
            return list(named(self.problem(), self.methods))
        return list(candidates(self.problem(), self.tableaux))


@dataclass(frozen=True)
class Failed:
    """A recipe that the compiler refuses, with the reason."""

    recipe: Recipe
    reason: str


@cache
def _problem(scene: str, span: tuple[Fraction, Fraction] | None) -> Problem:
    problem = scenes.with_one_system(scenes.load(scene))
    return problem if span is None else replace(problem, span=span)


@cache
def _equations(scene: str, span: tuple[Fraction, Fraction] | None, form: str) -> Equations:
    (equations,) = all_equations(_problem(scene, span), (form,))
    return equations


@cache
def _predictor(task: Task, form: str) -> Predictor:
    return Predictor(
        task.equations(form), cached_reference(task.problem()), partial(_beginning, task.first_part(), form)
    )


@cache
def _beginning(task: Task, form: str) -> tuple[Equations, Reference]:
    return task.equations(form), cached_reference(task.problem())


def predicted(task: Task, job: tuple[Recipe, tuple[Bar, ...]]) -> Prediction | None:
    """Return the predicted errors and times of a recipe. This function runs in a worker process.

    ``job`` contains the recipe and the bars (limits on the error and on the time). Runs with
    equal steps are predicted first. If their errors are large and the recipe has step-size control, runs with
    step-size control are also predicted. The result is None if there is no bar.
    """
    recipe, bars = job
    if not bars:
        return None
    problem = task.problem()
    try:
        method = method_of(recipe, problem)
        equal, controlled = replace(method, adaptive=False), method if recipe.adaptive else None
        return _predictor(task, recipe.form).predict(equal, recipe.order, *bars, controlled=controlled)
    except (InputError, ArithmeticError) as error:
        return Prediction(recipe.method, recipe.order, failure=str(error))


def emitted(task: Task, recipe: Recipe) -> Entry | Failed:
    """Compile the module of a recipe and return the entry, or the reason why the compiler refuses the recipe.

    This function runs in a worker process.
    """
    problem = task.problem()
    try:
        candidate = entry(recipe, compile_method(problem, method_of(recipe, problem), form=recipe.form))
        build(candidate.artifact.files)
    except (InputError, ArithmeticError) as error:
        return Failed(recipe, str(error))
    return candidate
