"""Runge-Kutta methods on R^n: Munthe-Kaas methods without brackets, whose exponentials are translations."""

from __future__ import annotations

from codegen.ir.program import Program
from codegen.lower.base import Objection
from codegen.lower.field import FieldLowering
from codegen.lower.rkmk import extension_with_cutoff, with_cutoff
from codegen.method import Method
from codegen.scene.problem import Problem


class RungeKuttaLowering(FieldLowering):
    """Runge-Kutta methods on a vector space."""

    family = "rk"
    repeats_substeps = True

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene. Only scenes on R^n are accepted, because
        a step on another manifold would leave it."""
        group = scene.as_field().group
        # On R^n actions are translations: exp(u).y = y + u, and all brackets vanish.
        if group.abelian:
            return None
        hint = "use rkmk, cg or cf; or use ambient, whose steps leave the manifold"
        return Objection(f", whose group is {group.name}", "R^n", hint)

    def extension(self, problem: Problem, method: Method) -> Program | None:
        """Return the program of the continuous extension of an explicit tableau."""
        return extension_with_cutoff(problem, method, 0)

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program."""
        # On R^n all brackets vanish, so a program without brackets has the order of the tableau.
        return with_cutoff(problem, method, 0)
