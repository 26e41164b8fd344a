"""Right multiplication: a group acting on itself by y -> y g^-1."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import Coadjoint, Inverse, LeftTranslation, Projection
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class RightMultiplication(Action):
    """A group acting on itself by g.y = y g^-1. The action is a left action: (g k).y = g.(k.y).

    The velocity is x.y = -y x. Therefore the equation y' = y F(y) has the form y' = f(y).y with f = -F.
    """

    name = "right multiplication"
    needs = Inverse
    on_itself = True

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if the group cannot compute g^-1 and Ad_g."""
        self.require(group, Inverse, where)
        self.require(group, Coadjoint, where)

    def point_size(self, group: LieGroup) -> int:
        """Return the number of coordinates of an element."""
        return group.size

    def laws(self, d: Domain, group: LieGroup, y: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return a pair (name, residual) for each equation that the elements y of the group satisfy."""
        return group.laws(d, y)

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return y g^-1."""
        return group.mul(d, y, group.require(Inverse).inverse(d, g))

    def actexp(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return y exp(-x)."""
        return group.mul(d, y, group.exp(d, tuple(-a for a in x)))

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """Return the projection of y onto the group. If the group has no projection, return y."""
        projection = group.offers(Projection)
        return y if projection is None else projection.project(d, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return -y x, the derivative of y exp(-eps x) at eps = 0."""
        translation = group.offers(LeftTranslation)
        if translation is not None:
            return tuple(-a for a in translation.left_velocity(d, y, x))
        # Because Ad_y x = y x y^-1, the product y x is equal to (Ad_y x) y.
        moved = group.require(Coadjoint).Ad(d, y, x)
        return tuple(-a for a in group.velocity(d, moved, y))
