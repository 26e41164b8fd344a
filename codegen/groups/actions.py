"""Left actions of a group on a manifold; points are flat tuples of scalars."""

from __future__ import annotations

from typing import Any

from codegen.groups.base import Scalars, matvec
from codegen.ir.domain import Domain


class LeftMultiplication:
    """A group acting on itself, g.y = g y; on R^n that is translation."""

    name = "left multiplication"

    def act(self, d: Domain, group: Any, g: Scalars, y: Scalars) -> Scalars:
        """Return g y."""
        return tuple(group.mul(d, g, y))

    def actexp(self, d: Domain, group: Any, x: Scalars, y: Scalars) -> Scalars:
        """Return exp(x) y."""
        return tuple(group.left(d, x, y))

    def velocity(self, d: Domain, group: Any, x: Scalars, y: Scalars) -> Scalars:
        """Return x.y, the derivative of exp(eps x).y at eps = 0."""
        return tuple(group.velocity(d, x, y))


class Linear:
    """Matrices acting on column vectors: g.y = g y."""

    name = "linear maps"

    def act(self, d: Domain, group: Any, g: Scalars, y: Scalars) -> Scalars:
        """Return g y."""
        return matvec(g, y)

    def actexp(self, d: Domain, group: Any, x: Scalars, y: Scalars) -> Scalars:
        """Return exp(x) y, without the matrix where the group offers that."""
        if hasattr(group, "rotate"):
            return tuple(group.rotate(d, x, y))
        return matvec(group.exp(d, x), y)

    def velocity(self, d: Domain, group: Any, x: Scalars, y: Scalars) -> Scalars:
        """Return hat(x) y."""
        return matvec(group.hat(d, x), y)


class Rotation(Linear):
    """Rotations acting on column vectors: SO(3) on spheres about the origin of R^3."""

    name = "rotation"


class Motion:
    """Rigid motions of a space on its points, g.z = R z + a; SE(2) on the plane."""

    name = "rigid motion"

    def act(self, d: Domain, group: Any, g: Scalars, y: Scalars) -> Scalars:
        """Return R y + a."""
        return tuple(group.move(d, g, y))

    def actexp(self, d: Domain, group: Any, x: Scalars, y: Scalars) -> Scalars:
        """Return exp(x).y."""
        return tuple(group.move(d, group.exp(d, x), y))

    def velocity(self, d: Domain, group: Any, x: Scalars, y: Scalars) -> Scalars:
        """Return the velocity of the point y under x."""
        return tuple(group.field(d, x, y))
