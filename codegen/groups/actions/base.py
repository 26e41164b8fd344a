"""The base class of left actions of a group on a manifold.

To define an action, write a subclass of :class:`Action` with the members ``name``, ``act`` and ``velocity``.
The methods ``point_size``, ``laws`` and ``to_orbit`` are optional.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from codegen.errors import SceneError
from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Action(ABC):
    """A left action of a group on a manifold: e.y = y for the neutral element e, and (g k).y = g.(k.y).

    A point y of the manifold is the tuple of its coordinates.

    - ``name`` is printed in messages and in the headers of emitted code.
    - ``needs`` is the capability that the group must have (:mod:`codegen.groups.capabilities`).
    - ``on_itself`` is true if the manifold is the group itself, so that each point y is a group element.
    """

    name: str
    needs: type[LieGroup] = LieGroup
    on_itself: ClassVar[bool] = False

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if this action cannot be used with the group."""
        self.require(group, self.needs, where)

    def require(self, group: LieGroup, capability: type[LieGroup], where: str) -> None:
        """Raise :class:`codegen.errors.SceneError` if the group lacks ``capability``."""
        if group.offers(capability) is None:
            raise SceneError(
                f"{group.name} has no {capability.provides}, which the action {self.name} needs",
                where=where,
                expected=f"a group with the capability {capability.__name__}, or another action of "
                f"{group.name}",
                hint="use LeftMultiplication() if the points are elements of the group",
            )

    def point_size(self, group: LieGroup) -> int | None:
        """Return the number of coordinates of a point, or None if the number is not known.

        By default the number is not known.
        """
        return None

    def laws(self, d: Domain, group: LieGroup, y: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of the manifold as pairs (name, residual).

        If y is a point of the manifold, all residuals are zero.
        """
        return ()

    @abstractmethod
    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g.y."""

    @abstractmethod
    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x.y, the derivative of exp(eps x).y at eps = 0. Here x is an element of the algebra."""

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """Return an approximate projection of y onto the orbit of ``start``, or y if there is no projection.

        This base class has no projection. The projection of a subclass maps a point at the distance eps from
        the orbit to a point at the distance O(eps^2) from the orbit.
        """
        return y

    def actexp(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x).y. A subclass may override this method with a cheaper formula."""
        return self.act(d, group, group.exp(d, x), y)
