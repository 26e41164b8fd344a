"""Lowerings that take any vector field on a homogeneous space."""

from __future__ import annotations

from codegen.flows.field_by_parts import with_field_by_parts
from codegen.lower.base import Lowering
from codegen.method import Method
from codegen.scene.problem import Problem


class FieldLowering(Lowering):
    """A family for vector fields y' = f(y).y; it sees a Hamiltonian scene as a field on the group T*G."""

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene as a field; a Hamiltonian gives the sum of the fields of its parts if that is
        shorter."""
        return with_field_by_parts(scene).as_field()
