"""The base class of lowerings for vector fields on homogeneous spaces."""

from __future__ import annotations

from codegen.flows.field_by_parts import with_field_by_parts
from codegen.lower.base import Lowering
from codegen.method import Method
from codegen.scene.problem import Problem


class FieldLowering(Lowering):
    """A family for equations y' = f(y).y, where f(y) is in the Lie algebra, and the dot is its action on y.

    A Hamiltonian scene is read as such an equation on the group T*G.
    """

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene as an equation y' = f(y).y, where f(y) is in the Lie algebra and acts on y.

        If a Hamiltonian is a sum of parts, its field is the sum of the fields of the parts. The field is
        written as this sum if the sum needs fewer operations.
        """
        # The derived scene is stored, because several methods may be used on the same scene.
        if "field" not in scene.derived:
            # ``with_field_by_parts`` reads the parts of a Hamiltonian, which are formulas in q and mu. It is
            # called before ``as_field``, because ``as_field`` joins q and mu to one point y.
            scene.derived["field"] = with_field_by_parts(scene).as_field()
        return scene.derived["field"]
