"""The Galilean group: rotations, boosts, and translations of space and time."""

from __future__ import annotations

from codegen.groups.base import LieGroup
from codegen.groups.cubic_ad import DEXP
from codegen.groups.linear_algebra import S, Vector, cross, dot
from codegen.groups.representations import MatrixColumns
from codegen.groups.se3 import SE3
from codegen.groups.semidirect import Semidirect
from codegen.groups.so3 import SO3
from codegen.ir.domain import Domain


class Galilean(Semidirect):
    """The group of the maps (y, t) -> (R y + v t + p, t + s). Here y is a position, and t is a time.

    The coordinates of an element are R (row by row), v, p and s. The components of an element (w, b, u, r) of
    the algebra are the derivatives of R, v, p and s at the identity.

    The exponential of (w, b, u, r) is (exp w, dexp_w b, dexp_w u + r psi(w) b, r). Here psi(w) is the sum of
    W^k/(k+2)! over k >= 0 for the matrix W with W a = w cross a for all a.
    """

    name = "Gal(3)"
    blocks = ((3, 9), (3, 3), (3, 3), (1, 1))

    def __init__(self, rotations: LieGroup | None = None) -> None:
        super().__init__(SE3(rotations), _Events(), "Gal(3)")
        self.layout = ": rotation, row by row; velocity; position; time"

    def with_linear(self, linear: LieGroup) -> Semidirect:
        """Return the Galilean group with ``linear`` as the group of rotations and boosts."""
        return Semidirect(linear, _Events(), self.name)


class _Events(MatrixColumns):
    """The action of rotations and boosts on events: (R, v) maps (y, t) to (R y + v t, t)."""

    def _inverse(self, d: Domain, group: LieGroup, g: Vector[S]) -> Vector[S]:
        columns, velocity = [g[j:9:3] for j in range(3)], g[9:]
        zero, one = d.rational(0), d.rational(1)
        rows = [(*column, -dot(column, velocity)) for column in columns]
        return (*(a for row in rows for a in row), zero, zero, zero, one)

    def translation(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S]) -> Vector[S]:
        """Return the translation of exp(x, u) for x = (w, b) and u = (p, r).

        Here w, b and p are vectors, and r is a number. Let W be the matrix with W a = w cross a for all
        vectors a. Let z = |w|^2, and let c_2 and c_3 be Stumpff functions. The result is
        (dexp_w p + r M b, r), where M is the matrix I/2 + c_3(z) W + (c_2'(z) + c_3(z)/2) W^2.
        """
        w, b, position, time = x[:3], x[3:], u[:3], u[3]
        z, half = dot(w, w), d.rational(1, 2)
        c3: S = d.call("stumpff3", z)
        c4 = d.call("slope2", z) + half * c3
        first = cross(w, b)
        second = cross(w, first)
        drift = (half * p + c3 * q + c4 * r for p, q, r in zip(b, first, second, strict=True))
        moved = SO3().series(d, DEXP, False, w, position)
        return (*(p + time * q for p, q in zip(moved, drift, strict=True)), time)
