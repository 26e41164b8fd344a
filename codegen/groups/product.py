"""Direct products of groups: pairs, triples and so on, each factor for itself."""

from __future__ import annotations

from collections.abc import Callable
from itertools import accumulate
from typing import Any

from codegen.errors import SceneError
from codegen.groups.base import LieGroup, Scalars
from codegen.ir.domain import Domain


class Product(LieGroup):
    """G1 x G2 x ...: coordinates of the factors one after the other, every operation factor by factor.

    As SO(3) x R^3 it holds a rigid body's attitude and momentum, as G x R a configuration and the time. It is
    not the group of rigid motions, whose rotations turn its translations.
    """

    def __init__(self, *factors: Any) -> None:
        if not factors:
            raise SceneError("a product without factors", expected="one group at least")
        self.factors = factors
        self.name = " x ".join(f.name for f in factors)
        self.dim, self.size = sum(f.dim for f in factors), sum(f.size for f in factors)
        self.abelian = all(f.abelian for f in factors)
        self.layout = ": " + "; ".join(f.name + f.layout for f in factors)

    def parts(self, x: Scalars) -> tuple[Scalars, ...]:
        """Return the factors' coordinates of an element, or of one of the algebra or its dual, by length.

        Where the lengths agree they do in every factor.
        """
        sizes = [f.size if len(x) == self.size else f.dim for f in self.factors]
        pairs = zip(accumulate(sizes), sizes, strict=True)
        return tuple(tuple(x[end - n : end]) for end, n in pairs)

    def _each(self, operation: Callable[..., Scalars], *args: Scalars) -> Scalars:
        """Return operation(factor, its own arguments) for all factors, one after the other."""
        rows = zip(self.factors, *map(self.parts, args), strict=True)
        return tuple(x for factor, *own in rows for x in operation(factor, *own))

    def identity(self, d: Domain) -> Scalars:
        """Return the neutral elements."""
        return self._each(lambda f: f.identity(d))

    def exp(self, d: Domain, x: Scalars) -> Scalars:
        """Return the exponentials."""
        return self._each(lambda f, a: f.exp(d, a), x)

    def mul(self, d: Domain, g: Scalars, k: Scalars) -> Scalars:
        """Return the products."""
        return self._each(lambda f, a, b: f.mul(d, a, b), g, k)

    def ad(self, d: Domain, x: Scalars, y: Scalars) -> Scalars:
        """Return the brackets."""
        return self._each(lambda f, a, b: f.ad(d, a, b), x, y)

    def adt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return ad*_x mu of each factor."""
        return self._each(lambda f, a, m: f.adt(d, a, m), x, mu)

    def Ad(self, d: Domain, g: Scalars, x: Scalars) -> Scalars:
        """Return Ad_g x of each factor."""
        return self._each(lambda f, a, b: f.Ad(d, a, b), g, x)

    def Adt(self, d: Domain, g: Scalars, mu: Scalars) -> Scalars:
        """Return Ad*_g mu of each factor."""
        return self._each(lambda f, a, m: f.Adt(d, a, m), g, mu)

    def Adtinv(self, d: Domain, g: Scalars, mu: Scalars) -> Scalars:
        """Return Ad*_{g^-1} mu of each factor."""
        return self._each(lambda f, a, m: f.Adtinv(d, a, m), g, mu)

    def dexpt(self, d: Domain, x: Scalars, mu: Scalars) -> Scalars:
        """Return dexp*_x mu of each factor."""
        return self._each(lambda f, a, m: f.dexpt(d, a, m), x, mu)

    def velocity(self, d: Domain, x: Scalars, g: Scalars) -> Scalars:
        """Return x.g of each factor."""
        return self._each(lambda f, a, b: f.velocity(d, a, b), x, g)

    def rate(self, d: Domain, v: Scalars, g: Scalars) -> Scalars:
        """Return x where v = x.g, of each factor."""
        return self._each(lambda f, a, b: f.rate(d, a, b), v, g)

    def laws(self, d: Domain, g: Scalars) -> tuple[tuple[str, Any], ...]:
        """Return the laws of every factor."""
        pairs = zip(self.factors, self.parts(g), strict=True)
        return tuple(law for f, a in pairs for law in f.laws(d, a))

    def symbols(self, name: str) -> list[Any]:
        """Return the factors' symbols: ``name``, a letter for the factor, and its own indices."""
        letters = (chr(ord("a") + k) for k in range(len(self.factors)))
        return [s for f, letter in zip(self.factors, letters, strict=True) for s in f.symbols(name + letter)]

    def point(self, name: str) -> Any:
        """Return a sympy column of symbols for an element; :meth:`parts` cuts it by factor."""
        from sympy import Matrix

        return Matrix(self.symbols(name))
