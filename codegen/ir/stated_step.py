"""The operation for a step y -> M y, where the user gives the matrix M as a formula."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from codegen.ir.domain import Domain, Values
from codegen.ir.operations import Operation, P, R
from codegen.ir.operations import Problem as AnyProblem

if TYPE_CHECKING:
    from codegen.scene.problem import Problem


@dataclass(frozen=True)
class StatedStep(Operation):
    """The point M y after a step. The scene (the user's problem) gives the matrix M as a formula in t and h.

    The arguments are the point y and the time t. ``step`` is the name of the formula in the scene.
    """

    step: str
    takes, gives = P + R, P
    evaluates_scene = True
    name = "stated_step"
    noun = "stated step{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by the name of the formula for M."""
        return f"{self.name}({self.step})"

    def evaluate(self, problem: AnyProblem, domain: Domain, args: Values) -> Values:
        """Return the new point M y."""
        y, t = args
        scene = cast("Problem", problem)
        return (scene.stated_step(domain, self.step, y, t),)
