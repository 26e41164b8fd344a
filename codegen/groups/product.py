"""Direct products of groups."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import accumulate, islice, product
from string import ascii_lowercase
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.base import C, LieGroup
from codegen.groups.capabilities import (
    CayleyMap,
    Coadjoint,
    DirectProduct,
    Inverse,
    LeftTranslation,
    Projection,
    RightTrivialisation,
)
from codegen.groups.construction import check_factor
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation

if TYPE_CHECKING:
    import sympy


class Product(DirectProduct, LeftTranslation, RightTrivialisation, Projection, Inverse, CayleyMap):
    """The direct product G1 x G2 x ... of groups. An element lists the coordinates of the factors one after
    the other.

    The product has a capability, for example :class:`CayleyMap`, only if all factors have this capability.
    """

    def __init__(self, *factors: LieGroup) -> None:
        if not factors:
            raise SceneError("the product has no factors", expected="at least one group")
        for factor in factors:
            check_factor("a product", factor)
        self.factors = factors
        self.name = " x ".join(f.name for f in factors)
        self.dim, self.size = sum(f.dim for f in factors), sum(f.size for f in factors)
        self.abelian = all(f.abelian for f in factors)
        self.layout = ": " + "; ".join(f.name + f.layout for f in factors)

    @property
    def blocks(self) -> tuple[tuple[int, int], ...]:
        """The blocks of the factors (:attr:`LieGroup.blocks`)."""
        return tuple(block for factor in self.factors for block in factor.blocks)

    def parts(self, x: Vector[S]) -> tuple[Vector[S], ...]:
        """Split x into one tuple of coordinates for each factor.

        The argument x is a group element, or an element of the algebra or its dual.
        """
        sizes = [f.size if len(x) == self.size else f.dim for f in self.factors]
        pairs = zip(accumulate(sizes), sizes, strict=True)
        return tuple(tuple(x[end - n : end]) for end, n in pairs)

    def offers(self, capability: type[C]) -> C | None:
        """Return this product if the product and all factors have the operations of ``capability``.
        Otherwise return None.
        """
        own = super().offers(capability)
        # Every product offers DirectProduct, although the factors, for example SO(3), may lack DirectProduct.
        if issubclass(DirectProduct, capability):
            return own
        return own if all(f.offers(capability) is not None for f in self.factors) else None

    def _each(self, capability: type[C], operation: Callable[..., Vector[S]], *args: Vector[S]) -> Vector[S]:
        """Apply ``operation`` to ``args`` factor by factor, and join the results to one tuple."""
        rows = zip((f.require(capability) for f in self.factors), *map(self.parts, args), strict=True)
        return tuple(x for factor, *own in rows for x in operation(factor, *own))

    def identity(self, d: Domain) -> Vector[S]:
        """Return the neutral elements of all factors as one tuple."""
        return self._each(LieGroup, lambda f: f.identity(d))

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return exp(x), factor by factor."""
        return self._each(LieGroup, lambda f, a: f.exp(d, a), x)

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return g k, factor by factor."""
        return self._each(LieGroup, lambda f, a, b: f.mul(d, a, b), g, k)

    def expmul(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return exp(x) g, factor by factor."""
        return self._each(LieGroup, lambda f, a, b: f.expmul(d, a, b), x, g)

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return [x, y], factor by factor."""
        return self._each(LieGroup, lambda f, a, b: f.ad(d, a, b), x, y)

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the derivative of exp(eps x) g at eps = 0, factor by factor."""
        return self._each(LieGroup, lambda f, a, b: f.velocity(d, a, b), x, g)

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return ad*_x mu, factor by factor."""
        return self._each(Coadjoint, lambda f, a, m: f.adt(d, a, m), x, mu)

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_g x, factor by factor."""
        return self._each(Coadjoint, lambda f, a, b: f.Ad(d, a, b), g, x)

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_g mu, factor by factor."""
        return self._each(Coadjoint, lambda f, a, m: f.Adt(d, a, m), g, mu)

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} mu, factor by factor."""
        return self._each(Coadjoint, lambda f, a, m: f.Adtinv(d, a, m), g, mu)

    def Adinv(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_{g^-1} x, factor by factor."""
        return self._each(LeftTranslation, lambda f, a, b: f.Adinv(d, a, b), g, x)

    def left_velocity(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return the derivative of g exp(eps x) at eps = 0, factor by factor."""
        return self._each(LeftTranslation, lambda f, a, b: f.left_velocity(d, a, b), g, x)

    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return the replacement rules of all factors (see :meth:`LeftTranslation.relations`)."""
        ends = accumulate(f.size for f in self.factors)
        return tuple(
            relation
            for f, end in zip(self.factors, ends, strict=True)
            for relation in f.require(LeftTranslation).relations(q[end - f.size : end])
        )

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu, factor by factor."""
        return self._each(Coadjoint, lambda f, a, m: f.dexpt(d, a, m), x, mu)

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the projection of g onto the group, factor by factor."""
        return self._each(Projection, lambda f, a: f.project(d, a), g)

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return g^-1, factor by factor."""
        return self._each(Inverse, lambda f, a: f.inverse(d, a), g)

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return cay(x), factor by factor."""
        return self._each(CayleyMap, lambda f, a: f.cay(d, a), x)

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y, factor by factor."""
        return self._each(CayleyMap, lambda f, a, b: f.dcayinv(d, a, b), x, y)

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return x y x, factor by factor."""
        return self._each(CayleyMap, lambda f, a, b: f.sandwich(d, a, b), x, y)

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the element x of the algebra with velocity(x, g) = v."""
        return self._each(RightTrivialisation, lambda f, a, b: f.rate(d, a, b), v, g)

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of all factors (see :meth:`LieGroup.laws`)."""
        pairs = zip(self.factors, self.parts(g), strict=True)
        return tuple(law for f, a in pairs for law in f.laws(d, a))

    def symbols(self, name: str) -> list[sympy.Symbol]:
        """Return the symbols of all factors.

        The symbols of a factor begin with ``name`` and the label of the factor (see :func:`labels`).
        """
        pairs = zip(self.factors, labels(len(self.factors)), strict=True)
        return [s for f, label in pairs for s in f.symbols(name + label)]


def labels(count: int) -> Iterator[str]:
    """Yield labels of equal length for the factors: a to z for up to 26 factors, then aa to zz, and so on.

    With labels of different lengths, two coordinates of nested products could have the same name.

    >>> list(labels(3)), list(labels(28))[-3:]
    (['a', 'b', 'c'], ['az', 'ba', 'bb'])
    """
    length = 1
    while len(ascii_lowercase) ** length < count:
        length += 1
    return islice(map("".join, product(ascii_lowercase, repeat=length)), count)
