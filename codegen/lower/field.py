"""The base class of lowerings for vector fields on homogeneous spaces."""

from __future__ import annotations

from codegen.flows.field_by_parts import with_field_by_parts
from codegen.lower.base import Lowering
from codegen.method import Method
from codegen.scene.problem import Problem


class FieldLowering(Lowering):
    """A family for equations y' = f(y).y, where f(y) is in the Lie algebra and acts on y.

    Hamilton's equations have this form on the group T*G.
    """

    def problem(self, scene: Problem, method: Method) -> Problem:
        """Return the scene as an equation y' = f(y).y, where f(y) is in the Lie algebra and acts on y."""
        # The derived scene is stored, because several methods may be used on one scene.
        if "field" not in scene.derived:
            # ``with_field_by_parts`` needs the separate variables q and mu, which ``as_field`` merges.
            scene.derived["field"] = with_field_by_parts(scene).as_field()
        return scene.derived["field"]
