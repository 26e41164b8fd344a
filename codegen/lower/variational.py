"""Variational methods for Hamiltonian scenes on T*G. The steps of these methods are symplectic."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence

from codegen.errors import MethodError
from codegen.ir.number import Number
from codegen.ir.program import Program
from codegen.ir.values import MINUS_ONE, ONE, Kind, Var
from codegen.lower.base import Lowering, Objection
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.errors import ZeroWeight
from orderconds.tableau import RungeKutta

HAMILTONIAN = (
    "a Hamiltonian scene, because the state of a variational method contains a momentum, and a vector field "
    "on a manifold has no momentum"
)
"""The text in error messages for scenes without a Hamiltonian."""


class VariationalLowering(Lowering):
    """A family that discretises Hamilton's principle on a group.

    The scene must have a Hamiltonian, and its state is a pair (q, mu).
    """

    hamiltonian = True
    # The compiler prefers variational families, because symplectic methods usually have smaller errors over
    # long times.
    preference = 1

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene, or None if the family accepts it."""
        return None if scene.is_hamiltonian else Objection("", HAMILTONIAN)

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene unchanged."""
        return scene

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True, because the steps of variational methods are symplectic maps."""
        return True


def begin(scene: Problem, method: Method) -> tuple[Stages, RungeKutta, list[list[Number]], list[Number]]:
    """Return (stages, tableau, A, b) with the coefficients A and b of the tableau.

    :class:`orderconds.errors.ZeroWeight` is raised if a weight b_i is zero, or is an interval that contains
    zero.
    """
    tableau = method.runge_kutta()
    stages = Stages(scene, method, (Var("q", Kind.GROUP), Var("mu", Kind.DUAL)))
    A = [[stages.number(x) for x in row] for row in tableau.A]
    # The program divides by b_i to compute the momentum M_i of stage i, so no b_i may be zero.
    return stages, tableau, A, nonzero(method, [stages.number(x) for x in tableau.b])


def nonzero(method: Method, weights: Sequence[Number]) -> list[Number]:
    """Return the weights b_i, or raise ZeroWeight for the first weight that may be zero."""
    for i, weight in enumerate(weights, start=1):
        # If a weight is a ball (an interval) that contains zero, ``is_zero`` returns None.
        vanishes = weight.ring.is_zero(weight.element)
        if vanishes is not False:
            raise ZeroWeight(
                f"b_{i} = 0" if vanishes else f"b_{i} = {weight.text()}, which may be zero",
                where=method.label,
                expected="all b_i non-zero, because the formulas of the method divide by them",
                hint="" if vanishes else "write the weight with more digits",
            )
    return list(weights)


def brackets(method: Method) -> int:
    """Return the cut-off: the number of brackets after which the series of dexp^{-1} or dexp is truncated.

    MethodError is raised for a method without a cut-off.
    """
    if method.cutoff is None:
        # Without a cut-off of the series, the number of brackets is unknown.
        family, name = method.family_label, method.tableau.name
        raise MethodError(
            f"{family}:{name} needs a cut-off", expected=f"the number of brackets, as in {family}(2):{name}"
        )
    return method.cutoff


class ExpandedStep(ABC):
    """A step with a truncated series of dexp^{-1} or dexp, for a tableau with coefficients a_ij and b_j.

    The stages are Q_i = exp(X_i) q0 with X_i = h sum_j a_ij v_j. The result is q1 = exp(Y) q0 with
    Y = h sum_j b_j v_j. Subclasses define the equations for the v_j and for the momenta.
    """

    unknowns: list[Var]
    X: list[Var]
    g: list[Var]
    """The group elements exp(X_i)."""
    minus: Var
    """-Y, where Y = h sum_j b_j v_j."""
    nu: list[Var]
    """Ad*_{exp X_j} n_j: the force n_j of each stage, transported to q0."""
    mubar: Var
    """mu0 + h sum_j b_j nu_j, where mu0 is the momentum at the beginning of the step."""

    def __init__(self, problem: Problem, method: Method) -> None:
        # No term of the truncated series has more than ``self.r`` brackets.
        self.r = brackets(method)
        self.stages, self.tableau, self.A, self.b = begin(problem, method)
        self.build, self.s = self.stages.builder, self.tableau.s
        self.q, self.mu = self.stages.inputs

    @abstractmethod
    def images(self) -> list[Var]:
        """Append the operations of one fixed-point iteration, and return the new values of the unknowns."""

    @abstractmethod
    def starts(self) -> list[Var]:
        """Return the initial guesses of the unknowns."""

    def exponentiate(self, v: Sequence[Var]) -> None:
        """Append the exponents X_i = h sum_j a_ij v_j and the group elements exp(X_i) of all stages."""
        # The indices in variable names begin at 1, as in the literature.
        rows = enumerate(self.tableau.A, start=1)
        self.X = [self.stages.combination(f"X{i}", Kind.ALG, row, v) for i, row in rows]
        self.g = [self.build.exp(f"g{i}", x) for i, x in enumerate(self.X, start=1)]

    def end(self, velocities: Sequence[Var], forces: Mapping[int, Var] | Sequence[Var]) -> None:
        """Append the operations for Y = h sum_j b_j v_j and mubar = mu0 + h sum_j b_j nu_j.

        ``velocities`` contains the vectors v_j, and ``forces`` contains the forces n_j of the stages. The
        force nu_j is n_j after the transport to q0, and mu0 is the momentum at the start of the step. The
        attributes ``Y``, ``minus``, ``nu`` and ``mubar`` are set to variables for Y, -Y, all nu_j and mubar.
        """
        build = self.build
        self.Y = self.stages.combination("Y", Kind.ALG, self.tableau.b, velocities)
        # The operation dexp*_{-Y} needs the variable -Y.
        self.minus = build.lin("y", Kind.ALG, [(MINUS_ONE, self.Y)])
        # Only forces at the same point can be added, so all forces are transported to q0.
        self.nu = [build.adjoint(f"nu{j + 1}", self.g[j], forces[j]) for j in range(self.s)]
        terms = [(ONE, self.mu)] + [(self.stages.times_h(self.b[j]), self.nu[j]) for j in range(self.s)]
        self.mubar = build.lin("mubar", Kind.DUAL, terms)

    def time(self, i: int) -> tuple[Var, ...]:
        """Return the time of stage i as a tuple with one variable.

        If the scene does not depend on time, the tuple is empty.
        """
        return self.stages.at(self.tableau.c[i])

    def update(self) -> dict[str, Var]:
        """Return variables for the new state q1 = exp(Y) q0, mu1 = Ad*_{exp(-Y)} ``mubar``."""
        g = self.build.exp("g", self.Y)
        q = self.build.mul("q1", g, self.q)
        # The operator Ad*_{exp(-Y)} transports the momentum from q0 to q1 = exp(Y) q0.
        return {"q": q, "mu": self.build.adjoint("mu1", g, self.mubar, inverse=True)}

    def program(self) -> Program:
        """Return the verified program of the step."""
        return self.stages.program(self.unknowns, self.images, self.starts, self.update)
