"""The base class of lowerings for linear differential equations y' = A(t).y.

The matrix A may depend on t, and on coordinates of y that are constant in time
(:mod:`codegen.scene.static_coordinates`). On a lattice, A may also depend on constant coordinates of the
neighbours.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from typing import TYPE_CHECKING

from codegen.errors import MethodError
from codegen.ir.program import Assign, Program
from codegen.ir.stated_step import StatedStep
from codegen.ir.time_momentum import TimeMomentum
from codegen.ir.values import Kind, Var
from codegen.ir.verify import verify
from codegen.lower.base import Objection
from codegen.lower.field import FieldLowering
from codegen.lower.lie_elements import LieElements
from codegen.lower.stages import Stages
from codegen.method import Method
from codegen.scene.linear_extension import without_momentum_rate
from codegen.scene.problem import Problem
from codegen.scene.static_coordinates import reads_only_static
from orderconds.families import family_class
from orderconds.tableau.products import Magnus

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder


class LinearLowering(FieldLowering):
    """A family of methods y1 = tau(X_m).(... tau(X_1).y0) for y' = A(t).y.

    Here tau is a map from the Lie algebra to the group, for example exp. The exponents X_j are combinations
    of the values h A(t + c_i h) and of brackets of these values.
    """

    def objection(self, scene: Problem) -> Objection | None:
        """Return an objection if the matrix A of y' = A.y depends on coordinates that change in time.

        Otherwise return None.
        """
        if scene.linear or scene.carries_momentum or reads_only_static(scene):
            return None
        if scene.sites is not None:
            return Objection(
                ": the field of the lattice depends on coordinates that change in time",
                "a field that depends only on the time and on coordinates that are constant in time",
            )
        return Objection(
            ", whose field depends on the state", "an equation y' = A(t).y, where A depends only on the time"
        )

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene as an equation y' = A(t).y, where A does not depend on y."""
        if not scene.carries_momentum:
            return super().problem(scene, method)
        # The derived scene is stored, because deriving it takes time.
        if "linear" not in scene.derived:
            # The coordinate u of the state is the momentum conjugate to time. In the equation u' = -dH/dt,
            # the right-hand side depends on the state, but the method requires a field A(t) without the
            # state. For this reason, the stored scene has the equation u' = 0 in place of u' = -dH/dt. The
            # correct update of u is added to the program of a step by ``_with_momentum``.
            scene.derived["linear"] = without_momentum_rate(scene)
        return scene.derived["linear"]

    @abstractmethod
    def move(self, stages: Stages, x: Var, y: Var) -> Var:
        """Append the operations for tau(x).y to the program of ``stages``, and return the result.

        Here tau is a map from the Lie algebra to the group, for example exp.
        """

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program of a step."""
        # ``method.step`` is the name of a step defined by the scene. Such a step has no tableau.
        if method.step:
            return self._stated(problem, method)
        family = family_class(self.family)
        tableau = method.tableau.read_as(family.formats)
        if not isinstance(tableau, Magnus):
            raise MethodError(
                f"the family {self.family} cannot use {method.name}, a tableau of format "
                f"{method.tableau.family}",
                expected="a tableau of format magnus",
            )
        # The family can reject the tableau. For example, ``cf_magnus`` rejects tableaux with brackets.
        family().require(tableau, method.ring)
        y = Var("y", Kind.POINT)
        stages = Stages(problem, method, (y,))
        # The differential equation is y' = A(t).y. The method evaluates A at the times t + c_i h. The entries
        # of A may depend on coordinates of y that are constant in time, but not on coordinates of y that vary
        # in time. For this reason, all evaluations of A use the initial value y.
        nodes = [stages.f(f"k{i + 1}", y, c) for i, c in enumerate(tableau.c)]
        values = LieElements(stages.builder, method, nodes, dict(tableau.elements))
        point = y
        # The first exponent acts first, so its exponential is the rightmost factor of the product.
        for number, combination in enumerate(tableau.exponents, start=1):
            point = self.move(stages, values.exponent(f"x{number}", combination), point)
        # There are no stage equations, so ``Stages.program`` is not called.
        inputs = stages.inputs + (() if stages.time is None else (stages.time,))
        step = verify(Program(method.label, inputs, stages.builder.take(), (("y", point),)))
        return _with_momentum(problem, step)

    def _stated(self, problem: Problem, method: Method) -> Program:
        """Return the program of the step with the name ``method.step``.

        The scene ``problem`` can define several steps, and each step has a name.
        """
        # The formula for the momentum u is valid only if the matrix of the step is symplectic.
        if problem.carries_momentum and not problem.steps[method.step].canonical:
            raise MethodError(
                f"{method.label} cannot compute the momentum u conjugate to the time, because the matrix of "
                "the step is not known to be symplectic",
                where=problem.name,
                expected="a matrix in the scene's group, for example exp(X) with X in the Lie algebra",
            )
        # The scene gives a formula for the matrix of the step.
        y, t, end = Var("y", Kind.POINT), Var("t", Kind.REAL), Var("y1", Kind.POINT)
        body = (Assign((end,), StatedStep(method.step), (y, t)),)
        return _with_momentum(problem, verify(Program(method.label, (y, t), body, (("y", end),))))

    def order(self, method: Method, scene: Problem | None = None) -> FamilyOrder:
        """Return the order of the method.

        If ``method.step`` names a step of the scene, the result contains the order that the scene states for
        this step.
        """
        if not method.step:
            return super().order(method, scene)
        from orderconds.checking import FamilyOrder

        if scene is None:
            raise MethodError(
                f"the order of {method.label} is unknown without a scene",
                expected="the scene that defines the step",
            )
        # The scene states the order, so no order conditions are checked.
        return FamilyOrder(method.label, scene.steps[method.step].order, "stated", True, (), None)

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True if the group is abelian.

        If tau is exp, a step on an abelian group is the exact flow of a Hamiltonian, so the step is
        symplectic. A family with another map tau overrides this method.
        """
        return bool(scene.group.abelian)


def _with_momentum(problem: Problem, step: Program) -> Program:
    """If the state contains the momentum u conjugate to time, append an update of u to ``step``. Return the
    resulting program.
    """
    time = next((v for v in step.inputs if v.kind is Kind.REAL), None)
    # If the step does not depend on time, the momentum conjugate to time does not change.
    if not problem.carries_momentum or time is None:
        return step
    # The update of the momentum follows all other operations of the step.
    ((_, point),) = step.outputs
    # The points ``point`` and ``moved`` differ only in u: ``point`` contains the old value of u, and
    # ``moved`` contains the new value.
    moved = Var("y_with_u", Kind.POINT)
    # ``TimeMomentum`` differentiates the whole step with respect to t, so its argument is ``step``.
    last = Assign((moved,), TimeMomentum(step), (step.inputs[0], point, time))
    return verify(replace(step, body=(*step.body, last), outputs=(("y", moved),)))
