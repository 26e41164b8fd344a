"""T*G = G x g* as a Lie group: the magnetic extension of G."""

from __future__ import annotations

from typing import Any

from codegen.groups.base import LieGroup, Scalars
from codegen.ir.domain import Domain


class Cotangent(LieGroup):
    """T*G with product (g, mu)(k, nu) = (g k, mu + Ad*_{g^-1} nu), elements and algebra in that order.

    With f(q, mu) = (xi, n) the flow is q' = xi.q, mu' = n - ad*_xi mu, that is z' = f(z).z (Arnold and
    Khesin I.10.B; thesis eq. 2.27). Hence exp(xi, n) = (exp xi, dexp*_{-xi} n) and
    [(x, m), (y, n)] = ([x, y], ad*_y m - ad*_x n).
    """

    def __init__(self, base: Any) -> None:
        self.base = base
        self.name = f"T*({base.name})" if " x " in base.name else f"T*{base.name}"
        ordered = base.layout if base.layout.startswith(":") else f": {base.name}{base.layout}"
        self.layout = f"{ordered}; the right-trivialised momentum"
        self.dim, self.size = 2 * base.dim, base.size + base.dim
        self.abelian = base.abelian

    def _split(self, x: Scalars) -> tuple[Scalars, Scalars]:
        at = self.base.size if len(x) == self.size else self.base.dim
        return tuple(x[:at]), tuple(x[at:])

    def identity(self, d: Domain) -> Scalars:
        """Return (e, 0)."""
        e: Scalars = self.base.identity(d)
        zeros: Scalars = (d.rational(0),) * self.base.dim
        return e + zeros

    def exp(self, d: Domain, x: Scalars) -> Scalars:
        """Return (exp xi, dexp*_{-xi} n)."""
        xi, n = self._split(x)
        g: Scalars = self.base.exp(d, xi)
        return g + tuple(self.base.dexpt(d, tuple(-a for a in xi), n))

    def mul(self, d: Domain, g: Scalars, k: Scalars) -> Scalars:
        """Return (g k, mu + Ad*_{g^-1} nu)."""
        (a, mu), (b, nu) = self._split(g), self._split(k)
        moved = self.base.Adtinv(d, a, nu)
        product: Scalars = self.base.mul(d, a, b)
        return product + tuple(x + y for x, y in zip(mu, moved, strict=True))

    def left(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return exp(x) g."""
        (xi, n), (q, mu) = self._split(x), self._split(g)
        element: Scalars = self.base.left(d, xi, q)
        return element + tuple(self.base.moved(d, xi, n, mu))

    def variants(self) -> tuple[Cotangent, ...]:
        """Return the bundles over the variants of the base."""
        return tuple(Cotangent(base) for base in self.base.variants())

    def ad(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return ([x, y], ad*_y m - ad*_x n)."""
        (a, m), (b, n) = self._split(x), self._split(y)
        pairs = zip(self.base.adt(d, b, m), self.base.adt(d, a, n), strict=True)
        bracket: Scalars = self.base.ad(d, a, b)
        return bracket + tuple(p - q for p, q in pairs)

    def canonical(self, d: Domain, z: Scalars, covector: Scalars) -> Scalars:
        """Return (b, ad*_b mu - a) for a covector (a, b): the bivector of (2.26), right-trivialised.

        For the differential (ad*_xi mu - n, xi) of a Hamiltonian it is f = (xi, n).
        """
        mu = self._split(z)[1]
        a, b = tuple(covector[: self.base.dim]), tuple(covector[self.base.dim :])
        pairs = zip(self.base.adt(d, b, mu), a, strict=True)
        return b + tuple(x - y for x, y in pairs)

    def laws(self, d: Domain, g: Scalars) -> tuple[tuple[str, Any], ...]:
        """Return those of the base; every covector is a momentum."""
        return tuple(self.base.laws(d, self._split(g)[0]))

    def velocity(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return (xi.q, n - ad*_xi mu)."""
        (xi, n), (q, mu) = self._split(x), self._split(g)
        pairs = zip(n, self.base.adt(d, xi, mu), strict=True)
        velocity: Scalars = self.base.velocity(d, xi, q)
        return velocity + tuple(a - b for a, b in pairs)
