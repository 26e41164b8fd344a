"""Abelian groups. The Lie bracket is zero, and the adjoint action is trivial."""

from __future__ import annotations

from codegen.groups.capabilities import LeftTranslation
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Abelian(LeftTranslation):
    """A group with commuting elements. The maps ad and ad* are zero. The maps Ad, Ad* and dexp* are the
    identity.
    """

    abelian = True

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return zero."""
        return (d.rational(0),) * self.dim

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return zero."""
        return (d.rational(0),) * self.dim

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return x."""
        return x

    def Adinv(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return x."""
        return x

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return mu."""
        return mu

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return mu."""
        return mu

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return mu."""
        return mu

    def left_velocity(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return the derivative of g exp(eps x) = exp(eps x) g at eps = 0."""
        return self.velocity(d, x, g)
