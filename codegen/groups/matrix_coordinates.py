"""The Cayley map on groups of matrices, and exponentials of basis elements in closed form."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property

from codegen.groups.base import C
from codegen.groups.capabilities import CayleyMap, MatrixElements
from codegen.groups.linear_algebra import S, Vector, matmul, solved_near_identity
from codegen.ir.domain import Domain, SeriesDomain
from orderconds.ring import QQ


class MatrixCoordinates(MatrixElements, CayleyMap):
    """A group of matrices. The basis matrices of the algebra have rational entries.

    If the algebra contains the cube of each of its elements, the group has a Cayley map.
    """

    def offers(self, capability: type[C]) -> C | None:
        """Return this group if it has the operations of the class ``capability``. Otherwise return None.

        The group has the capability :class:`CayleyMap` only if its algebra contains x^3 for all elements x.
        """
        own = super().offers(capability)
        return None if capability is CayleyMap and not self._contains_cubes else own

    @cached_property
    def _contains_cubes(self) -> bool:
        """True if the cube of every element of the algebra is in the algebra.

        Only one element x is tested. For random integer coordinates below 2^61, the probability of a
        wrong result is less than 3/2^60.
        """
        # Powers of 37 modulo a prime look random, but do not vary between runs.
        x = tuple(Fraction(pow(37, 1000 + 77 * k, 2**61 - 1)) for k in range(self.dim))
        matrix = self._exact(x)
        cube = matmul(matrix, matmul(matrix, matrix, self.order), self.order)
        d = SeriesDomain(QQ, 0)
        y = self.vee(d, tuple(d.rational(c.numerator, c.denominator) for c in cube))
        return self._exact(tuple(Fraction(QQ.text(c.coefficients[0])) for c in y)) == cube

    def _exact(self, x: Sequence[Fraction]) -> Vector[Fraction]:
        """Return the exact matrix of the element x of the algebra."""
        d = SeriesDomain(QQ, 0)
        entries = self.hat(d, tuple(d.rational(a.numerator, a.denominator) for a in x))
        return tuple(Fraction(QQ.text(e.coefficients[0])) for e in entries)

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the Cayley map (1 - A/2)^-1 (1 + A/2), where A is the matrix of x."""
        return solved_near_identity(*self._near_identity(d, x), self.order)

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the coordinates of (1 - A/2) B (1 + A/2) for the matrices A of x and B of y."""
        left, right = self._near_identity(d, x)
        n = self.order
        return self.vee(d, matmul(matmul(left, self.hat(d, y), n), right, n))

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the coordinates of A B A. A is the matrix of x, and B is the matrix of y."""
        left, middle = self.hat(d, x), self.hat(d, y)
        return self.vee(d, matmul(matmul(left, middle, self.order), left, self.order))

    def _near_identity(self, d: Domain, x: Vector[S]) -> tuple[Vector[S], Vector[S]]:
        """Return 1 - A/2 and 1 + A/2 for the matrix A of x."""
        half: S = d.rational(1, 2)
        one: Vector[S] = self.identity(d)
        pairs = [(i, half * e) for i, e in zip(one, self.hat(d, x), strict=True)]
        return tuple(i - e for i, e in pairs), tuple(i + e for i, e in pairs)

    def expbasis(self, d: Domain, k: int, t: S) -> Vector[S]:
        """Return exp(t B) for the basis matrix B with the index k.

        If B^3 = s B for a number s, the result is 1 + t c_1(z) B + t^2 c_2(z) B^2. Here z = -s t^2, and c_1
        and c_2 are Stumpff functions.
        """
        b = self._exact([Fraction(int(i == k)) for i in range(self.dim)])
        square = matmul(b, b, self.order)
        c = _ratio(matmul(square, b, self.order), b)
        if c is None:
            return super().expbasis(d, k, t)
        first, second = _stumpff(d, c, t)
        unit: Vector[S] = self.identity(d)
        factors = (t * first, t * t * second)
        return tuple(_plus(d, one, (p, q), factors) for one, p, q in zip(unit, b, square, strict=True))


def _ratio(a: Vector[Fraction], b: Vector[Fraction]) -> Fraction | None:
    """Return the number c with a = c b, or None if there is no such number."""
    c = next((x / y for x, y in zip(a, b, strict=True) if y), Fraction(0))
    return c if all(x == c * y for x, y in zip(a, b, strict=True)) else None


def _stumpff(d: Domain, c: Fraction, t: S) -> tuple[S, S]:
    """Return c_1(z) and c_2(z) for z = -c t^2, where c_1 and c_2 are Stumpff functions."""
    if not c:
        return d.rational(1), d.rational(1, 2)
    z: S = d.rational(-c.numerator, c.denominator) * (t * t)
    if c < 0:
        return d.call("stumpff1", z), d.call("stumpff2", z)
    # The half-angle formula c_2(z) = c_1(z/4)^2/2 gives the second Stumpff function.
    half: S = d.call("signed_stumpff1", d.rational(1, 4) * z)
    return d.call("signed_stumpff1", z), d.rational(1, 2) * (half * half)


def _plus(d: Domain, total: S, weights: tuple[Fraction, Fraction], values: tuple[S, S]) -> S:
    """Return ``total`` + w_0 v_0 + w_1 v_1 with weights w and values v."""
    for w, v in zip(weights, values, strict=True):
        if w:
            factor: S = d.rational(w.numerator, w.denominator)
            total = total + (v if w == 1 else factor * v)
    return total
