"""Recommends the fastest recipe of the library for a required error and other requirements.

A recipe is a method with equal steps or step-size control, on one form of the equations.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from fractions import Fraction

from codegen.lab.efficiency.goal import Goal
from codegen.lab.efficiency.race import Result
from codegen.lab.efficiency.search import Search
from codegen.lab.efficiency.task import BUDGET, Task
from codegen.lab.progress import Progress
from codegen.scene.problem import Problem


@dataclass(frozen=True)
class Request:
    """A request of the user for a recommendation.

    - ``scene``: the name of the scene.
    - ``error``: the largest accepted error at the end of the time span.
    - ``needs``: the names of requirements on the method (:data:`codegen.lab.efficiency.goal.NEEDS`).
    - ``stack``: the largest accepted stack memory of a call in bytes, or None for no limit.
    - ``span``: a time span that replaces the time span of the scene, or None.
    - ``budget``: the longest time of the search in seconds.
    - ``tableaux``: names of the tableaux of the methods to search, or () for all methods.
    """

    scene: str
    error: float
    needs: tuple[str, ...] = ()
    stack: int | None = None
    span: tuple[Fraction, Fraction] | None = None
    budget: float = BUDGET
    tableaux: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        assert self.goal  # ``Goal`` checks the attributes ``error`` and ``needs``.

    @property
    def goal(self) -> Goal:
        """The goal of the search: the required error, the requirements, and the limit of the stack memory."""
        return Goal(self.error, self.needs, self.stack)

    @property
    def task(self) -> Task:
        """The task of the search: the scene, its time span, the time limit of the search, and the methods."""
        return Task(self.scene, self.span, self.budget, self.tableaux)

    def problem(self) -> Problem:
        """Return the scene as a problem. If ``span`` is not None, it replaces the time span."""
        return self.task.problem()


@dataclass(frozen=True)
class Recommendation:
    """The result of a search for the fastest recipe.

    - ``places``: for each successful recipe, the fastest run with at most the required error. Fast runs
      come first.
    - ``best``: the most accurate run if ``places`` is empty, otherwise None. Only recipes that meet
      ``request.needs`` and ``request.stack`` are considered, without the recipes in ``lost``. If there are no
      such runs, ``best`` is None.
    - ``predicted``: the number of pairs (method, form of the equations) whose CPU time was predicted.
    - ``raced``: the number of measured recipes.
    - ``seconds``: the time of the search in seconds.
    - ``complete``: False if the time limit ended the search.
    - ``lost``: the labels of recipes that do not preserve a conserved quantity in a long run.
    - ``referred``: the time to compute the reference solution, as a fraction of the time limit.
    - ``kinks``: the number of points of the solution at which the vector field is not smooth.
    """

    request: Request
    places: tuple[Result, ...]
    best: Result | None
    predicted: int
    raced: int
    seconds: float
    complete: bool = True
    lost: tuple[str, ...] = ()
    referred: float = 0.0
    kinks: int = 0

    def as_json(self) -> dict[str, object]:
        """Return the recommendation as a dictionary that can be written as JSON."""
        asked, task = self.request, self.request.task
        return {
            "scene": asked.scene,
            "error": asked.error,
            "needs": list(asked.needs),
            "stack": asked.stack,
            "span": [float(x) for x in asked.problem().span],
            "recommended": place_json(task, self.places[0]) if self.places else None,
            "runner_up": place_json(task, self.places[1]) if len(self.places) > 1 else None,
            "most_accurate": place_json(task, self.best) if self.best else None,
            "predicted": self.predicted,
            "raced": self.raced,
            "complete": self.complete,
            "lost": list(self.lost),
            "kinks": self.kinks,
            "search_seconds": self.seconds,
        }


def place_json(task: Task, place: Result) -> dict[str, object]:
    """Return a measured run as a dictionary, with the ``orderconds`` command that emits its integrator."""
    recipe, properties = place.entry.recipe, place.entry.features
    return {
        "method": recipe.method,
        "form": recipe.form,
        "adaptive": recipe.adaptive,
        "h": step_of(task, place),
        "steps": place.steps,
        "tolerance": place.tolerance,
        "error": place.error,
        "seconds": place.seconds if math.isfinite(place.seconds) else None,
        "on_manifold": properties.on_manifold,
        "symplectic": properties.symplectic,
        "explicit": properties.explicit,
        "stack": properties.stack,
        "command": recipe.command(task.scene),
    }


def step_of(task: Task, place: Result) -> float | None:
    """Return the constant step size of the run that the argument ``place`` describes.

    The function returns None if this run has step-size control, or if ``place.steps`` is 0.
    """
    first, last = task.problem().span
    return None if place.entry.recipe.adaptive or not place.steps else float((last - first) / place.steps)


def recommend(request: Request, progress: Progress = str) -> Recommendation:
    """Search for the fastest recipe for a request, and return the recommendation.

    InputError is raised if the scene is unknown or if a value in the request is invalid.
    """
    search = Search(request.task, (request.goal,), progress)
    search.run()
    places, lost = search.leaders(request.goal)
    runs = [
        r
        for r in search.results[request.error].values()
        if request.goal.met(r.entry.features) and r.entry.recipe.label not in lost
    ]
    return Recommendation(
        request,
        tuple(places),
        None if places else min(runs, key=lambda r: r.error, default=None),
        len(search.predictions),
        len(search.raced),
        time.monotonic() - search.start,
        search.complete,
        tuple(lost),
        search.referred,
        len(search.exact.kinks),
    )
