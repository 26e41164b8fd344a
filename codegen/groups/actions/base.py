"""The base class of left actions of a group on a manifold."""

from __future__ import annotations

from abc import ABC, abstractmethod

from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Action(ABC):
    """A left action: e.y = y and (g k).y = g.(k.y).

    A point y of the manifold is a flat tuple of scalars; its length may depend on the group. ``name`` is
    printed in messages and headers. ``needs`` is the capability that the formulas require of the group.
    :func:`codegen.groups.register` adds the class to the list of actions.
    """

    name: str
    needs: type[LieGroup] = LieGroup

    @abstractmethod
    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g.y."""

    @abstractmethod
    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x.y for x in the algebra, a tuple as long as y: the derivative of exp(eps x).y at eps =
        0."""

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """Return a point closer to the orbit of ``start`` than y: if the distance of y is eps, the distance
        of the result is O(eps^2).

        By default y is returned, which is correct if the orbit is open.
        """
        return y

    def actexp(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x).y; a subclass may have a formula that does not form exp(x)."""
        return self.act(d, group, group.exp(d, x), y)
