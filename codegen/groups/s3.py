"""The group S^3 of unit quaternions. S^3 is the double cover of SO(3).

The Lie algebra of S^3 consists of the pure quaternions.
"""

from __future__ import annotations

from collections.abc import Sequence

from codegen.groups.capabilities import CayleyMap, Inverse, LeftTranslation, Projection, RightTrivialisation
from codegen.groups.cubic_ad import CubicAd
from codegen.groups.linear_algebra import S, Vector, cross, dot, rescaled
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation
from codegen.ir.number import Number


class S3(CubicAd, LeftTranslation, RightTrivialisation, Projection, Inverse, CayleyMap):
    """Unit quaternions (q0, q1, q2, q3) with real part q0 and Hamilton's product.

    A vector x of R^3 represents the element (0, x) of the algebra, a pure quaternion (section 2.6 of
    H. Marthinsen's thesis). In the formulas below, g^c is the conjugate of g, z = |x|^2, and c_k are the
    Stumpff functions.

    - The bracket is [x, y] = x y - y x = 2 (x cross y). The dual of ad_x is ad*_x mu = 2 (mu cross x).
    - The adjoint action is Ad_g x = g x g^c. The dual is Ad*_g mu = g^c mu g.
    - The exponential is exp(x) = (c_0(z), c_1(z) x).
    - The differential of the exponential is dexp_x = 1 + c_2(4z) ad_x + c_3(4z) ad_x^2.
    """

    name, layout = "S^3", ", real part first"
    dim, size = 3, 4
    coordinates = "unit quaternion"

    def identity(self, d: Domain) -> Vector[S]:
        """Return (1, 0, 0, 0)."""
        zero = d.rational(0)
        return (d.rational(1), zero, zero, zero)

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return the quaternion product g k."""
        a, b, c = g[1:], k[1:], cross(g[1:], k[1:])
        return (g[0] * k[0] - dot(a, b), *(g[0] * y + k[0] * x + z for x, y, z in zip(a, b, c, strict=True)))

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return (cos |x|, s x) with s = sin(|x|)/|x|."""
        z = dot(x, x)
        c0, c1 = d.call("stumpff0", z), d.call("stumpff1", z)
        return (c0, *(c1 * a for a in x))

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return cay(x) = (1 - |x|^2/4, x)/(1 + |x|^2/4)."""
        quarter, one = d.rational(1, 4) * dot(x, x), d.rational(1)
        factor = one / (one + quarter)
        return ((one - quarter) * factor, *(factor * a for a in x))

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y = (1 - |x|^2/4) y - (x cross y) + (x.y) x/2."""
        plain = d.rational(1) - d.rational(1, 4) * dot(x, x)
        factor = d.rational(1, 2) * dot(x, y)
        return tuple(plain * b - c + factor * a for a, b, c in zip(x, y, cross(x, y), strict=True))

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the quaternion product x y x. For pure quaternions x and y, it is |x|^2 y - 2 (x.y) x."""
        square, factor = dot(x, x), d.rational(2) * dot(x, y)
        return tuple(square * b - factor * a for a, b in zip(x, y, strict=True))

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the conjugate of g. The conjugate of a unit quaternion is its inverse."""
        return (g[0], *(-a for a in g[1:]))

    def squared_rate(self, d: Domain, x: Vector[S]) -> S:
        """Return z = 4 |x|^2. The number z satisfies ad_x^3 = -z ad_x."""
        four: S = d.rational(4)
        return four * dot(x, x)

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return [x, y] = 2 (x cross y)."""
        return tuple(d.rational(2) * a for a in cross(x, y))

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return ad*_x mu = 2 (mu cross x)."""
        return self.ad(d, mu, x)

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g x g^c, where g^c is the conjugate of g.

        If g has the real part q0 and the imaginary part q, the result is
        x + 2 q0 (q cross x) + 2 q cross (q cross x).
        """
        return self._rotated(d, g[0], g[1:], x)

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_g mu = g^c mu g, with the conjugate g^c of g."""
        return self._rotated(d, -g[0], g[1:], mu)

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} mu = g mu g^c, with the conjugate g^c of g."""
        return self._rotated(d, g[0], g[1:], mu)

    def _rotated(self, d: Domain, real: S, q: Vector[S], x: Vector[S]) -> Vector[S]:
        first = tuple(d.rational(2) * a for a in cross(q, x))
        second = cross(q, first)
        return tuple(a + real * b + c for a, b, c in zip(x, first, second, strict=True))

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu = mu - c_2 v + c_3 ((2 x) cross v) with v = (2 x) cross mu.

        The numbers c_k are the values of the Stumpff functions at 4 |x|^2.
        """
        twice = tuple(d.rational(2) * a for a in x)
        z = dot(twice, twice)
        c2, c3 = d.call("stumpff2", z), d.call("stumpff3", z)
        v = cross(twice, mu)
        w = cross(twice, v)
        return tuple(m - c2 * a + c3 * b for m, a, b in zip(mu, v, w, strict=True))

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return x.g, the quaternion product (0, x) g."""
        pairs = zip(x, cross(x, g[1:]), strict=True)
        return (-dot(x, g[1:]), *(g[0] * a + b for a, b in pairs))

    def Adinv(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_{g^-1} x = g^c x g, with the conjugate g^c of g."""
        return self._rotated(d, -g[0], g[1:], x)

    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return the equation |q|^2 = 1 as a rule that replaces q0^2 by 1 - q1^2 - q2^2 - q3^2."""
        minus = Number.rational(-1)
        return (((q[0], q[0]), ((Number.rational(1), ()), *((minus, (a, a)) for a in q[1:]))),)

    def left_velocity(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g.x, the quaternion product g (0, x)."""
        pairs = zip(x, cross(g[1:], x), strict=True)
        return (-dot(g[1:], x), *(g[0] * a + b for a, b in pairs))

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the element x of the algebra with (0, x) g = v.

        The result is the imaginary part of v g^c, where g^c is the conjugate of g.
        """
        turned = cross(v[1:], g[1:])
        return tuple(g[0] * a - v[0] * b - c for a, b, c in zip(v[1:], g[1:], turned, strict=True))

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (1 + e/2 + 3 e^2/8) g with e = 1 - |g|^2. The result is equal to g/|g| up to O(e^3)."""
        return rescaled(d, g, d.rational(1) - dot(g, g))

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return one pair (text, residual) for the equation |g|^2 = 1."""
        return (("|q|^2 = 1", dot(g, g) - d.rational(1)),)
