"""The step y -> M y with a matrix M that the user defines by a formula."""

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
    """The operation that maps the point y before a step to the point M y after the step.

    The arguments are y and the time t before the step. The user's problem defines the matrix M by a formula
    with the name ``step``.
    """

    step: str
    takes, gives = P + R, P
    evaluates_scene = True
    name = "stated_step"
    noun = "stated step{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by the value of ``self.step`` in parentheses."""
        return f"{self.name}({self.step})"

    def evaluate(self, problem: AnyProblem, domain: Domain, args: Values) -> Values:
        """Return the point after the step. ``args`` is the pair (y, t)."""
        y, t = args
        scene = cast("Problem", problem)
        return (scene.stated_step(domain, self.step, y, t),)
