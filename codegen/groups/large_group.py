"""Groups of large n x n matrices. Elements of the group are never computed."""

from __future__ import annotations

from typing import NoReturn

from codegen.errors import SceneError
from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class LargeGroup(LieGroup):
    """A group of large n x n matrices.

    The operations raise :class:`codegen.errors.SceneError`, because the group is too large for formulas.
    ``families`` is a part of the error message: the names of the families of methods that work for the group.
    """

    def __init__(self, name: str, n: int, dim: int, families: str) -> None:
        self.n = n
        self.name = name
        self.dim = dim
        self.size = n * n
        self.families = families

    def _refuse(self) -> NoReturn:
        raise SceneError(
            f"this method needs a formula for each coordinate, but {self.name} has too many coordinates",
            expected=f"a method of the family {self.families}",
            hint="for other methods, use a scene with matrices of at most eight rows",
        )

    def identity(self, d: Domain) -> Vector[S]:
        """Raise SceneError, because the group is too large."""
        self._refuse()

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Raise SceneError, because the group is too large."""
        self._refuse()

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Raise SceneError, because the group is too large."""
        self._refuse()

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Raise SceneError, because the group is too large."""
        self._refuse()

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Raise SceneError, because the group is too large."""
        self._refuse()


class LargeRotations(LargeGroup):
    """SO(n) for large n. Emitted steps store an element of the algebra as a product B S B^T. The matrix B has
    few columns, and the skew matrix S is small (:mod:`codegen.ir.array_step`).
    """

    def __init__(self, n: int) -> None:
        super().__init__(f"SO({n})", n, n * (n - 1) // 2, "rkmk, cf or cg")


class LargeLinearGroup(LargeGroup):
    """GL(n) for large n. Emitted steps compute the vector exp(A) y, but not the matrix exp(A). The steps
    multiply vectors by matrices (:mod:`codegen.ir.linear_array_step`).
    """

    def __init__(self, n: int) -> None:
        super().__init__(f"GL({n})", n, n * n, "magnus, cf_magnus, fer, rkmk, cf or cg")
