"""The action of orthogonal matrices on the Stiefel manifold, the set of matrices with orthonormal columns."""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.actions.columns import Columns
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements
from codegen.groups.linear_algebra import S, Vector, dot, units
from codegen.ir.domain import Domain, FloatDomain


class Stiefel(Columns):
    """Orthogonal matrices acting on n x k matrices with orthonormal columns, g.Y = g Y.

    A point contains the entries of the matrix Y row by row. The number of columns is k = ``columns``.
    """

    name = "rotation of orthonormal columns"

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if the group does not admit this action.

        The matrices of the algebra must be skew. A point must not have more columns than rows.
        """
        super().check(group, where)
        matrices, d = group.require(MatrixElements), FloatDomain(0.0)
        n = matrices.order
        basis: tuple[Vector[float], ...] = units(d, group.dim)
        for x in basis:
            a = matrices.hat(d, x)
            if any(a[n * i + j] != -a[n * j + i] for i in range(n) for j in range(i + 1)):
                raise SceneError(
                    f"{group.name} does not preserve orthonormal columns, because the matrices of its "
                    "algebra are not skew",
                    where=where,
                    expected="a group of orthogonal matrices",
                    hint=f"use Columns({self.columns}), which accepts all groups of matrices",
                )
        if self.columns > n:
            raise SceneError(
                f"{self.columns} columns with {n} rows cannot be orthonormal",
                where=where,
                expected=f"at most {n} columns",
            )

    def _gram(self, y: Vector[S]) -> list[list[S]]:
        """Return Y^T Y, where y contains the matrix Y row by row."""
        columns = [y[j :: self.columns] for j in range(self.columns)]
        return [[dot(a, b) for b in columns] for a in columns]

    def laws(self, d: Domain, group: LieGroup, y: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations Y^T Y = I as pairs (name, residual). I is the unit matrix.

        The pairs for the entries above the diagonal are omitted.
        """
        gram, one = self._gram(y), d.rational(1)
        return tuple(
            (f"(Y^T Y)[{i}, {j}] = {int(i == j)}", gram[i][j] - one if i == j else gram[i][j])
            for i in range(self.columns)
            for j in range(i + 1)
        )

    def to_orbit(self, d: Domain, group: LieGroup, y: Vector[S], start: Vector[S]) -> Vector[S]:
        """Return an approximate projection of the matrix Y onto the matrices with orthonormal columns.

        The result is Y (3 I - Y^T Y)/2 with the unit matrix I. The argument y contains the entries of Y row
        by row.
        """
        gram, half, k = self._gram(y), d.rational(1, 2), self.columns
        unit: tuple[Vector[S], ...] = units(d, k)
        # In the sum Y + Y E/2 with E = I - Y^T Y, the rounding errors of the small term Y E/2 are negligible.
        defect = [[half * (unit[i][j] - gram[i][j]) for j in range(k)] for i in range(k)]
        rows = [y[i : i + k] for i in range(0, len(y), k)]
        return tuple(
            row[j] + dot(row, tuple(defect[i][j] for i in range(k))) for row in rows for j in range(k)
        )
