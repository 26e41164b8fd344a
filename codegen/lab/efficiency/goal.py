"""The goals of a search for the fastest methods.

A goal consists of the largest accepted error at the end of the time span and the requirements on the method.
A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size control.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from codegen.errors import MethodError
from codegen.lab.efficiency.candidates import Recipe, method_of
from codegen.lab.efficiency.features import Features
from codegen.lower import lowering
from codegen.scene.classical_forms import PRINTED
from codegen.scene.problem import Problem
from orderconds.errors import InputError, UnknownName


@dataclass(frozen=True)
class Need:
    """A requirement on methods, with its name and its meaning.

    ``long`` is True if the search tests the requirement in a long run.
    """

    name: str
    meaning: str
    long: bool = False


NEEDS = (
    Need("manifold", "the state stays on the manifold up to rounding"),
    Need(
        "symplectic",
        "each step is a symplectic map; a long run tests the conservation of invariants",
        long=True,
    ),
    Need("explicit", "no equations are solved; each step takes the same time"),
    Need("adaptive", "step sizes are controlled by an error estimate"),
    Need("fixed", "all steps have the same size"),
)


@dataclass(frozen=True)
class Goal:
    """A goal of a search.

    - ``error``: the largest accepted error at the end of the time span.
    - ``needs``: the names of the requirements on the method, from :data:`NEEDS`.
    - ``stack``: the largest accepted stack memory of a call in bytes, or None for no limit.
    """

    error: float
    needs: tuple[str, ...] = ()
    stack: int | None = None

    def __post_init__(self) -> None:
        known = [need.name for need in NEEDS]
        for name in self.needs:
            if name not in known:
                raise UnknownName(f"unknown need {name!r}", where="--need", expected=", ".join(known))
        if not 0 < self.error < math.inf:
            raise InputError(f"the error {self.error:g}", where="--error", expected="a number above 0")

    @property
    def long(self) -> bool:
        """True if the search tests one of the requirements in a run with many steps."""
        return any(need.long for need in NEEDS if need.name in self.needs)

    @property
    def explicit(self) -> bool:
        """True if the goal requires an explicit method: a method that solves no equations."""
        return "explicit" in self.needs

    def met(self, properties: Features) -> bool:
        """Return True if a compiled method with these properties satisfies the requirements of the goal.

        If the goal limits the stack memory, an upper bound of the stack memory of the method must be known,
        and the bound must be at most the limit.
        """
        given = {
            "manifold": properties.on_manifold,
            "symplectic": properties.symplectic,
            "explicit": properties.explicit,
            "adaptive": properties.adaptive,
            "fixed": not properties.adaptive,
        }
        return all(given[name] for name in self.needs) and (
            self.stack is None or 0 < properties.stack <= self.stack
        )


def possible(recipe: Recipe, needs: tuple[str, ...], problem: Problem) -> bool:
    """Return False if a recipe violates one of the requirements ``needs``.

    If the result is True, the compiled method must still be checked with :meth:`Goal.met`.
    """
    if ("adaptive" in needs and not recipe.adaptive) or ("fixed" in needs and recipe.adaptive):
        return False
    if "manifold" in needs and not stays_on_manifold(recipe, problem):
        return False
    if "symplectic" not in needs:
        return True
    if recipe.adaptive or not problem.is_hamiltonian:
        return False
    try:
        return lowering(recipe.family).symplectic(problem, method_of(recipe, problem))
    except MethodError:
        return False


def possible_needs(
    recipe: Recipe, choices: Iterable[tuple[str, ...]], problem: Problem
) -> set[tuple[str, ...]]:
    """Return the elements of ``choices`` that :func:`possible` allows for a recipe.

    Each tuple contains names of requirements from :data:`NEEDS`.
    """
    choices = set(choices)
    never = {need for need in set().union(*choices) if not possible(recipe, (need,), problem)}
    return {needs for needs in choices if never.isdisjoint(needs)}


def stays_on_manifold(recipe: Recipe, problem: Problem) -> bool:
    """Return True if the states that a recipe computes stay on the manifold of the scene.

    Rounding errors are not considered.
    """
    return recipe.form == PRINTED and lowering(recipe.family).keeps_manifold(problem)
