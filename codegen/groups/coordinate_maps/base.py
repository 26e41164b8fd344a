"""The base class of coordinate maps.

A coordinate map describes elements of the group near the neutral element by elements of the Lie algebra.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class CoordinateMap(ABC):
    """A map tau from the algebra to the group with tau(0) = e, whose derivative at zero is the identity map.

    A Runge-Kutta-Munthe-Kaas method solves y' = f(y).y with y(0) = y0. It writes y = tau(x).y0 and applies a
    Runge-Kutta method to x' = dtau^{-1}_x f(tau(x).y0). The inverse differential is not truncated, so both
    methods have the same order.

    - ``name`` is the value of the option ``coordinates`` of a scene that uses this map.
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
        """Return dtau^{-1}_x y.

        If x(t) satisfies x' = dtau^{-1}_x y, then g(t) = tau(x(t)) satisfies g' = y.g, where y.g is
        defined by :meth:`LieGroup.velocity`.
        """
