"""The operation for a step y -> M y, where the scene states the matrix M as a formula."""

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
    """The point M y, where the scene states the matrix M. The arguments are y and the time t."""

    step: str
    takes, gives = P + R, P
    evaluates_scene = True
    name = "stated_step"
    noun = "stated step{s}"

    def text(self) -> str:
        """Return the name of the operation, followed by the name of the step."""
        return f"{self.name}({self.step})"

    def evaluate(self, problem: AnyProblem, domain: Domain, args: Values) -> Values:
        """Return M y."""
        # M may depend on the time, so t is an argument.
        y, t = args
        scene = cast("Problem", problem)
        return (scene.stated_step(domain, self.step, y, t),)
