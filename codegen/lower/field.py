"""The base class of lowerings for vector fields on homogeneous spaces."""

from __future__ import annotations

from codegen.flows.field_by_parts import with_field_by_parts
from codegen.lower.base import Lowering
from codegen.method import Method
from codegen.scene.problem import Problem


class FieldLowering(Lowering):
    """A family for vector fields y' = f(y).y. A Hamiltonian scene becomes a field on the group T*G."""

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene as a vector field.

        The field of a Hamiltonian with parts is written as the sum of the fields of the parts if the sum
        needs fewer operations.
        """
        # The derived scene is stored, because several methods use it.
        if "field" not in scene.derived:
            # The formulas of parts contain q and mu separately. They must be used before ``as_field`` joins q
            # and mu to one point.
            scene.derived["field"] = with_field_by_parts(scene).as_field()
        return scene.derived["field"]
