"""The base class of lowerings for linear problems in time: y' = A(t).y, where A does not depend on y."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace

from codegen.errors import MethodError
from codegen.ir.program import Program
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
from orderconds.families import family_class
from orderconds.tableau.products import Magnus


class LinearLowering(FieldLowering):
    """A family of methods y1 = tau(X_m).(... tau(X_1).y0) for y' = A(t).y.

    The exponents X are Lie elements in the values h A(t + c_i h), and tau is a map from the algebra to the
    group. No value depends on y, so a step has no stages.
    """

    def objection(self, scene: Problem) -> Objection | None:
        """Return the reason why the family does not accept a scene: a field that depends on the state."""
        if scene.linear or scene.carries_momentum:
            return None
        return Objection(
            ", whose field depends on the state", "a scene y' = A(t).y, whose field f contains t only"
        )

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene as a vector field that contains the time alone."""
        if not scene.carries_momentum:
            return super().problem(scene, method)
        if "linear" not in scene.derived:
            scene.derived["linear"] = without_momentum_rate(scene)
        return scene.derived["linear"]

    @abstractmethod
    def move(self, stages: Stages, x: Var, y: Var) -> Var:
        """Append and return tau(x).y."""

    def lower(self, problem: Problem, method: Method) -> Program:
        """Return the program."""
        family = family_class(self.family)
        tableau = method.tableau.read_as(family.formats)
        if not isinstance(tableau, Magnus):
            raise MethodError(
                f"{self.family} with the {method.tableau.family} tableau {method.name}",
                expected="a tableau of family magnus",
            )
        family().require(tableau, method.ring)
        y = Var("y", Kind.POINT)
        stages = Stages(problem, method, (y,))
        nodes = [stages.f(f"k{i + 1}", y, c) for i, c in enumerate(tableau.c)]
        values = LieElements(stages.builder, method, nodes, dict(tableau.elements))
        point = y
        # The first exponent acts first, so it is the rightmost factor of the product.
        for number, combination in enumerate(tableau.exponents, start=1):
            point = self.move(stages, values.exponent(f"x{number}", combination), point)
        inputs = stages.inputs + (() if stages.time is None else (stages.time,))
        body = stages.builder.take()
        step = verify(Program(method.label, inputs, body, (("y", point),)))
        if not problem.carries_momentum or stages.time is None:
            return step
        moved = stages.builder.add(TimeMomentum(step), "y1", y, point, stages.time)
        return verify(replace(step, body=(*body, *stages.builder.take()), outputs=(("y", moved),)))

    def symplectic(self, scene: Problem, method: Method) -> bool:
        """Return True on an abelian group, where a step is a translation that does not depend on the
        state."""
        return bool(scene.group.abelian)
