"""The group SL(2) of real 2 x 2 matrices with determinant 1."""

from __future__ import annotations

from codegen.groups.capabilities import Coadjoint, Projection
from codegen.groups.cubic_ad import CubicAd
from codegen.groups.linear_algebra import S, Vector, dot, rescaled, units
from codegen.groups.matrix import MatrixGroup
from codegen.ir.domain import Domain


class SL2(CubicAd, MatrixGroup, Projection):
    """Real 2 x 2 matrices of determinant 1, stored row by row.

    The basis of the algebra is X = [[0, 1], [0, 0]], Y = [[0, 0], [1, 0]] and H = [[1, 0], [0, -1]] (section
    2.2 of H. Marthinsen's thesis). The brackets are [X, Y] = H, [H, X] = 2X and [H, Y] = -2Y.

    Let A be a traceless matrix, z = det A, I the unit matrix, and c_k the Stumpff functions. The equation
    A^2 = -z I implies these formulas:

    - The exponential is exp A = c_0(z) I + c_1(z) A.
    - The differential of the exponential is dexp_A = 1 + c_2(4z) ad_A + c_3(4z) ad_A^2.
    """

    signed = True

    def __init__(self) -> None:
        super().__init__("SL(2)", [[[0, 1], [0, 0]], [[0, 0], [1, 0]], [[1, 0], [0, -1]]])

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return exp A = c_0(z) I + c_1(z) A, where A is the matrix of x and z = det A.

        Here I is the unit matrix, and c_0 and c_1 are Stumpff functions.
        """
        z = _determinant(x)
        c0, c1 = d.call("signed_stumpff0", z), d.call("signed_stumpff1", z)
        diagonal = c1 * x[2]
        return (c0 + diagonal, c1 * x[0], c1 * x[1], c0 - diagonal)

    def squared_rate(self, d: Domain, x: Vector[S]) -> S:
        """Return z = 4 det A, where A is the matrix of x. The number z satisfies ad_x^3 = -z ad_x."""
        four: S = d.rational(4)
        return four * _determinant(x)

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_g x = g x g^-1."""
        return self._conjugated(d, g, x, _adjugate(g))

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_g mu: its components are <mu, Ad_g e> for the basis elements e of the algebra."""
        inverse = _adjugate(g)
        basis: tuple[Vector[S], ...] = units(d, self.dim)
        return tuple(dot(mu, self._conjugated(d, g, e, inverse)) for e in basis)

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} mu."""
        return self.Adt(d, _adjugate(g), mu)

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the adjugate of the matrix g. Because det g = 1, the adjugate is the inverse of g."""
        return _adjugate(g)

    def transport(self, d: Domain, x: Vector[S], n: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{exp(-x)} mu + dexp*_{-x} n, computed in closed form."""
        return Coadjoint.transport(self, d, x, n, mu)

    def cotangent_expmul(
        self, d: Domain, x: Vector[S], n: Vector[S], q: Vector[S], mu: Vector[S]
    ) -> Vector[S]:
        """Return the product of exp(x, n) and (q, mu) in T*G."""
        return Coadjoint.cotangent_expmul(self, d, x, n, q, mu)

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (1 + e/2 + 3 e^2/8) g with e = 1 - det g. The determinant of the result is 1 + O(e^3)."""
        return rescaled(d, g, d.rational(1) - (g[0] * g[3] - g[1] * g[2]))

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return one pair (text, residual) for the equation det g = 1."""
        return (("det g = 1", g[0] * g[3] - g[1] * g[2] - d.rational(1)),)


def _adjugate(g: Vector[S]) -> Vector[S]:
    """Return the adjugate of the matrix g."""
    return (g[3], -g[1], -g[2], g[0])


def _determinant(x: Vector[S]) -> S:
    """Return the determinant of the matrix with the coordinates x in the basis X, Y, H."""
    return -(x[2] * x[2] + x[0] * x[1])
