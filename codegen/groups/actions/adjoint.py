"""The adjoint action of a group on its Lie algebra."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class AdjointAction(Action):
    """A group acting on its Lie algebra, g.y = Ad_g y. The velocity x.y is the bracket [x, y]."""

    name = "adjoint action"
    needs = Coadjoint

    def point_size(self, group: LieGroup) -> int:
        """Return the dimension of the algebra."""
        return group.dim

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return Ad_g y."""
        return group.require(Coadjoint).Ad(d, g, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the bracket [x, y]."""
        return group.ad(d, x, y)
