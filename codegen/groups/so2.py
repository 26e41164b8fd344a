"""SO(2): the rotations of the plane."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from codegen.groups.abelian import Abelian
from codegen.groups.capabilities import (
    CayleyMap,
    Inverse,
    MatrixRepresentation,
    PointMotions,
    Projection,
    RightTrivialisation,
)
from codegen.groups.linear_algebra import S, Vector, matvec, rescaled
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation
from codegen.ir.number import Number

if TYPE_CHECKING:
    import sympy


class SO2(Abelian, RightTrivialisation, Projection, PointMotions, MatrixRepresentation, Inverse, CayleyMap):
    """Rotations of the plane as (c, s), the cosine and the sine of the angle.

    An element of the algebra is an angular velocity w, and exp(w) = (cos w, sin w). The group is abelian.
    """

    name = "SO(2)"
    layout = ", cosine and sine of the angle"
    dim, size, point_size = 1, 2, 2

    def identity(self, d: Domain) -> Vector[S]:
        """Return (1, 0)."""
        return (d.rational(1), d.rational(0))

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return the product of g and k as complex numbers. The element (c, s) is the number c + i s."""
        return (g[0] * k[0] - g[1] * k[1], g[1] * k[0] + g[0] * k[1])

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (c, -s) for g = (c, s)."""
        return (g[0], -g[1])

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return (1 - w^2/4, w)/(1 + w^2/4) for x = (w,)."""
        quarter, one = d.rational(1, 4) * (x[0] * x[0]), d.rational(1)
        factor = one / (one + quarter)
        return ((one - quarter) * factor, x[0] * factor)

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y = (1 + w^2/4) y for x = (w,)."""
        return ((d.rational(1) + d.rational(1, 4) * (x[0] * x[0])) * y[0],)

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the element with the matrix hat(x) hat(y) hat(x). For x = (w,), this element is -w^2 y."""
        return (-(x[0] * x[0] * y[0]),)

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return (cos w, sin w) for x = (w,)."""
        z = x[0] * x[0]
        return (d.call("stumpff0", z), x[0] * d.call("stumpff1", z))

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return w (-s, c) for x = (w,) and g = (c, s)."""
        return (-(x[0] * g[1]), x[0] * g[0])

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the angular velocity w = c v_1 - s v_0 of the tangent vector v = w (-s, c) at g = (c, s)."""
        return (g[0] * v[1] - g[1] * v[0],)

    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return one replacement rule: c^2 becomes 1 - s^2."""
        terms = ((Number.rational(1), ()), (Number.rational(-1), (q[1], q[1])))
        return (((q[0], q[0]), terms),)

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (1 + e/2 + 3 e^2/8) g with e = 1 - c^2 - s^2. The length of the result is 1 + O(e^3)."""
        return rescaled(d, g, d.rational(1) - (g[0] * g[0] + g[1] * g[1]))

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return one pair: the text of the equation c^2 + s^2 = 1, and the residual of this equation."""
        return (("c^2 + s^2 = 1", g[0] * g[0] + g[1] * g[1] - d.rational(1)),)

    def move(self, d: Domain, g: Vector[S], z: Vector[S]) -> Vector[S]:
        """Return the point z, rotated by g."""
        return matvec(self.matrix(d, g), z)

    def point_velocity(self, d: Domain, x: Vector[S], z: Vector[S]) -> Vector[S]:
        """Return w (-z_1, z_0), the velocity of the point z for the angular velocity x = (w,)."""
        return (-(x[0] * z[1]), x[0] * z[0])

    def matrix(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the rotation matrix of g."""
        return (g[0], -g[1], g[1], g[0])

    def element(self, matrix: Vector[S]) -> Vector[S]:
        """Return the first column (c, s) of a rotation matrix."""
        return (matrix[0], matrix[2])

    def hat(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the entries of the skew matrix [[0, -w], [w, 0]] row by row, for x = (w,)."""
        zero = d.rational(0)
        return (zero, -x[0], x[0], zero)

    def vee(self, d: Domain, matrix: Vector[S]) -> Vector[S]:
        """Return the entry w below the diagonal of a skew matrix."""
        return (matrix[2],)

    def symbols(self, name: str) -> list[sympy.Symbol]:
        """Return the symbols of the cosine and the sine: ``name`` followed by c or s."""
        from sympy import Symbol

        return [Symbol(f"{name}{i}", real=True) for i in "cs"]
