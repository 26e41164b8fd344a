"""The Cayley map as a coordinate map."""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import CayleyMap
from codegen.groups.coordinate_maps.base import CoordinateMap
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Cayley(CoordinateMap):
    """The Cayley map cay(x) = (1 - x/2)^-1 (1 + x/2), with dcay^{-1}_x y = (1 - x/2) y (1 + x/2).

    The element x is a matrix or a pure quaternion, and 1 is the identity. A group has a Cayley map if its
    algebra contains x^3 for all elements x. If 1 - x/2 is singular, the step fails with the status TOO_FAR.
    """

    name = "cayley"
    text = "Cayley map, cay(x) = (1 - x/2)^-1 (1 + x/2), with its exact inverse differential"

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if the group has no Cayley map."""
        if group.offers(CayleyMap) is None:
            raise SceneError(
                f"{group.name} has no Cayley map",
                where=where,
                expected="a group whose Lie algebra contains x^3 for every x in the algebra, such as SO(3), "
                "S^3, SL(2) or SE(3)",
                hint='write coordinates="exp", or define the methods cay and dcayinv in a group class that '
                "inherits CayleyMap",
            )

    def element(self, d: Domain, group: LieGroup, x: Vector[S]) -> Vector[S]:
        """Return cay(x)."""
        return group.require(CayleyMap).cay(d, x)

    def inverse_differential(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y."""
        return group.require(CayleyMap).dcayinv(d, x, y)
