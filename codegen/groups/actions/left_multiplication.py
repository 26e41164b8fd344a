"""Left multiplication: the action of a group on itself by y -> g y."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Projection
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class LeftMultiplication(Action):
    """A group acting on itself by g.y = g y. For the group R^n, this is the translation g.y = g + y."""

    name = "left multiplication"
    on_itself = True

    def point_size(self, group: LieGroup) -> int:
        """Return the number of coordinates of an element."""
        return group.size

    def laws(self, d: Domain, group: LieGroup, y: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return pairs (name, residual at y) for the defining equations of the group."""
        return group.laws(d, y)

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g y."""
        return group.mul(d, g, y)

    def actexp(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y."""
        return group.expmul(d, x, y)

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """Return the projection of y onto the group. If the group has no projection, return y."""
        projection = group.offers(Projection)
        return y if projection is None else projection.project(d, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x.y, the derivative of exp(eps x).y at eps = 0."""
        return group.velocity(d, x, y)
