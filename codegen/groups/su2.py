"""SU(2), represented by unit quaternions. The basis of su(2) is -i sigma_k/2, k = 1, 2, 3, with Pauli's
matrices sigma_k. In this basis the bracket is the cross product.
"""

from __future__ import annotations

from codegen.groups.cubic_ad import DEXP
from codegen.groups.linear_algebra import S, Vector, cross, dot
from codegen.groups.s3 import S3
from codegen.ir.domain import Domain


class SU2(S3):
    """Unitary 2 x 2 matrices of determinant 1, stored as unit quaternions, real part first.

    The quaternion (q0, q1, q2, q3) is the matrix q0 - i (q1 sigma_1 + q2 sigma_2 + q3 sigma_3) with Pauli's
    matrices. The basis of the algebra is -i sigma_k/2. The element with the coordinates x is the
    quaternion (0, x/2). In the formulas below z = x.x, and c_k are the Stumpff functions.

    - The bracket is [x, y] = x cross y.
    - The exponential is exp(x) = (c_0(z/4), c_1(z/4) x/2).
    - The differential of the exponential is dexp_x = 1 + c_2(z) ad_x + c_3(z) ad_x^2.
    """

    name = "SU(2)"

    def squared_rate(self, d: Domain, x: Vector[S]) -> S:
        """Return x.x, the square of the angle by which the quaternion exp(x) rotates vectors."""
        return dot(x, x)

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return (cos(|x|/2), s x) with s = sin(|x|/2)/|x|."""
        return S3.exp(self, d, _half(d, x))

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the unit quaternion cay(x) = (1 - |x|^2/16, x/2)/(1 + |x|^2/16)."""
        return S3.cay(self, d, _half(d, x))

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y, computed as twice the result of :meth:`S3.dcayinv` for x/2 and y/2."""
        return tuple(d.rational(2) * a for a in S3.dcayinv(self, d, _half(d, x), _half(d, y)))

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return w with (0, w/2) = X Y X for the quaternions X = (0, x/2) and Y = (0, y/2)."""
        return tuple(d.rational(2) * a for a in S3.sandwich(self, d, _half(d, x), _half(d, y)))

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x cross y."""
        return cross(x, y)

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return -x cross mu."""
        return cross(mu, x)

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu = mu + c_2 ad*_x mu + c_3 (ad*_x)^2 mu.

        The numbers c_k are the values of the Stumpff functions at x.x.
        """
        return self.series(d, DEXP, True, x, mu)

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the quaternion product (0, x/2) g."""
        return S3.velocity(self, d, _half(d, x), g)

    def left_velocity(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return the quaternion product g (0, x/2)."""
        return S3.left_velocity(self, d, g, _half(d, x))

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return x such that v is the quaternion product (0, x/2) g."""
        return tuple(d.rational(2) * a for a in S3.rate(self, d, v, g))


def _half(d: Domain, x: Vector[S]) -> Vector[S]:
    half: S = d.rational(1, 2)
    return tuple(half * a for a in x)
