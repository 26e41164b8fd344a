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
    """Maps of events (y, t) to events (R y + v t + p, t + s), with the coordinates R (row by row), v, p, s.

    The linear factor (R, v) has the operations of SE(3). In this factor, the velocity v of a boost takes the
    place of the translation. The linear factor acts on R^4 by 4 x 4 matrices. An element (w, b, u, r) of the
    algebra contains the rates of R, v, p and s at the identity. The exponential of this element is (exp w,
    dexp_w b, dexp_w u + r psi(w) b, r). Here psi(w) is the sum of W^k/(k+2)! over k >= 0, and W is the matrix
    of the map b -> w cross b.
    """

    name = "Gal(3)"

    def __init__(self, rotations: LieGroup | None = None) -> None:
        super().__init__(SE3(rotations), _Events(), "Gal(3)")
        self.layout = ": rotation, row by row; velocity; position; time"

    def with_linear(self, linear: LieGroup) -> Semidirect:
        """Return the Galilean group with ``linear`` as its implementation of rotations and boosts."""
        return Semidirect(linear, _Events(), self.name)


class _Events(MatrixColumns):
    """The representation of rotations and boosts on events (position, time)."""

    def _inverse(self, d: Domain, group: LieGroup, g: Vector[S]) -> Vector[S]:
        columns, velocity = [g[j:9:3] for j in range(3)], g[9:]
        zero, one = d.rational(0), d.rational(1)
        rows = [(*column, -dot(column, velocity)) for column in columns]
        return (*(a for row in rows for a in row), zero, zero, zero, one)

    def translation(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S]) -> Vector[S]:
        """Return (dexp_w p + r psi b, r) for x = (w, b) and u = (p, r).

        Let W be the matrix of the map b -> w cross b. Let c_3 be the value of a Stumpff function at w.w, and
        let c_2' be the derivative of the Stumpff function c_2 at w.w. Then psi = 1/2 + c_3 W + c_4 W^2 with
        c_4 = c_2' + c_3/2.
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
