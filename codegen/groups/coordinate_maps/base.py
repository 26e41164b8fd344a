"""The base class of coordinate maps.

A coordinate map is a map from the Lie algebra to the group, for example the exponential map.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class CoordinateMap(ABC):
    """A map tau from the algebra to the group. The value tau(0) is the neutral element, and the derivative of
    tau at zero is the identity map.

    A Runge-Kutta-Munthe-Kaas method solves y' = f(y).y with y(0) = y0, where f(y) is in the algebra. With
    y = tau(x).y0, the equation becomes x' = dtau^{-1}_x f(tau(x).y0).

    - ``name`` selects this map in the option ``coordinates`` of a scene.
    - ``text`` describes the map in the headers of emitted code.
    """

    name: str
    text: str

    @abstractmethod
    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if the group does not have this map."""

    @abstractmethod
    def element(self, d: Domain, group: LieGroup, x: Vector[S]) -> Vector[S]:
        """Return tau(x), the element of the group with the coordinates x."""

    @abstractmethod
    def inverse_differential(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dtau^{-1}_x y, where dtau_x is the right-trivialised differential of tau at x.

        If x' = dtau^{-1}_x y, the curve g(t) = tau(x(t)) satisfies g' = y.g.
        """
