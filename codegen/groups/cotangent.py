"""The cotangent bundle T*G of a Lie group G as a Lie group. The elements of T*G are pairs (g, mu)."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.groups.base import C, LieGroup
from codegen.groups.capabilities import Coadjoint, CotangentBundle, Inverse, Projection
from codegen.groups.construction import check_factor
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Cotangent(CotangentBundle, Projection, Inverse):
    """T*G, the magnetic extension of G (Arnold and Khesin, I.10.B), with the product
    (g, mu)(k, nu) = (g k, mu + Ad*_{g^-1} nu). The coordinates of g come before the coordinates of mu.

    An element of the algebra is a pair (xi, n). Let xi.q be the derivative of exp(eps xi) q at eps = 0. A
    vector field with the values f(q, mu) = (xi, n) has the differential equations q' = xi.q and
    mu' = n - ad*_xi mu (eq. 2.27 of H. Marthinsen's thesis).

    - The bracket is [(x, m), (y, n)] = ([x, y], ad*_y m - ad*_x n).
    - The exponential is exp(xi, n) = (exp xi, dexp*_{-xi} n).

    :class:`SceneError` is raised if G has no coadjoint action.
    """

    def __init__(self, base: LieGroup) -> None:
        check_factor("a cotangent bundle", base)
        self.base = base.require(Coadjoint)
        # Parentheses distinguish T*(G x H) from T*G x H.
        self.name = f"T*({base.name})" if " x " in base.name else f"T*{base.name}"
        ordered = base.layout if base.layout.startswith(":") else f": {base.name}{base.layout}"
        self.layout = f"{ordered}; the right-trivialised momentum"
        self.dim, self.size = 2 * base.dim, base.size + base.dim
        self.abelian = base.abelian

    def _split(self, x: Vector[S]) -> tuple[Vector[S], Vector[S]]:
        """Split an element of the group into (q, mu), or an element of the algebra into (xi, n)."""
        at = self.base.size if len(x) == self.size else self.base.dim
        return tuple(x[:at]), tuple(x[at:])

    def identity(self, d: Domain) -> Vector[S]:
        """Return (e, 0), where e is the identity of the base group."""
        e: Vector[S] = self.base.identity(d)
        return e + (d.rational(0),) * self.base.dim

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return (exp xi, dexp*_{-xi} n) for x = (xi, n)."""
        xi, n = self._split(x)
        return self.base.exp(d, xi) + self.base.dexpt(d, tuple(-a for a in xi), n)

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return (a b, mu + Ad*_{a^-1} nu), the product of the pairs g = (a, mu) and k = (b, nu)."""
        (a, mu), (b, nu) = self._split(g), self._split(k)
        moved = self.base.Adtinv(d, a, nu)
        return self.base.mul(d, a, b) + tuple(x + y for x, y in zip(mu, moved, strict=True))

    def expmul(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return exp(x) g."""
        (xi, n), (q, mu) = self._split(x), self._split(g)
        return self.base.cotangent_expmul(d, xi, n, q, mu)

    def variants(self) -> Sequence[Cotangent]:
        """Return one group T*G for each implementation in ``G.variants()``."""
        return tuple(Cotangent(base) for base in self.base.variants())

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return ([a, b], ad*_b m - ad*_a n), the bracket of the pairs x = (a, m) and y = (b, n)."""
        (a, m), (b, n) = self._split(x), self._split(y)
        pairs = zip(self.base.adt(d, b, m), self.base.adt(d, a, n), strict=True)
        return self.base.ad(d, a, b) + tuple(p - q for p, q in pairs)

    def canonical(self, d: Domain, z: Vector[S], covector: Vector[S]) -> Vector[S]:
        """Return (b, ad*_b mu - a) for a covector (a, b) at the point z = (q, mu).

        The result is the right-trivialised canonical bivector, applied to the covector (eq. 2.26 of
        Marthinsen's thesis).
        """
        mu = self._split(z)[1]
        a, b = tuple(covector[: self.base.dim]), tuple(covector[self.base.dim :])
        pairs = zip(self.base.adt(d, b, mu), a, strict=True)
        return b + tuple(x - y for x, y in pairs)

    def offers(self, capability: type[C]) -> C | None:
        """Return this group if it has the operations of the class ``capability``. Otherwise return None.

        T*G has :class:`Projection` only if the base group has :class:`Projection`. The same rule holds for
        :class:`Inverse`.
        """
        own = super().offers(capability)
        return None if capability in (Projection, Inverse) and self.base.offers(capability) is None else own

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (q^-1, -Ad*_q mu), the inverse of g = (q, mu)."""
        q, mu = self._split(g)
        back = self.base.Adt(d, q, mu)
        return self.base.require(Inverse).inverse(d, q) + tuple(-m for m in back)

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (p, mu) for g = (q, mu). Here p is the projection of q onto the base group."""
        q, mu = self._split(g)
        return self.base.require(Projection).project(d, q) + mu

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of the base group for q, the first component of g = (q, mu).

        There are no equations for mu, because mu may be any vector.
        """
        return self.base.laws(d, self._split(g)[0])

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return (xi.q, n - ad*_xi mu), the velocity of g = (q, mu) for x = (xi, n)."""
        (xi, n), (q, mu) = self._split(x), self._split(g)
        pairs = zip(n, self.base.adt(d, xi, mu), strict=True)
        return self.base.velocity(d, xi, q) + tuple(a - b for a, b in pairs)
