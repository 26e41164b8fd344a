"""The action of affine maps z -> A z + b on a vector space."""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.actions.base import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements
from codegen.groups.linear_algebra import S, Vector, dot, units
from codegen.ir.domain import Domain, FloatDomain


class AffineAction(Action):
    """Affine maps acting on points, g.z = A z + b, for matrices g = [[A, b], [0, 1]].

    An element x of the algebra has a matrix [[L, c], [0, 0]], and the velocity of the point z is L z + c. For
    the equation z' = L z + N(z), use c = N(z). The Lie-Euler method is then the exponential Euler method.
    """

    name = "affine maps"
    needs = MatrixElements

    def check(self, group: LieGroup, where: str = "") -> None:
        """Raise :class:`codegen.errors.SceneError` if a matrix of the algebra is not of the form
        [[L, c], [0, 0]].
        """
        super().check(group, where)
        matrices, d = group.require(MatrixElements), FloatDomain(0.0)
        n = matrices.order
        basis: tuple[Vector[float], ...] = units(d, group.dim)
        for k, x in enumerate(basis):
            if any(matrices.hat(d, x)[n * (n - 1) :]):
                raise SceneError(
                    f"{group.name} has no affine action: basis matrix {k} of the Lie algebra has a nonzero "
                    "last row",
                    where=where,
                    expected="a group of matrices [[A, b], [0, 1]], whose Lie algebra consists of matrices "
                    "[[L, c], [0, 0]]",
                    hint="use Linear() for linear maps of columns",
                )

    def point_size(self, group: LieGroup) -> int:
        """Return the dimension of the space on which the affine maps act."""
        return group.require(MatrixElements).order - 1

    def act(self, d: Domain, group: LieGroup, g: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return A y + b for g = [[A, b], [0, 1]]."""
        n = len(y)
        rows = [g[i : i + n + 1] for i in range(0, n * (n + 1), n + 1)]
        return tuple(dot(row[:n], y) + row[n] for row in rows)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return L y + c, where x has the matrix [[L, c], [0, 0]]."""
        return self.act(d, group, group.require(MatrixElements).hat(d, x), y)
