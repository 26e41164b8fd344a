"""Matrix groups that are given by a basis of their Lie algebra.

Let L be the derivative of the exponential at the matrix x in the direction of the matrix y. Then
dexp_x y = L exp(-x).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from codegen.errors import SceneError
from codegen.groups.capabilities import Coadjoint, Projection, RightTrivialisation, Rotations
from codegen.groups.linear_algebra import LOOPED, S, Vector, invert, matmul, product, transposed
from codegen.groups.matrix_algebra import Sparse, matrix_algebra, sparse
from codegen.groups.matrix_coordinates import MatrixCoordinates
from codegen.groups.rational_rows import rational_rows
from codegen.ir.domain import Domain
from codegen.ir.matrix_functions import EXPANDED

Rows = Sequence[Sequence[int | Fraction]]
"""A rational matrix."""


class MatrixGroup(MatrixCoordinates, RightTrivialisation, Coadjoint):
    """The group of n x n matrices whose Lie algebra has a given basis of rational matrices.

    Elements of the algebra have coordinates in this basis, and elements of the dual have coordinates in the
    dual basis.

    - ``basis`` is a list of n x n matrices. Each matrix is a list of rows of integers or Fractions.
    - ``constants`` are the non-zero structure constants (i, j, k, c): c is the component of [e_i, e_j] along
      e_k.

    The bracket is [A, B] = AB - BA. :class:`codegen.errors.SceneError` is raised if the matrices are not a
    basis of a Lie algebra.
    """

    layout = ", row by row"

    def __init__(self, name: str, basis: Sequence[Rows]) -> None:
        self.name = name
        basis = [rational_rows(name, matrix) for matrix in basis]
        self.n = len(basis[0]) if basis else 0
        if not self.n or any(len(rows) != self.n for matrix in basis for rows in (matrix, *matrix)):
            raise SceneError(
                "the basis is empty, or a matrix is not square, or two matrices have different sizes",
                where=name,
                expected="n x n matrices",
            )
        self.dim, self.size = len(basis), self.n**2
        flat = (tuple(x for row in matrix for x in row) for matrix in basis)
        self.algebra = matrix_algebra(name, self.n, tuple(map(sparse, flat)))
        self.constants = self.algebra.constants
        self.abelian = not self.constants

    def hat(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the matrix of an element of the algebra."""
        return _weighted(d, self.algebra.places, x)

    def vee(self, d: Domain, matrix: Vector[S]) -> Vector[S]:
        """Return the coordinates of a matrix that belongs to the algebra: the inverse of :meth:`hat`."""
        return _weighted(d, self.algebra.dual, matrix)

    def dual_hat(self, d: Domain, mu: Vector[S]) -> Vector[S]:
        """Return the matrix M of an element mu of the dual.

        The matrix M satisfies <mu, x> = sum_ij M_ij A_ij for all x, where A = hat(x).
        """
        return _weighted(d, self.algebra.dual_places, mu)

    def dual_vee(self, d: Domain, matrix: Vector[S]) -> Vector[S]:
        """Return the element mu of the dual that belongs to the n x n matrix M = ``matrix``.

        The element mu satisfies <mu, x> = sum_ij M_ij A_ij for all x, where A = hat(x). Every n x n matrix M
        is allowed.
        """
        return _weighted(d, self.algebra.basis, matrix)

    def identity(self, d: Domain) -> Vector[S]:
        """Return the unit matrix."""
        return tuple(d.rational(int(i == j)) for i in range(self.n) for j in range(self.n))

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return the matrix product g k."""
        return product(d, g, k, self.n)

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the inverse matrix of g."""
        return invert(d, g, self.n)

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the exponential of the matrix of x."""
        a = self.hat(d, x)
        if 0 < self.algebra.nilpotency <= EXPANDED:
            return self._polynomial(d, a)
        return self._exponential(d, a)

    def exp_times(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y for a column y.

        If the matrices are large and the algebra is not nilpotent, exp(x) y is computed without the matrix
        exp(x).
        """
        if self.n < LOOPED or self.algebra.nilpotency:
            return super().exp_times(d, x, y)
        return d.vector(f"expmv{self.n}", (*self.hat(d, x), *y))

    def _polynomial(self, d: Domain, a: Vector[S]) -> Vector[S]:
        """Return exp(a) for a nilpotent algebra: the finite sum 1 + a + a^2/2 + ..."""
        unit: Vector[S] = self.identity(d)
        total, term = tuple(x + y for x, y in zip(unit, a, strict=True)), a
        for k in range(2, self.algebra.nilpotency):
            factor: S = d.rational(1, k)
            term = tuple(factor * x for x in product(d, a, term, self.n))
            total = tuple(x + y for x, y in zip(total, term, strict=True))
        return total

    def _exponential(self, d: Domain, a: Vector[S]) -> Vector[S]:
        return d.vector(f"expm{self.n}", a)

    def _with_derivative(self, d: Domain, a: Vector[S], e: Vector[S]) -> tuple[Vector[S], Vector[S]]:
        """Return exp(a) and the derivative of exp at a in the direction e."""
        both = d.vector(f"expm{self.n}_d1", (*a, *e))
        return both[: self.size], both[self.size :]

    def opposite_exponential(self, d: Domain, a: Vector[S], exponential: Vector[S]) -> Vector[S]:
        """Return exp(-a) for a matrix a of the algebra, given exp(a)."""
        # The matrix exp(a) is not inverted, because inversion would lose digits if exp(a) is ill-conditioned.
        return self._exponential(d, tuple(-x for x in a))

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return [x, y]."""
        if self._has_long_brackets:
            return self.vee(d, d.vector(f"commutator{self.n}", (*self.hat(d, x), *self.hat(d, y))))
        total: list[S] = [d.rational(0)] * self.dim
        for i, j, k, c in self.constants:
            total[k] = _added(d, total[k], c, x[i] * y[j])
        return tuple(total)

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return ad*_x mu, defined by <ad*_x mu, y> = <mu, [x, y]> for all y.

        Let a = hat(x) and M = dual_hat(mu). The result is dual_vee([a^T, M]).
        """
        if self._has_long_brackets:
            a = transposed(self.hat(d, x), self.n)
            return self.dual_vee(d, d.vector(f"commutator{self.n}", (*a, *self.dual_hat(d, mu))))
        total: list[S] = [d.rational(0)] * self.dim
        for i, j, k, c in self.constants:
            total[j] = _added(d, total[j], c, mu[k] * x[i])
        return tuple(total)

    @property
    def _has_long_brackets(self) -> bool:
        return self.n >= LOOPED and len(self.constants) > self.size

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return the coordinates of the matrix g A g^-1, where A = hat(x)."""
        return self._conjugated(d, g, x, self.inverse(d, g))

    def _conjugated(self, d: Domain, g: Vector[S], x: Vector[S], inverse: Vector[S]) -> Vector[S]:
        return self.vee(d, product(d, product(d, g, self.hat(d, x), self.n), inverse, self.n))

    def _dual_conjugated(self, d: Domain, g: Vector[S], mu: Vector[S], inverse: Vector[S]) -> Vector[S]:
        """Return dual_vee(g^T M g^-T) for M = dual_hat(mu) and ``inverse`` = g^-1."""
        moved = product(d, transposed(g, self.n), self.dual_hat(d, mu), self.n)
        return self.dual_vee(d, product(d, moved, transposed(inverse, self.n), self.n))

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_g mu, defined by <Ad*_g mu, y> = <mu, Ad_g y> for all y.

        Let M = dual_hat(mu). The result is dual_vee(g^T M g^-T).
        """
        return self._dual_conjugated(d, g, mu, self.inverse(d, g))

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} mu."""
        return self._dual_conjugated(d, self.inverse(d, g), mu, g)

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu.

        Let M = dual_hat(mu), and let R = dexp_{-x} M^T. The result is dual_vee(R^T).
        """
        if self.algebra.nilpotency:
            return self._dual_series(d, x, mu)
        a: Vector[S] = tuple(-t for t in self.hat(d, x))
        exponential, slope = self._with_derivative(d, a, transposed(self.dual_hat(d, mu), self.n))
        result = product(d, slope, self.opposite_exponential(d, a, exponential), self.n)
        return self.dual_vee(d, transposed(result, self.n))

    def _dual_series(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu for a nilpotent algebra: the finite sum of (ad*_x)^k mu/(k+1)! over k >= 0."""
        total, term = mu, mu
        # Let m = ``nilpotency``, so x^m = 0. Then (ad_x)^(2 m - 1) y = 0, because its terms x^i y x^j
        # have i >= m or j >= m.
        for k in range(2, 2 * self.algebra.nilpotency):
            factor: S = d.rational(1, k)
            term = tuple(factor * t for t in self.adt(d, x, term))
            total = tuple(s + t for s, t in zip(total, term, strict=True))
        return total

    def transport(self, d: Domain, x: Vector[S], n: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{exp(-x)} mu + dexp*_{-x} n.

        The cotangent bundle T*G of the group G is a group, too. Let (x, n) be an element of the Lie algebra
        of T*G, and let (q, mu) be an element of T*G. The exponential map of T*G maps (x, n) to an element of
        T*G. The product of this element and (q, mu) is (exp(x) q, p). The result of this method is the
        momentum p. This momentum does not depend on q.
        """
        if self.algebra.nilpotency:
            return super().transport(d, x, n, mu)
        return self._transported(d, x, n, mu)[1]

    def cotangent_expmul(
        self, d: Domain, x: Vector[S], n: Vector[S], q: Vector[S], mu: Vector[S]
    ) -> Vector[S]:
        """Return the product of exp(x, n) and (q, mu) in the group T*G.

        The first component is exp(x) q. The second component is the result of :meth:`transport`.
        """
        if self.algebra.nilpotency:
            return super().cotangent_expmul(d, x, n, q, mu)
        exponential, momentum = self._transported(d, x, n, mu)
        return self.mul(d, exponential, q) + momentum

    def _transported(
        self, d: Domain, x: Vector[S], n: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the pair (exp(x), p) with the momentum p = transport(x, n, mu).

        The momentum p is computed with matrices. Let M = dual_hat(mu), N = dual_hat(n) and
        R = exp(x) M^T exp(-x) + dexp_x N^T. Then p = dual_vee(R^T).
        """
        a = self.hat(d, x)
        exponential, slope = self._with_derivative(d, a, transposed(self.dual_hat(d, n), self.n))
        moved = product(d, exponential, transposed(self.dual_hat(d, mu), self.n), self.n)
        total = tuple(s + t for s, t in zip(moved, slope, strict=True))
        result = product(d, total, self.opposite_exponential(d, a, exponential), self.n)
        return exponential, self.dual_vee(d, transposed(result, self.n))

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the matrix product A g, where A is the matrix of x."""
        return matmul(self.hat(d, x), g, self.n)

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the coordinates of the algebra element v g^-1, for a tangent vector v at g."""
        return self.vee(d, product(d, v, self.inverse(d, g), self.n))


class IsometryGroup(MatrixGroup, Projection):
    """A group of matrices g with g^T J g = J. Each row of J has one non-zero entry, which is 1 or -1.

    ``form`` contains a pair (column, value) for each row of J: the position and the value of the non-zero
    entry.
    """

    form: tuple[tuple[int, int], ...]

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return J^-1 g^T J. If g is in the group, this matrix is the inverse of g."""
        result = list(g)
        for i, (p, s) in enumerate(self.form):
            for j, (q, t) in enumerate(self.form):
                x = g[self.n * j + i]
                result[self.n * p + q] = x if s == t else -x
        return tuple(result)

    def opposite_exponential(self, d: Domain, a: Vector[S], exponential: Vector[S]) -> Vector[S]:
        """Return exp(-a), the inverse of exp(a). The argument ``exponential`` is the matrix exp(a)."""
        return self.inverse(d, exponential)

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return g (3 - r g)/2 with r = J^-1 g^T J: one step of the Newton-Schulz iteration.

        The iteration converges to an element of the group if g is near the group.
        """
        half, three = d.rational(1, 2), d.rational(3)
        gram = matmul(self.inverse(d, g), g, self.n)
        defect: Vector[S] = tuple(
            half * ((three - x) if k % (self.n + 1) == 0 else -x) for k, x in enumerate(gram)
        )
        return matmul(g, defect, self.n)

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return a pair (text, residual) for each entry of the matrix J^-1 g^T J g - 1.

        The residual is the value of the entry.
        """
        name = "g^T g = 1" if all(p == (i, 1) for i, p in enumerate(self.form)) else "g^T J g = J"
        unit: Vector[S] = self.identity(d)
        pairs = zip(matmul(self.inverse(d, g), g, self.n), unit, strict=True)
        return tuple((name, x - e) for x, e in pairs)


class RotationGroup(IsometryGroup, Rotations):
    """A group of orthogonal matrices: g^T g = 1."""

    def __init__(self, name: str, basis: Sequence[Rows]) -> None:
        super().__init__(name, basis)
        self.form = tuple((i, 1) for i in range(self.n))

    def rotate(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y."""
        return self.exp_times(d, x, y)


def _weighted(d: Domain, rows: Sequence[Sparse], values: Sequence[S]) -> Vector[S]:
    """Return the product of the sparse rational matrix ``rows`` and the vector ``values``."""
    result: list[S] = []
    for row in rows:
        total: S = d.rational(0)
        for k, weight in row:
            total = _added(d, total, weight, values[k])
        result.append(total)
    return tuple(result)


def _added(d: Domain, total: S, w: Fraction, x: S) -> S:
    """Return total + w x."""
    if w == 1:
        return total + x
    if w == -1:
        return total - x
    factor: S = d.rational(w.numerator, w.denominator)
    return total + factor * x
