"""Runge-Kutta methods in the coordinates of the state, which leave the manifold by their error."""

from __future__ import annotations

from typing import TYPE_CHECKING

from codegen.ir.program import Program
from codegen.lower.base import Lowering
from codegen.lower.rkmk import with_cutoff
from codegen.method import Method
from codegen.scene.ambient import ambient
from codegen.scene.problem import Problem

if TYPE_CHECKING:
    from orderconds.families import Family


class Ambient(Lowering):
    """Runge-Kutta methods for y' = F(y) in R^n, where F is the field in the coordinates of the state."""

    family = "ambient"
    repeats_substeps = True

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene in the coordinates of its state; it has no group."""
        return ambient(scene)

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program."""
        return with_cutoff(problem, method, 0)

    def conditions(self, method: Method, scene: Problem | None = None) -> Family:
        """Return the conditions of Runge-Kutta methods, for the ambient space is R^n."""
        from orderconds import families

        return families.get("rk")
