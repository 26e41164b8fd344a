"""The description of a search for the fastest methods, and functions that run in worker processes.

The search compares recipes. A recipe consists of a method, one form of the equations, and the choice of equal
steps or step-size control.
"""

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
"""The default time limit of a search in seconds."""


@dataclass(frozen=True)
class Task:
    """The task of a search for fast methods: a scene, and the methods to compare.

    - ``scene``: the name of the scene.
    - ``span``: a time span that replaces the time span of the scene, or None.
    - ``budget``: the longest time of the search in seconds.
    - ``methods``: a pair (label, adaptive) for each method, or () for all methods of the library. The entry
      ``adaptive`` is True if the method uses step-size control.
    - ``tableaux``: the names of the permitted tableaux, or () for all tableaux. ``tableaux`` is used only if
      ``methods`` is empty.
    """

    scene: str
    span: tuple[Fraction, Fraction] | None = None
    budget: float = BUDGET
    tableaux: tuple[str, ...] = ()
    methods: tuple[tuple[str, bool], ...] = ()

    def problem(self) -> Problem:
        """Return the scene. If ``span`` is not None, it replaces the time span of the scene."""
        return _problem(self.scene, self.span)

    def first_part(self) -> Task:
        """Return a copy of the task with a shorter time span. The length is divided by :data:`PARTS`."""
        first, last = self.problem().span
        return replace(self, span=(first, first + (last - first) / PARTS))

    def equations(self, form: str) -> Equations:
        """Return the equations of the scene in the classical form with the name ``form``."""
        return _equations(self.scene, self.span, form)

    def recipes(self) -> list[Recipe]:
        """Return the recipes that the search compares.

        A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size
        control.
        """
        if self.methods:
            return list(named(self.problem(), self.methods))
        return list(candidates(self.problem(), self.tableaux))


@dataclass(frozen=True)
class Failed:
    """A recipe (a method on one form of the equations) that cannot be compiled, and the reason."""

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
    """Return the predicted errors and times of a recipe.

    ``job`` contains the recipe and its bars (limits on the error and on the CPU time). If there are no bars,
    the result is None.
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
    """Emit and compile the module of a recipe. Return the module, or the reason why it cannot be built."""
    problem = task.problem()
    try:
        candidate = entry(recipe, compile_method(problem, method_of(recipe, problem), form=recipe.form))
        build(candidate.artifact.files)
    except (InputError, ArithmeticError) as error:
        return Failed(recipe, str(error))
    return candidate
