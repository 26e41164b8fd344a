"""Rigid motions acting on points."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import PointMotions
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Motion(Action):
    """Rigid motions acting on points z by g.z = R z + a, with a rotation R and a translation a.

    SE(2) acts on the plane, and SE(3) acts on three-dimensional space. Other semidirect products act by
    g.z = R z + a with a linear map R.
    """

    name = "rigid motion"
    needs = PointMotions

    def point_size(self, group: LieGroup) -> int:
        """Return the number of coordinates of a point."""
        return group.require(PointMotions).point_size

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return R y + a. Here R is the linear part of g, and a is the translation of g."""
        return group.require(PointMotions).move(d, g, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x.y, the derivative of exp(eps x).y at eps = 0."""
        return group.require(PointMotions).point_velocity(d, x, y)
