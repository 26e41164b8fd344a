"""The base class of Lie groups: the operations that every group has.

An element of the group is a flat tuple of ``size`` scalars. An element of the Lie algebra or of its dual is a
flat tuple of ``dim`` scalars. The scalars are called coordinates. Groups act from the left, tangent vectors
are right-trivialised, and the bracket of matrices is [A, B] = AB - BA (see :mod:`orderconds`).

The first argument d of each operation is a domain: it defines the type of the scalars and the functions of
scalars (:mod:`codegen.ir.domain`). An operation uses only ``+ - * /`` on the scalars, constants from
``d.rational(p, q)`` and functions from ``d.call``.

To define a group, inherit :class:`LieGroup` and write its five abstract methods. A group may have additional
operations, the capabilities (:mod:`codegen.groups.capabilities`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, TypeVar

from codegen.errors import SceneError
from codegen.groups.bernoulli import bernoulli_sum
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain

if TYPE_CHECKING:
    import sympy

C = TypeVar("C", bound="LieGroup")


class LieGroup(ABC):
    """A Lie group in coordinates.

    - ``name`` is printed in messages and in the headers of emitted code.
    - ``dim`` is the dimension of the algebra.
    - ``size`` is the number of coordinates of an element.
    - If ``abelian`` is true, all brackets vanish.
    - ``layout`` describes the order of the coordinates. In emitted code, this text follows the name of the
      group, so it begins with a comma or a colon.
    """

    name: str
    dim: int
    size: int
    abelian: bool = False
    layout: str = ""
    coordinates: ClassVar[str] = "coordinates"
    """A noun for the coordinates of an element, such as ``unit quaternion``."""
    provides: ClassVar[str] = "group operations"
    """Error messages use this name for the operations of the class, for example ``coadjoint action``."""

    @property
    def blocks(self) -> tuple[tuple[int, int], ...]:
        """The blocks of coordinates that can have units of their own, in order.

        Each block is a pair (number of coordinates in the algebra, number of coordinates of an element). For
        example, the blocks of SE(3) are (3, 9) for rotations and (3, 3) for translations.
        """
        return ((self.dim, self.size),)

    @abstractmethod
    def identity(self, d: Domain) -> Vector[S]:
        """Return the neutral element e as ``size`` scalars. For all g, e g = g e = g."""

    @abstractmethod
    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return the product g k of two elements."""

    @abstractmethod
    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return exp(x) for x in the algebra. The map satisfies exp(0) = e and exp(s x) exp(t x) = exp((s +
        t) x).

        The formula must be valid at x = 0. For example, use stumpff1(r^2) instead of sin(r)/r.
        """

    @abstractmethod
    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the bracket [x, y].

        The product exp(h x) exp(h y) exp(-h x) exp(-h y) must be equal to exp(h^2 [x, y] + O(h^3)). This
        equation determines the sign of the bracket.
        """

    @abstractmethod
    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return x.g, the derivative of exp(eps x) g at eps = 0, in the coordinates of g."""

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of the group as pairs (name, residual).

        If g is an element of the group, all residuals are zero.
        """
        return ()

    def dexpinv(self, d: Domain, x: Vector[S], y: Vector[S], order: int) -> Vector[S]:
        """Return the truncated series of dexp^{-1}_x y: the sum of B_k/k! ad_x^k y for k = 0, ..., order.

        B_k are the Bernoulli numbers with B_1 = -1/2.
        """
        return bernoulli_sum(d, lambda power: self.ad(d, x, power), y, order)

    def expbasis(self, d: Domain, k: int, t: S) -> Vector[S]:
        """Return exp(t e_k), where e_k is the basis element of the algebra with index k.

        A subclass can override this method by a formula that is shorter than :meth:`exp`.
        """
        zero: S = d.rational(0)
        return self.exp(d, tuple(t if i == k else zero for i in range(self.dim)))

    def expmul(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return exp(x) g."""
        return self.mul(d, self.exp(d, x), g)

    def variants(self) -> Sequence[LieGroup]:
        """Return implementations of this group that differ only in :meth:`expmul`.

        The compiler compiles a step with each implementation, and chooses the step with the shortest
        estimated time.
        """
        return (self,)

    def offers(self, capability: type[C]) -> C | None:
        """Return this group if it has the operations of the class ``capability``. Otherwise return None."""
        return self if isinstance(self, capability) else None

    def require(self, capability: type[C], where: str = "") -> C:
        """Return this group if it has the operations of the class ``capability``. Otherwise raise
        :class:`SceneError`.
        """
        offered = self.offers(capability)
        if offered is None:
            raise SceneError(
                f"{self.name} has no {capability.provides}",
                where=where,
                expected=f"a group with the capability {capability.__name__}",
                hint=f"inherit {capability.__module__}.{capability.__name__} and write its methods",
            )
        return offered

    def symbols(self, name: str) -> list[sympy.Symbol]:
        """Return sympy symbols of the coordinates of an element: ``name`` followed by an index."""
        from sympy import Symbol

        return [Symbol(f"{name}{i}", real=True) for i in range(self.size)]

    def point(self, name: str) -> sympy.Matrix:
        """Return the symbols of an element (:meth:`symbols`) as a sympy column."""
        from sympy import Matrix

        return Matrix(self.symbols(name))

    def dual(self, name: str) -> sympy.Matrix:
        """Return a covector as a sympy column of ``dim`` symbols.

        Each symbol is ``name`` followed by an index from 0.
        """
        from sympy import Matrix, Symbol

        return Matrix([Symbol(f"{name}{i}", real=True) for i in range(self.dim)])
