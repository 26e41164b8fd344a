"""R^n under addition."""

from __future__ import annotations

from typing import Any

from codegen.groups.base import LieGroup, Scalars
from codegen.ir.domain import Domain


class Rn(LieGroup):
    """The abelian group (R^n, +): exp is the identity map and every bracket vanishes.

    On it RKMK, CG and CF methods are Runge-Kutta methods, and variational ones symplectic partitioned ones.
    """

    abelian = True

    def __init__(self, n: int) -> None:
        self.dim = self.size = n
        self.name = f"R^{n}"

    def identity(self, d: Domain) -> Scalars:
        """Return the origin."""
        return (d.rational(0),) * self.dim

    def exp(self, d: Domain, x: Scalars) -> Scalars:
        """Return x."""
        return x

    def mul(self, d: Domain, g: Scalars, k: Scalars) -> Scalars:
        """Return g + k."""
        return tuple(a + b for a, b in zip(g, k, strict=True))

    def ad(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return zero."""
        return (d.rational(0),) * self.dim

    def adt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return zero."""
        return (d.rational(0),) * self.dim

    def Ad(self, d: Domain, g: Scalars, x: Scalars) -> Scalars:
        """Return x."""
        return x

    Adt = Adtinv = dexpt = Ad

    def velocity(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return x."""
        return x

    def rate(self, d: Domain, v: Scalars, g: Scalars) -> Scalars:
        """Return v."""
        return v

    def symbols(self, name: str) -> list[Any]:
        """Return the symbols of a group element: ``name`` with an index."""
        return list(self.dual(name))

    def point(self, name: str) -> Any:
        """Return a sympy column of symbols for a group element."""
        return self.dual(name)
