"""SE(2): the rigid motions of the plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

from codegen.groups.capabilities import CayleyMap, Coadjoint, Inverse, PointMotions, Projection
from codegen.groups.linear_algebra import S, Vector, rescaled
from codegen.ir.domain import Domain

if TYPE_CHECKING:
    import sympy


class SE2(Coadjoint, PointMotions, Projection, Inverse, CayleyMap):
    """Motions z -> R z + a of the plane. R is the rotation by the angle with cosine c and sine s.

    The coordinates of a motion are (c, s, a0, a1). An element of the algebra is (w, u0, u1): the angular
    velocity w, and the velocity u of the point at the origin. In the formulas below, J is the rotation by the
    angle pi/2, and c_k are the values of the Stumpff functions at w^2.

    - The bracket is [(w, u), (w', u')] = (0, w J u' - w' J u).
    - The motion exp(w, u) rotates by w and translates by (c_1 + c_2 w J) u.
    - The equation ad_x^3 = -w^2 ad_x implies dexp_x = 1 + c_2 ad_x + c_3 ad_x^2.
    """

    # In emitted code, ``layout`` follows the name of the group, so the text begins with a comma.
    name, layout = "SE(2)", ", cosine and sine of the angle, then the translation"
    dim, size, point_size = 3, 4, 2
    blocks = ((1, 2), (2, 2))

    def identity(self, d: Domain) -> Vector[S]:
        """Return the identity map of the plane."""
        zero = d.rational(0)
        return (d.rational(1), zero, zero, zero)

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return exp(x), the motion that results from the constant velocity x after unit time."""
        w, u, v = x
        z = w * w
        c0, c1, c2 = (d.call(f"stumpff{k}", z) for k in range(3))
        turned = w * c2
        return (c0, w * c1, c1 * u - turned * v, c1 * v + turned * u)

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the Cayley map of the 3 x 3 matrix of x = (w, u).

        The result has the rotation cay(w J) and the translation (1 - w J/2)^-1 u. Here J is the rotation by
        the angle pi/2.
        """
        w, u, v = x
        one, half = d.rational(1), d.rational(1, 2) * w
        square = half * half
        factor = one / (one + square)
        translation = (factor * (u - half * v), factor * (v + half * u))
        return ((one - square) * factor, w * factor, *translation)

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y = y - [x, y]/2 + w w' x/4 for the angular velocities w of x and w' of y."""
        factor, half = d.rational(1, 4) * (x[0] * y[0]), d.rational(1, 2)
        return tuple(b - half * c + factor * a for a, b, c in zip(x, y, self.ad(d, x, y), strict=True))

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the element with the matrix X Y X, where X and Y are the 3 x 3 matrices of x and y."""
        factor = -(x[0] * y[0])
        return tuple(factor * a for a in x)

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the motion z -> R^T (z - a), the inverse of the motion g: z -> R z + a."""
        c, s, a, b = g
        return (c, -s, -(c * a + s * b), s * a - c * b)

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return the product g k, the motion z -> g(k(z))."""
        c, s = g[:2]
        return (c * k[0] - s * k[1], s * k[0] + c * k[1], *self.move(d, g, k[2:]))

    def move(self, d: Domain, g: Vector[S], z: Vector[S]) -> Vector[S]:
        """Return R z + a for the motion g with rotation R and translation a."""
        c, s, a, b = g
        return (c * z[0] - s * z[1] + a, s * z[0] + c * z[1] + b)

    def point_velocity(self, d: Domain, x: Vector[S], z: Vector[S]) -> Vector[S]:
        """Return the velocity w J z + u of the point z for x = (w, u). J is the rotation by pi/2."""
        w, u, v = x
        return (u - w * z[1], v + w * z[0])

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return [x, y] = (0, w J u' - w' J u) for x = (w, u) and y = (w', u').

        Here J is the rotation by the angle pi/2.
        """
        return (d.rational(0), y[0] * x[2] - x[0] * y[2], x[0] * y[1] - y[0] * x[1])

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return ad*_x mu, defined by <ad*_x mu, y> = <mu, [x, y]> for all y."""
        w, u, v = x
        return (mu[1] * v - mu[2] * u, w * mu[2], -(w * mu[1]))

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g x g^-1 = (w, R u - w J a) for x = (w, u).

        Here R is the rotation of g, a is the translation of g, and J is the rotation by the angle pi/2.
        """
        c, s, a, b = g
        w, u, v = x
        return (w, c * u - s * v + w * b, s * u + c * v - w * a)

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_g mu, defined by <Ad*_g mu, x> = <mu, Ad_g x> for all x."""
        c, s, a, b = g
        m, p, r = mu
        return (m + p * b - r * a, c * p + s * r, c * r - s * p)

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} mu."""
        c, s, a, b = g
        m, p, r = mu[0], c * mu[1] - s * mu[2], s * mu[1] + c * mu[2]
        return (m - p * b + r * a, p, r)

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu = mu + c_2 ad*_x mu + c_3 (ad*_x)^2 mu for x = (w, u).

        The numbers c_k are the values of the Stumpff functions at w^2.
        """
        z = x[0] * x[0]
        c2, c3 = d.call("stumpff2", z), d.call("stumpff3", z)
        first = self.adt(d, x, mu)
        second = self.adt(d, x, first)
        return tuple(m + c2 * a + c3 * b for m, a, b in zip(mu, first, second, strict=True))

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return x.g for x = (w, u) and g = (c, s, a).

        The result is w J (c, s), followed by the velocity w J a + u of the point a. Here J is the rotation by
        the angle pi/2.
        """
        w = x[0]
        return (-(w * g[1]), w * g[0], *self.point_velocity(d, x, g[2:]))

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (f c, f s, a) for g = (c, s, a), where f = 1 + e/2 + 3 e^2/8 and e = 1 - c^2 - s^2.

        The length of the vector (f c, f s) is 1 + O(e^3).
        """
        return (*rescaled(d, g[:2], d.rational(1) - (g[0] * g[0] + g[1] * g[1])), *g[2:])

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return a tuple with one pair (text, residual). For g = (c, s, a) the residual is c^2 + s^2 - 1."""
        return (("c^2 + s^2 = 1", g[0] * g[0] + g[1] * g[1] - d.rational(1)),)

    def symbols(self, name: str) -> list[sympy.Symbol]:
        """Return the symbols of the four coordinates: ``name`` followed by c, s, 0 or 1."""
        from sympy import Symbol

        return [Symbol(f"{name}{i}", real=True) for i in ("c", "s", "0", "1")]
