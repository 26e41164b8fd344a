"""The group R^n, whose product is the addition of vectors."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.groups.abelian import Abelian
from codegen.groups.capabilities import (
    CayleyMap,
    Inverse,
    MatrixRepresentation,
    Projection,
    RightTrivialisation,
)
from codegen.groups.construction import check_size
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation


class Rn(Abelian, RightTrivialisation, MatrixRepresentation, Projection, Inverse, CayleyMap):
    """The abelian group (R^n, +). The exponential is the identity map, and every bracket vanishes."""

    def __init__(self, n: int) -> None:
        check_size("Rn", n, 1)
        self.dim = self.size = n
        self.name = f"R^{n}"

    def identity(self, d: Domain) -> Vector[S]:
        """Return the origin."""
        return (d.rational(0),) * self.dim

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return x, because the exponential of (R^n, +) is the identity map."""
        return x

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return g + k."""
        return tuple(a + b for a, b in zip(g, k, strict=True))

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return -g."""
        return tuple(-a for a in g)

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return x. On R^n, the Cayley map is the identity."""
        return x

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return y, because the derivative of cay is the identity map."""
        return y

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return zero. The matrices X of x and Y of y satisfy X Y = 0, and therefore X Y X = 0."""
        return (d.rational(0),) * self.dim

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return x, the derivative of g + eps x at eps = 0."""
        return x

    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return no replacement rules, because the coordinates are independent."""
        return ()

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return x = v, the solution of the equation velocity(x, g) = v."""
        return v

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return g, because every tuple of n numbers is an element of the group."""
        return g

    def matrix(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the (n + 1) x (n + 1) matrix that maps each column (z, 1) to (z + g, 1)."""
        return self._affine(d, g, d.rational(1))

    def element(self, matrix: Vector[S]) -> Vector[S]:
        """Return the vector of the translation: the first n entries of the last column of the matrix."""
        n = self.dim
        return matrix[n : (n + 1) * n : n + 1]

    def hat(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the (n + 1) x (n + 1) matrix with the last column (x, 0). The other columns are zero."""
        return self._affine(d, x, d.rational(0))

    def vee(self, d: Domain, matrix: Vector[S]) -> Vector[S]:
        """Return the first n entries of the last column of the matrix."""
        return self.element(matrix)

    def _affine(self, d: Domain, x: Vector[S], one: S) -> Vector[S]:
        """Return the (n + 1) x (n + 1) matrix whose diagonal entries are all equal to ``one``.

        The first n entries of the last column are x, and the remaining entries are zero.
        """
        n, zero = self.dim, d.rational(0)
        rows = [(*(one if i == j else zero for j in range(n)), x[i]) for i in range(n)]
        return (*(a for row in rows for a in row), *((zero,) * n), one)
