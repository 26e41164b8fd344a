"""Cayley methods for y' = A(t).y: y1 = cay(Omega).y0 with cay(x) = (1 - x/2)^-1 (1 + x/2).

Omega is a linear combination of the values A_i = h A(t + c_i h) at the nodes c_i, of brackets of these
values, and of products such as A_1 A_2 A_1. The Lie algebra of the group must contain these products
(:mod:`orderconds.families.cayley`).
"""

from __future__ import annotations

from codegen.groups.capabilities import CayleyMap
from codegen.ir.scene_operations import CayleyElement
from codegen.ir.values import Var
from codegen.lower.base import Objection
from codegen.lower.linear import LinearLowering
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem


class CayleyLowering(LinearLowering):
    """Cayley methods, whose steps contain no exponential."""

    family = "cayley"

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene, or None if the family accepts it.

        The family accepts a scene if the equation has the form y' = A(t).y and the group has a Cayley map.
        """
        # The base class accepts only equations of the form y' = A(t).y.
        linear = super().objection(scene)
        group = scene.as_field().group
        if linear is not None or group.offers(CayleyMap) is not None:
            return linear
        expected = (
            "a group whose Lie algebra contains x^3 for each element x, such as SO(n), SE(3), Sp(2n) or U(n)"
        )
        return Objection(f", whose group is {group.name}", expected)

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return False, because Cayley maps of abelian groups do not give symplectic steps.

        An example is a Hamiltonian H(mu) on T*(SO(2) x SO(2)). The step adds 2 arctan(h H_i/2) to angle i,
        where H_i is the derivative of H by mu_i. The Jacobian of these angles with respect to mu is in
        general not symmetric, so the step is not symplectic.
        """
        return False

    def move(self, stages: Stages, x: Var, y: Var) -> Var:
        """Append the operations for cay(x).y to the program, and return the result."""
        # The group element cay(x) acts on the point y.
        return stages.builder.act("Y", stages.builder.add(CayleyElement(), "g", x), y)
