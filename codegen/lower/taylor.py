"""Taylor's method in the coordinates of the state. Each step ends with a projection onto the manifold."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from codegen.errors import MethodError
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import TaylorStep, ToOrbit
from codegen.ir.values import Kind, Var
from codegen.ir.verify import verify
from codegen.lower.base import Lowering, Objection, without_formulas
from codegen.method import Method
from codegen.scene.ambient import ambient
from codegen.scene.evolution import evolution
from codegen.scene.orbit_projection import reaches_orbit
from codegen.scene.problem import Problem

LEAST = 2
"""The least degree for which step-size control is possible.

Step-size control compares the Taylor coefficients of the two highest degrees.
"""

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder


class Taylor(Lowering):
    """Taylor's method for y' = F(y) in R^n. The vector y contains the coordinates of the state.

    Each step evaluates a Taylor polynomial of degree P in the step size, so the order is P. If the states are
    points of a manifold in R^n, the value of the polynomial is projected onto the manifold.
    """

    family = "taylor"
    in_coordinates = True

    def keeps_manifold(self, scene: Problem) -> bool:
        """Return True if the computed states are on the manifold of the scene.

        The result is False if :meth:`Action.to_orbit` does not map points near the initial state onto the
        manifold.
        """
        return reaches_orbit(scene)

    def objection(self, scene: Problem) -> Objection | None:
        """Return an objection if the scene has run-time inputs, or a field without formulas in coordinates.

        For all other scenes, the result is None.
        """
        if not scene.inputs:
            return without_formulas(scene)
        return Objection(
            f", because the time derivatives of the run-time input {scene.inputs[0]} are unknown",
            "inputs that are given by formulas",
        )

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the equation y' = F(y) for the coordinates of the state."""
        # The equation is stored, because its derivation takes time.
        if "taylor" not in scene.derived:
            scene.derived["taylor"] = replace(ambient(scene), evolution=evolution(scene))
        return scene.derived["taylor"]

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a step: the Taylor polynomial and the projection onto the manifold."""
        degree = self.conditions(method).degree_of_step()
        # ``moved`` is the value of the Taylor polynomial, and ``end`` is the projection of ``moved``.
        y, moved, end = (Var(name, Kind.POINT) for name in ("y", "moved", "end"))
        # If the field does not depend on time, the operation TaylorStep has no time argument.
        time = () if problem.autonomous else (Var("t", Kind.REAL),)
        body = (
            Assign((moved,), TaylorStep(degree, bool(time)), (y, *time)),
            # The manifold is the orbit of the old state y, so y is an argument of the projection.
            Assign((end,), ToOrbit(), (moved, y)),
        )
        return verify(Program(method.label, (y, *time), body, (("y", end),)))

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return False, because Taylor's method is in general not symplectic."""
        return False

    def degree(self, method: Method) -> int:
        """Return the degree of the Taylor polynomial.

        MethodError is raised if the method has step-size control and the degree is less than :data:`LEAST`.
        """
        degree = self.conditions(method).degree_of_step()
        # The step-size formula contains a root of order ``degree`` - 1, so degree 1 is excluded.
        if method.adaptive and degree < LEAST:
            raise MethodError(
                f"no step-size control for {method.label}, because its degree is too low",
                expected=f"a Taylor polynomial of degree {LEAST} or higher",
            )
        return degree

    def order(self, method: Method, scene: Problem | None = None) -> FamilyOrder:
        """Return the order of the method: the degree of the Taylor polynomial."""
        from orderconds.checking import FamilyOrder

        family = self.conditions(method)
        # The order follows from the construction, so no order conditions are checked.
        return FamilyOrder(family.label(), family.degree_of_step(), "construction", True, (), None)
