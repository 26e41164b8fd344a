"""SO(n) for large n, whose elements and algebra elements are never written as n x n matrices."""

from __future__ import annotations

from typing import NoReturn

from codegen.errors import SceneError
from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class LargeRotations(LieGroup):
    """SO(n) as the name of the group in a scene with large matrices.

    Emitted steps store elements of the algebra as products of small matrices (:mod:`codegen.ir.array_step`).
    The operations of this class would need arrays with n^2 entries, so each of them raises
    :class:`codegen.errors.SceneError`.
    """

    def __init__(self, n: int) -> None:
        self.n = n
        self.name = f"SO({n})"
        self.dim = n * (n - 1) // 2
        self.size = n * n

    def _refuse(self) -> NoReturn:
        raise SceneError(
            f"an operation of {self.name} in coordinates",
            expected=f"emitted code of rkmk, cf or cg, which needs no {self.n} x {self.n} matrix",
            hint="use a scene with at most eight rows for measurements that need formulas in coordinates",
        )

    def identity(self, d: Domain) -> Vector[S]:
        """Raise SceneError."""
        self._refuse()

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Raise SceneError."""
        self._refuse()

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Raise SceneError."""
        self._refuse()

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Raise SceneError."""
        self._refuse()

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Raise SceneError."""
        self._refuse()
