"""SO(3) as rotation matrices, so(3) and its dual as R^3."""

from __future__ import annotations

from typing import Any

from codegen.groups.protocol import LieGroup, Scalars, cross, dot, matmul, matvec
from codegen.ir.domain import Domain


class SO3(LieGroup):
    """Rotations of R^3: a matrix row by row; so(3) and so(3)* are R^3 by the hat map and the dot product.

    [x, y] = x cross y, Ad_g x = g x, Ad*_g mu = g^T mu, ad*_x mu = -x cross mu, dexp*_x = dexp_{-x}. With
    z = x.x and the Stumpff functions c_k: exp(x) = 1 + c_1 hat(x) + c_2 hat(x)^2 (Rodrigues), dexp_x =
    1 + c_2 ad_x + c_3 ad_x^2.
    """

    name, layout = "SO(3)", ", row by row"
    dim, size = 3, 9

    def identity(self, d: Domain) -> Scalars:
        """Return the unit matrix."""
        one, zero = d.rational(1), d.rational(0)
        return tuple(one if i == j else zero for i in range(3) for j in range(3))

    def mul(self, d: Domain, g: Scalars, k: Scalars) -> Scalars:
        """Return the matrix product."""
        return matmul(g, k, 3)

    def exp(self, d: Domain, x: Scalars) -> Scalars:
        """Return the rotation about x by the angle |x|."""
        z = dot(x, x)
        c1, c2 = d.call("stumpff1", z), d.call("stumpff2", z)
        a, b, c = (c1 * t for t in x)
        p, q, r = (c2 * t for t in x)
        xy, xz, yz = p * x[1], p * x[2], q * x[2]
        xx, yy, zz = p * x[0], q * x[1], r * x[2]
        one = d.rational(1)
        return (
            *(one - (yy + zz), xy - c, xz + b),
            *(xy + c, one - (xx + zz), yz - a),
            *(xz - b, yz + a, one - (xx + yy)),
        )

    def ad(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return x cross y."""
        return cross(x, y)

    def adt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return -x cross mu."""
        return cross(mu, x)

    def Ad(self, d: Domain, g: Scalars, x: Scalars) -> Scalars:
        """Return g x."""
        return matvec(g, x)

    def Adt(self, d: Domain, g: Scalars, mu: Scalars) -> Scalars:
        """Return g^T mu."""
        return tuple(dot(g[j::3], mu) for j in range(3))

    def Adtinv(self, d: Domain, g: Scalars, mu: Scalars) -> Scalars:
        """Return g mu."""
        return matvec(g, mu)

    def dexpt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return dexp_{-x} mu = mu - c_2 x cross mu + c_3 x cross (x cross mu)."""
        z = dot(x, x)
        c2, c3 = d.call("stumpff2", z), d.call("stumpff3", z)
        v = cross(x, mu)
        w = cross(x, v)
        return tuple(m - c2 * p + c3 * q for m, p, q in zip(mu, v, w, strict=True))

    def velocity(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return hat(x) g: x cross every column."""
        columns = [cross(x, g[j::3]) for j in range(3)]
        return tuple(columns[j][i] for i in range(3) for j in range(3))

    def rotate(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return exp(x) y = y + c_1 x cross y + c_2 x cross (x cross y) without forming exp(x)."""
        z = dot(x, x)
        c1, c2 = d.call("stumpff1", z), d.call("stumpff2", z)
        v = cross(x, y)
        w = cross(x, v)
        return tuple(a + c1 * b + c2 * c for a, b, c in zip(y, v, w, strict=True))

    def laws(self, d: Domain, g: Scalars) -> tuple[tuple[str, Any], ...]:
        """Return g^T g = 1 and det g = 1."""
        one, columns = d.rational(1), [g[j::3] for j in range(3)]
        gram = [dot(columns[i], columns[j]) - (one if i == j else 0) for i in range(3) for j in range(i, 3)]
        determinant = dot(columns[0], cross(columns[1], columns[2])) - one
        return (*(("g^T g = 1", x) for x in gram), ("det g = 1", determinant))

    def hat(self, d: Domain, x: Scalars) -> Scalars:
        """Return the skew matrix of x, row by row."""
        zero = d.rational(0)
        return (zero, -x[2], x[1], x[2], zero, -x[0], -x[1], x[0], zero)
