"""The action of one group on a product of manifolds."""

from __future__ import annotations

from itertools import accumulate

from codegen.errors import SceneError
from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class DiagonalAction(Action):
    """The diagonal action of a group on a product of manifolds, g.(y1, y2, ...) = (g.y1, g.y2, ...).

    A point of the product contains the coordinates of y1, then the coordinates of y2, and so on. The first of
    the ``actions`` acts on y1, the second acts on y2, and so on.
    """

    def __init__(self, *actions: Action) -> None:
        if not actions:
            raise SceneError("no actions were given to DiagonalAction", expected="at least one action")
        self.actions = actions
        self.name = " and ".join(action.name for action in actions)

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if one of the actions cannot be used with the group.

        The error is also raised if the method ``point_size`` of an action returns None.
        """
        for action in self.actions:
            action.check(group, where)
        self._sizes(group, where)

    def _sizes(self, group: LieGroup, where: str = "") -> list[int]:
        sizes = []
        for action in self.actions:
            size = action.point_size(group)
            if size is None:
                raise SceneError(
                    f"the action {action.name} does not define the number of coordinates of a point",
                    where=where,
                    expected="actions that define point_size",
                    hint=f"define point_size(self, group) in {type(action).__name__}",
                )
            sizes.append(size)
        return sizes

    def _parts(self, group: LieGroup, y: Vector[S]) -> list[tuple[Action, Vector[S]]]:
        """Return the pairs (first action, y1), (second action, y2), ... for y = (y1, y2, ...)."""
        sizes = self._sizes(group)
        ends = accumulate(sizes)
        rows = zip(self.actions, ends, sizes, strict=True)
        return [(action, tuple(y[end - n : end])) for action, end, n in rows]

    def point_size(self, group: LieGroup) -> int:
        """Return the number of coordinates of a point (y1, y2, ...)."""
        return sum(self._sizes(group))

    def laws(self, d: Domain, group: LieGroup, y: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of the manifolds of all components y1, y2, ... of ``y``, in this order."""
        return tuple(law for action, own in self._parts(group, y) for law in action.laws(d, group, own))

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g.y = (g.y1, g.y2, ...) for y = (y1, y2, ...)."""
        return tuple(a for action, own in self._parts(group, y) for a in action.act(d, group, g, own))

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x.y = (x.y1, x.y2, ...) for y = (y1, y2, ...)."""
        return tuple(a for action, own in self._parts(group, y) for a in action.velocity(d, group, x, own))

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """Project y = (y1, y2, ...) onto the orbits of the points in start = (s1, s2, ...).

        y1 is projected onto the orbit of s1, y2 onto the orbit of s2, and so on.
        """
        rows = zip(self._parts(group, y), self._parts(group, start), strict=True)
        return tuple(a for (action, own), (_, first) in rows for a in action.to_orbit(d, group, own, first))
