"""Flows that a scene (the user's problem) gives as formulas."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from codegen.flows.part import Formula, Part
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr, evaluate
from codegen.scene.flow import Flow
from codegen.scene.hamiltonian_scene import TAU


@dataclass(frozen=True)
class Stated(Flow):
    """The flow of a part of the Hamiltonian. The scene gives formulas for (q, mu) after the time tau.

    When the scene is defined, the formulas are checked. If the formulas do not satisfy the equations of
    motion of the part, :class:`codegen.errors.SceneError` is raised.
    """

    formulas: tuple[Expr, ...]

    @property
    def expressions(self) -> tuple[Expr, ...]:
        """The attribute ``formulas``."""
        return self.formulas

    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return (q, mu) after the time tau, computed by the formulas of the scene."""
        state: Vector[S] = tuple(evaluate(self.formulas, d, {**values, TAU: tau}))
        return state[: len(q)], state[len(q) :]

    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Raise ArithmeticError, because the scene gives no formulas for the field."""
        raise ArithmeticError("the scene gives formulas for the flow of the part, but none for the field")

    def text(self) -> str:
        """Return a short description of the flow."""
        return "given by formulas in the scene"


def recognise(formula: Formula) -> Part | None:
    """Return a :class:`Part` with a flow that is computed by formulas of the scene.

    The name of the part is ``formula.name``. If the scene gives no formulas for this flow, return None.
    """
    formulas = formula.problem.stated.get(formula.name)
    return None if formulas is None else formula.whole(Stated(formulas))
