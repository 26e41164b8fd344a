"""Runge-Kutta methods on R^n, compiled as Munthe-Kaas methods without brackets."""

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
        """Return None for a differential equation on R^n, and an objection for all other scenes."""
        group = scene.as_field().group
        # On R^n, every group element acts as a translation: exp(u).y = y + u.
        if group.abelian:
            return None
        hint = "use rkmk, cg or cf, or use ambient, which does not preserve the manifold"
        return Objection(f", whose group is {group.name}", "R^n", hint)

    def extension(self, problem: Problem, method: Method) -> Program | None:
        """Return the program of the continuous extension.

        The result is None if the tableau is implicit or has no continuous extension.
        """
        # On R^n, dexp^{-1} is the identity, so no term with a bracket is needed.
        return extension_with_cutoff(problem, method, 0)

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program for one step of a Runge-Kutta method."""
        # On R^n, all brackets vanish, so a program without brackets has the order of the tableau.
        return with_cutoff(problem, method, 0)
