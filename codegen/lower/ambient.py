"""Runge-Kutta methods in the coordinates of the state.

In general, the numerical solution leaves the manifold. Its distance from the manifold is at most the global
error.
"""

from __future__ import annotations

from codegen.ir.program import Program
from codegen.lower.base import Lowering, Objection, without_formulas
from codegen.lower.rkmk import with_cutoff
from codegen.method import Method
from codegen.scene.ambient import ambient
from codegen.scene.orbit_projection import orbit_is_open
from codegen.scene.problem import Problem


class Ambient(Lowering):
    """Runge-Kutta methods for y' = F(y) in R^n, where F is the field in the coordinates of the state."""

    family = "ambient"
    repeats_substeps = True
    in_coordinates = True

    def objection(self, scene: Problem) -> Objection | None:
        """Return None if the scene has a formula for each component of the vector field.

        Otherwise, return an objection.
        """
        return without_formulas(scene)

    def keeps_manifold(self, scene: Problem) -> bool:
        """Return True if the manifold is an open set in R^n.

        Computed states that are close enough to the exact solution are then on the manifold, too.
        """
        return self.objection(scene) is None and orbit_is_open(scene)

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene with the equation y' = F(y) on R^n, where y are the coordinates of the state."""
        # The derived scene is stored, because deriving it takes time.
        if "ambient" not in scene.derived:
            scene.derived["ambient"] = ambient(scene)
        return scene.derived["ambient"]

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a Runge-Kutta step for y' = F(y) on R^n."""
        # On R^n, exp(u).y = y + u and all brackets vanish. An RKMK method is then a Runge-Kutta method.
        return with_cutoff(problem, method, 0)
