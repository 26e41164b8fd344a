"""Variational lowerings on T*G: they take Hamiltonian scenes, and their steps are symplectic."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.errors import MethodError
from codegen.ir.number import Number
from codegen.ir.values import Kind, Var
from codegen.lower.base import Lowering, Objection
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.errors import ZeroWeight
from orderconds.tableau import RungeKutta


class VariationalLowering(Lowering):
    """A family that discretises Hamilton's principle on a group; it sees (q, mu) and the Hamiltonian."""

    hamiltonian = True
    preference = 1  # a Hamiltonian scene is usually integrated for long times, which needs symplectic steps

    def objection(self, scene: Problem) -> Objection | None:
        """Return why the family does not take a scene."""
        return None if scene.is_hamiltonian else Objection("", "a Hamiltonian scene")

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene itself."""
        return scene

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True: discrete Hamiltonian flows are symplectic maps."""
        return True


def begin(scene: Problem, method: Method) -> tuple[Stages, RungeKutta, list[list[Number]], list[Number]]:
    """Return the stages of a step from (q, mu), the tableau, and its A and b as numbers.

    :class:`orderconds.errors.ZeroWeight` where some b_i = 0.
    """
    tableau = method.runge_kutta()
    stages = Stages(scene, method, (Var("q", Kind.GROUP), Var("mu", Kind.DUAL)))
    A = [[stages.number(x) for x in row] for row in tableau.A]
    return stages, tableau, A, nonzero(method, [stages.number(x) for x in tableau.b])


def nonzero(method: Method, weights: Sequence[Number]) -> list[Number]:
    """Return the weights, which the step's equations divide by; ZeroWeight names the first zero one."""
    for i, weight in enumerate(weights, start=1):
        if weight.is_zero:
            raise ZeroWeight(
                f"b_{i} = 0", where=method.label, expected="all b_i non-zero: the method divides by them"
            )
    return list(weights)


def brackets(method: Method) -> int:
    """Return the cut-off of dexp^{-1}; MethodError without one: a program has finitely many brackets."""
    if method.cutoff is None:
        family, name = method.family_label, method.tableau.name
        raise MethodError(
            f"{family}:{name} without a cut-off", expected=f"a number of brackets, as {family}(2):{name}"
        )
    return method.cutoff
