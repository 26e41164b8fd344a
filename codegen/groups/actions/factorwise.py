"""The action of a direct product of groups on a product of manifolds, factor by factor."""

from __future__ import annotations

from collections.abc import Callable
from itertools import accumulate

from codegen.errors import SceneError
from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import DirectProduct
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain

Part = tuple[Action, LieGroup]


class FactorwiseAction(Action):
    """A direct product acting on a product of manifolds, (g1, g2, ...).(y1, y2, ...) = (g1.y1, g2.y2, ...).

    ``actions`` contains one action for each factor, in the order of the factors. A point of the product
    contains the coordinates of y1, then the coordinates of y2, and so on.
    """

    needs = DirectProduct

    def __init__(self, *actions: Action) -> None:
        if not actions:
            raise SceneError(
                "no actions were given to FactorwiseAction", expected="one action for each factor"
            )
        self.actions = actions
        self.name = " x ".join(action.name for action in actions)

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if the actions cannot be used with the group.

        The group must be a direct product with one factor for each action. The method ``point_size`` of each
        action must return a number.
        """
        self.require(group, DirectProduct, where)
        factors = group.require(DirectProduct).factors
        if len(factors) != len(self.actions):
            raise SceneError(
                f"the number of actions is {len(self.actions)}, but {group.name} has {len(factors)} factors",
                where=where,
                expected="one action for each factor",
            )
        for action, factor in zip(self.actions, factors, strict=True):
            action.check(factor, where)
        self._sizes(group, where)

    def _pairs(self, group: LieGroup) -> list[Part]:
        return list(zip(self.actions, group.require(DirectProduct).factors, strict=True))

    def _sizes(self, group: LieGroup, where: str = "") -> list[int]:
        sizes = []
        for action, factor in self._pairs(group):
            size = action.point_size(factor)
            if size is None:
                raise SceneError(
                    f"the action {action.name} of the factor {factor.name} does not define the number of "
                    "coordinates of a point",
                    where=where,
                    expected="actions that define point_size",
                    hint=f"define point_size(self, group) in {type(action).__name__}",
                )
            sizes.append(size)
        return sizes

    def _split(self, group: LieGroup, y: Vector[S]) -> list[Vector[S]]:
        """Split the tuple y into the coordinates of y1, the coordinates of y2, and so on."""
        sizes = self._sizes(group)
        return [tuple(y[end - n : end]) for end, n in zip(accumulate(sizes), sizes, strict=True)]

    def _each(
        self, group: LieGroup, operation: Callable[..., Vector[S]], x: Vector[S], y: Vector[S]
    ) -> Vector[S]:
        """Apply an operation to each factor, with x = (x1, x2, ...) and y = (y1, y2, ...).

        The calls are operation(action1, factor1, x1, y1) and so on.
        """
        parts = group.require(DirectProduct).parts(x)
        rows = zip(self._pairs(group), parts, self._split(group, y), strict=True)
        return tuple(
            a for (action, factor), own, point in rows for a in operation(action, factor, own, point)
        )

    def point_size(self, group: LieGroup) -> int:
        """Return the number of coordinates of a point (y1, y2, ...)."""
        return sum(self._sizes(group))

    def laws(self, d: Domain, group: LieGroup, y: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of the manifold of y1, then the equations of the manifold of y2, and so on."""
        rows = zip(self._pairs(group), self._split(group, y), strict=True)
        return tuple(law for (action, factor), own in rows for law in action.laws(d, factor, own))

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return g.y = (g1.y1, g2.y2, ...) for g = (g1, g2, ...) and y = (y1, y2, ...)."""
        return self._each(group, lambda a, f, own, point: a.act(d, f, own, point), g, y)

    def actexp(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return (exp(x1).y1, exp(x2).y2, ...) for x = (x1, x2, ...) and y = (y1, y2, ...)."""
        return self._each(group, lambda a, f, own, point: a.actexp(d, f, own, point), x, y)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x.y = (x1.y1, x2.y2, ...) for x = (x1, x2, ...) and y = (y1, y2, ...)."""
        return self._each(group, lambda a, f, own, point: a.velocity(d, f, own, point), x, y)

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """Project y = (y1, y2, ...) onto the orbits of the points in start = (s1, s2, ...).

        y1 is projected onto the orbit of s1, y2 onto the orbit of s2, and so on.
        """
        rows = zip(self._pairs(group), self._split(group, y), self._split(group, start), strict=True)
        return tuple(
            a for (action, factor), own, first in rows for a in action.to_orbit(d, factor, own, first)
        )
