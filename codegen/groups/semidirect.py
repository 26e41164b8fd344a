"""Semidirect products of a group G with a vector space on which G acts.

The group G is called the linear factor.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.base import C, LieGroup
from codegen.groups.capabilities import (
    BodyFrame,
    CayleyMap,
    ClosedFormSeries,
    Coadjoint,
    Covered,
    Inverse,
    LeftTranslation,
    MatrixRepresentation,
    PointMotions,
    Projection,
    RightTrivialisation,
    Term,
)
from codegen.groups.construction import check_factor
from codegen.groups.cubic_ad import DEXP
from codegen.groups.linear_algebra import S, Vector, vector_difference, vector_sum
from codegen.groups.representations import Pair, Representation
from codegen.ir.ad_series import Factor
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation

if TYPE_CHECKING:
    import sympy


class Semidirect(
    ClosedFormSeries,
    BodyFrame,
    RightTrivialisation,
    Projection,
    PointMotions,
    MatrixRepresentation,
    Covered,
    Inverse,
    CayleyMap,
):
    """The semidirect product of a group G and a vector space V. G acts on V and is called the linear factor.

    The argument ``representation`` is the representation rho of G on V. V consists of one or more copies of
    one space. An element is (g, a): the coordinates of g in G, followed by the components of a, copy by copy.
    For x in the algebra of G and z in V, the action x.z is the derivative of rho(exp(eps x)) z at eps = 0.

    - The product is (g, a)(k, b) = (g k, a + rho(g) b).
    - The element (g, a) maps the point z of V to rho(g) z + a.
    - An element (x, u) of the algebra moves the point z with the velocity x.z + u.
    - The bracket is [(x, u), (y, v)] = ([x, y], x.v - y.u).
    - The exponential is exp(x, u) = (exp x, phi(x) u). Here phi(x) is the sum of X^k/(k+1)! over k >= 0, and
      X is the linear map v -> x.v.
    - Let v be in V, and p in the dual space of V. The momentum map J is defined by <J(v, p), x> = <p, x.v>
      for all x in the algebra of G.
    """

    covering_formula = (
        "the covering map of the linear factor, applied to the first coordinates of q; the other coordinates "
        "are copied"
    )

    def __init__(self, linear: LieGroup, representation: Representation, name: str = "") -> None:
        check_factor("a semidirect product", linear)
        if not isinstance(representation, Representation):
            raise SceneError(
                f"{representation!r} is not a representation of {linear.name}",
                expected="an object of codegen.groups.representations, such as MatrixColumns()",
            )
        linear.require(representation.needs)
        self.linear, self.representation = linear.require(Coadjoint), representation
        self.width = representation.dim(linear)
        self.point_size = self.width * representation.copies
        self.name = name or f"{linear.name} |x R^{self.point_size}"
        self.layout = f": {linear.name}{linear.layout}; {self.point_size} components of a vector"
        self.dim, self.size = linear.dim + self.point_size, linear.size + self.point_size
        self.abelian = False

    @property
    def blocks(self) -> tuple[tuple[int, int], ...]:
        """The blocks of coordinates (:attr:`LieGroup.blocks`) of the product of a group G and V = W^m.

        The blocks of G come first, followed by m blocks, one for each copy of the vector space W.
        """
        return (*self.linear.blocks, *((self.width, self.width),) * self.representation.copies)

    def _split(self, x: Vector[S]) -> Pair[S]:
        """Split an element x = (y, u) of the algebra, or of its dual, into y and the vector u."""
        return tuple(x[: self.linear.dim]), tuple(x[self.linear.dim :])

    def _element(self, g: Vector[S]) -> Pair[S]:
        """Split g = (q, a) into the element q of the linear factor and the vector a."""
        return tuple(g[: self.linear.size]), tuple(g[self.linear.size :])

    def _copies(self, v: Vector[S]) -> Iterator[Vector[S]]:
        """Split v into one tuple for each copy of the space (see :class:`Semidirect`)."""
        return (tuple(v[i : i + self.width]) for i in range(0, len(v), self.width))

    def _each(self, operation: Callable[..., Vector[S]], *vectors: Vector[S]) -> Vector[S]:
        rows = zip(*map(self._copies, vectors), strict=True)
        return tuple(chain.from_iterable(operation(*row) for row in rows))

    def offers(self, capability: type[C]) -> C | None:
        """Return this product if it has the operations of the class ``capability``. Otherwise return None.

        Coadjoint, PointMotions, ClosedFormSeries and MatrixRepresentation have special rules. For every other
        class, the result is None if the linear factor (see :class:`Semidirect`) lacks the operations.
        """
        own = super().offers(capability)
        if own is None or issubclass(Coadjoint, capability) or issubclass(PointMotions, capability):
            return own
        if issubclass(capability, ClosedFormSeries):
            return own if self.representation.closed(self.linear) else None
        if issubclass(capability, MatrixRepresentation):
            return own if self.representation.of_matrices(self.linear) is not None else None
        if issubclass(capability, CayleyMap) and self.representation.of_matrices(self.linear) is None:
            return None
        if issubclass(capability, Covered) and not self.representation.of_algebra:
            return None
        return own if self.linear.offers(capability) is not None else None

    def variants(self) -> Sequence[Semidirect]:
        """Return one semidirect product for each group in ``self.linear.variants()``."""
        return tuple(self.with_linear(variant) for variant in self.linear.variants())

    def with_linear(self, linear: LieGroup) -> Semidirect:
        """Return this product with ``linear`` as its linear factor."""
        return Semidirect(linear, self.representation, self.name)

    def identity(self, d: Domain) -> Vector[S]:
        """Return (e, 0), where e is the identity of the linear factor."""
        zeros: Vector[S] = (d.rational(0),) * self.point_size
        return self.linear.identity(d) + zeros

    def mul(self, d: Domain, g: Vector[S], k: Vector[S]) -> Vector[S]:
        """Return the product g k = (q r, a + rho(q) b) for g = (q, a) and k = (r, b)."""
        (q, a), (r, b) = self._element(g), self._element(k)
        moved = self._each(lambda v: self.representation.act(d, self.linear, q, v), b)
        return self.linear.mul(d, q, r) + vector_sum(a, moved)

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (q^-1, -rho(q^-1) a) for g = (q, a), with the representation rho."""
        q, a = self._element(g)
        moved = self._each(lambda v: self.representation.inverse(d, self.linear, q, v), a)
        return self.linear.require(Inverse).inverse(d, q) + tuple(-x for x in moved)

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the exponential (exp y, phi(y) u) of x = (y, u).

        Here phi(y) is the sum of Y^k/(k+1)! over k >= 0. The linear map Y maps v to y.v, the action of y on v
        (see :class:`Semidirect`).
        """
        y, u = self._split(x)
        moved = self._each(lambda v: self.representation.translation(d, self.linear, y, v), u)
        return self.linear.exp(d, y) + moved

    def expmul(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the product exp(x) g for x = (y, u) and g = (q, a).

        The product is (exp(y) q, rho(exp y) a + phi(y) u). Here rho is the representation, and phi(y) is
        defined in :meth:`exp`.
        """
        q, y = self._element(g)[0], self._split(x)[0]
        # The call expmul(y, q) can need fewer operations than mul(exp(y), q), which has the same result.
        return self.linear.expmul(d, y, q) + self.move(d, self.exp(d, x), self._element(g)[1])

    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return cay(x) = (cay y, (1 - Y/2)^-1 u) for x = (y, u). Here Y is the linear map v -> y.v.

        Let C = rho(cay y) for the representation rho. Then (1 - Y/2)^-1 u = (u + C u)/2.
        """
        y, u = self._split(x)
        half: S = d.rational(1, 2)
        g = self.linear.require(CayleyMap).cay(d, y)
        turned = self._each(lambda v: self.representation.act(d, self.linear, g, v), u)
        return g + tuple(half * a for a in vector_sum(u, turned))

    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y for x = (a, u) and y = (b, v).

        The result is (dcay^{-1}_a b, v - (a.v - b.u)/2 - a.(b.u)/4), where a.v is the action of a on v.
        """
        (a, u), (b, v) = self._split(x), self._split(y)
        first = self.point_velocity(d, y, u, translated=False)
        # The formula of the docstring has a common subexpression, which is computed first.
        half: S = d.rational(1, 2)
        moved = vector_sum(v, tuple(half * c for c in first))
        turned = self.point_velocity(d, x, moved, translated=False)
        tail = vector_difference(moved, tuple(half * c for c in turned))
        return self.linear.require(CayleyMap).dcayinv(d, a, b) + tail

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the matrix product x y x of two elements x and y of the Lie algebra.

        As a matrix, x = (a, u) has the upper rows (a, u), and its last row is zero. For y = (b, v), the
        product is (a b a, a b u).
        """
        (a, u), b = self._split(x), self._split(y)[0]
        inner = self.point_velocity(d, y, u, translated=False)
        tail = self.point_velocity(d, x, inner, translated=False)
        return self.linear.require(CayleyMap).sandwich(d, a, b) + tail

    def mulexp(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return the product g exp(x) for g = (q, a) and x = (y, u).

        The product is (q exp y, a + rho(q) phi(y) u). Here rho is the representation, and phi(y) is defined
        in :meth:`exp`.
        """
        (q, a), (y, u) = self._element(g), self._split(x)
        moved = self._each(lambda v: self.representation.translation(d, self.linear, y, v), u)
        ahead = self._each(lambda v: self.representation.act(d, self.linear, q, v), moved)
        return self.linear.require(BodyFrame).mulexp(d, q, y) + vector_sum(a, ahead)

    def ad(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return [x, y] for x = (a, u) and y = (b, v).

        The result is ([a, b], a.v - b.u), where a.v is the action of a on v.
        """
        (a, u), (b, v) = self._split(x), self._split(y)
        turned = self._each(lambda p, q: self._difference(d, a, q, b, p), u, v)
        return self.linear.ad(d, a, b) + turned

    def _difference(self, d: Domain, a: Vector[S], v: Vector[S], b: Vector[S], u: Vector[S]) -> Vector[S]:
        """Return a.v - b.u, where a.v is the action of a on v."""
        velocity = self.representation.velocity
        pairs = zip(velocity(d, self.linear, a, v), velocity(d, self.linear, b, u), strict=True)
        return tuple(p - q for p, q in pairs)

    def _momentum(self, d: Domain, v: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return the momentum map J(v, p), defined by <J(v, p), x> = <p, x.v> for all x."""
        parts = zip(self._copies(v), self._copies(p), strict=True)
        return vector_sum(*(self.representation.momentum(d, self.linear, a, b) for a, b in parts))

    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return ad*_x mu = (ad*_y m - J(u, p), Y^T p) for x = (y, u) and mu = (m, p).

        Here Y is the linear map v -> y.v. The momentum map J satisfies <J(u, p), z> = <p, z.u> for all z.
        """
        (y, u), (m, p) = self._split(x), self._split(mu)
        turned = self._each(lambda a: self.representation.dual_velocity(d, self.linear, y, a), p)
        return vector_difference(self.linear.adt(d, y, m), self._momentum(d, u, p)) + turned

    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_g x for g = (q, a) and x = (y, u).

        Let z = Ad_q y, let rho be the representation, and let z.a be the action of z on a. The result is
        (z, rho(q) u - z.a).
        """
        (q, a), (y, u) = self._element(g), self._split(x)
        turned = self.linear.Ad(d, q, y)
        moved = self._each(lambda v: self.representation.act(d, self.linear, q, v), u)
        return turned + vector_difference(moved, self.point_velocity(d, turned, a, translated=False))

    def Adinv(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_{g^-1} x for g = (q, a) and x = (y, u).

        Let rho be the representation, and let y.a be the action of y on a. The result is
        (Ad_{q^-1} y, rho(q)^-1 (u + y.a)).
        """
        (q, a), (y, _) = self._element(g), self._split(x)
        back = self.linear.require(LeftTranslation).Adinv(d, q, y)
        velocity = self.point_velocity(d, x, a)
        return back + self._each(lambda v: self.representation.inverse(d, self.linear, q, v), velocity)

    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_g mu = (Ad*_q (m - J(a, p)), rho(q)^T p) for g = (q, a) and mu = (m, p).

        Here J is the momentum map, and rho is the representation.
        """
        (q, a), (m, p) = self._element(g), self._split(mu)
        central = vector_difference(m, self._momentum(d, a, p))
        turned = self._each(lambda v: self.representation.dual(d, self.linear, q, v), p)
        return self.linear.Adt(d, q, central) + turned

    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} mu for g = (q, a) and mu = (m, p).

        Let rho be the representation, J the momentum map, and r = rho(q)^-T p. The result is
        (Ad*_{q^-1} m + J(a, r), r).
        """
        (q, a), (m, p) = self._element(g), self._split(mu)
        turned = self._each(lambda v: self.representation.dual_inverse(d, self.linear, q, v), p)
        return vector_sum(self.linear.Adtinv(d, q, m), self._momentum(d, a, turned)) + turned

    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu for x = (y, u) and mu = (m, p).

        The vector t = t(y, u) is defined by exp(x) = (exp y, t). The momentum map J of the representation is
        defined in :class:`Semidirect`. Let D_y and D_u be the partial derivatives of <p, t(y, u)> with
        respect to y and u for fixed p. The result is (dexp*_y (m - J(t, p)) + D_y, D_u).
        """
        if self.representation.closed(self.linear):
            return self.series(d, DEXP, True, x, mu)
        (y, u), (m, p) = self._split(x), self._split(mu)
        moved = self._each(lambda v: self.representation.translation(d, self.linear, y, v), u)
        pairs = zip(self._copies(u), self._copies(p), strict=True)
        slopes = [self.representation.gradient(d, self.linear, y, a, b) for a, b in pairs]
        central = self.linear.dexpt(d, y, vector_difference(m, self._momentum(d, moved, p)))
        return vector_sum(central, *(first for first, _ in slopes)) + tuple(
            q for _, part in slopes for q in part
        )

    def series(self, d: Domain, word: Sequence[Factor], dual: bool, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return W(ad_x) v, or W(ad*_x) v if ``dual`` is true.

        The function W(t) is the product of the factors in ``word``.
        """
        rule = self.representation.dual_series if dual else self.representation.series
        (y, u), (w, vectors) = self._split(x), self._split(v)
        none: Vector[S] = tuple(d.rational(0) for _ in w)
        ends: list[Vector[S]] = []
        first = none
        for k, (a, b) in enumerate(zip(self._copies(u), self._copies(vectors), strict=True)):
            own = none if dual and k else w
            head, tail = rule(d, self.linear, word, (y, a), (own, b))
            first = vector_sum(first, head) if dual else head
            ends.append(tail)
        return first + tuple(chain.from_iterable(ends))

    def series_sum(
        self,
        d: Domain,
        terms: Sequence[Term[S]],
        dual: bool,
        x: Vector[S],
        total: Callable[[tuple[int, ...]], Vector[S]] | None = None,
    ) -> Vector[S]:
        """Return the sum of f W(ad_x) v over the triples (f, W, v) in ``terms``.

        Here f is a scalar, and W is a product of factors (see :meth:`series`). If ``dual`` is true, ad*_x
        replaces ad_x. The argument ``total`` has no effect in this class.
        """
        values = [self.series(d, word, dual, x, tuple(f * a for a in v)) for f, word, v in terms]
        return vector_sum(*values)

    def velocity(self, d: Domain, x: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the velocity x.g = (y.q, y.a + u) for x = (y, u) and g = (q, a).

        Here y.q is the derivative of exp(eps y) q at eps = 0, and y.a is the action of y on the vector a.
        """
        q, a = self._element(g)
        return self.linear.velocity(d, self._split(x)[0], q) + self.point_velocity(d, x, a)

    def left_velocity(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return the velocity g.x = (q.y, rho(q) u) for g = (q, a) and x = (y, u).

        Here q.y is the derivative of q exp(eps y) at eps = 0, and rho is the representation.
        """
        q, (y, u) = self._element(g)[0], self._split(x)
        turned = self._each(lambda v: self.representation.act(d, self.linear, q, v), u)
        return self.linear.require(LeftTranslation).left_velocity(d, q, y) + turned

    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the element of the algebra whose velocity at g = (q, a) is v (see :meth:`velocity`).

        For v = (x.q, w), the element is (x, w - x.a). Here x.q is the derivative of exp(eps x) q at eps = 0,
        and x.a is the action of x on the vector a.
        """
        (q, a), (first, w) = self._element(g), self._element(v)
        x = self.linear.require(RightTrivialisation).rate(d, first, q)
        return x + vector_difference(w, self.point_velocity(d, x, a, translated=False))

    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return ``self.linear.relations(r)`` for q = (r, a) (see :meth:`LeftTranslation.relations`)."""
        return self.linear.require(LeftTranslation).relations(q[: self.linear.size])

    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return (p, a) for g = (q, a), where p is the projection of q onto the linear factor."""
        q, a = self._element(g)
        return self.linear.require(Projection).project(d, q) + a

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Let g = (q, a). Return a pair (name, residual) for each equation that the elements q of the linear
        factor satisfy. The vector a satisfies no equations.
        """
        return self.linear.laws(d, self._element(g)[0])

    def move(self, d: Domain, g: Vector[S], z: Vector[S]) -> Vector[S]:
        """Return the image rho(q) z + a of the point z under g = (q, a), with the representation rho."""
        q, a = self._element(g)
        return vector_sum(self._each(lambda v: self.representation.act(d, self.linear, q, v), z), a)

    def point_velocity(self, d: Domain, x: Vector[S], z: Vector[S], *, translated: bool = True) -> Vector[S]:
        """Return the velocity y.z + u of the point z for x = (y, u), or y.z if ``translated`` is false."""
        y, u = self._split(x)
        turned = self._each(lambda v: self.representation.velocity(d, self.linear, y, v), z)
        return vector_sum(turned, u) if translated else turned

    @property
    def order(self) -> int:
        """The number of rows and columns of the matrices from :meth:`matrix`."""
        return self.width + self.representation.copies

    def matrix(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the matrix [[R, A], [0, I]] for g = (q, a). R is the matrix of q, and I is a unit matrix.

        The vector a consists of the columns of A, one after the other.
        """
        q, a = self._element(g)
        return self._bordered(d, self._matrices().matrix(d, q), a, d.rational(1))

    def hat(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the matrix [[Y, U], [0, 0]] for x = (y, u), where Y is the matrix of y.

        The vector u consists of the columns of U, one after the other.
        """
        y, u = self._split(x)
        return self._bordered(d, self._matrices().hat(d, y), u, d.rational(0))

    def element(self, matrix: Vector[S]) -> Vector[S]:
        """Return the coordinates of the element with the given matrix (see :meth:`matrix`)."""
        block, a = self._blocks(matrix)
        return self._matrices().element(block) + a

    def vee(self, d: Domain, matrix: Vector[S]) -> Vector[S]:
        """Return the coordinates of the element of the algebra with the given matrix (see :meth:`hat`)."""
        block, u = self._blocks(matrix)
        return self._matrices().vee(d, block) + u

    def _matrices(self) -> MatrixRepresentation:
        return self.linear.require(MatrixRepresentation)

    def _bordered(self, d: Domain, block: Vector[S], a: Vector[S], one: S) -> Vector[S]:
        n, k, zero = self.width, self.representation.copies, d.rational(0)
        columns = list(self._copies(a))
        rows = [(*block[n * i : n * i + n], *(c[i] for c in columns)) for i in range(n)]
        rows += [(*(zero,) * n, *(one if i == j else zero for j in range(k))) for i in range(k)]
        return tuple(chain.from_iterable(rows))

    def _blocks(self, matrix: Vector[S]) -> Pair[S]:
        n, size = self.width, self.order
        block = tuple(matrix[size * i + j] for i in range(n) for j in range(n))
        return block, tuple(matrix[size * i + n + k] for k in range(size - n) for i in range(n))

    @property
    def cover(self) -> LeftTranslation:
        """The covering group: the semidirect product of the cover of G and the vector space V."""
        return Semidirect(self._covered().cover, self.representation)

    def _covered(self) -> Covered:
        return self.linear.require(Covered)

    def _over(self, q: Vector[S]) -> Pair[S]:
        """Split the element q = (r, a) of the covering group into r and the vector a."""
        size = self._covered().cover.size
        return tuple(q[:size]), tuple(q[size:])

    def covering(self, d: Domain, q: Vector[S]) -> Vector[S]:
        """Return the image of q under the covering map from the group :attr:`cover` to this group."""
        g, a = self._over(q)
        return self._covered().covering(d, g) + a

    def projected_covering(self, d: Domain, q: Vector[S]) -> Vector[S]:
        """Return the image of q = (r, a) under the covering map. The coordinates r may contain small errors,
        so r is first projected onto the covering group of the linear factor.
        """
        g, a = self._over(q)
        return self._covered().projected_covering(d, g) + a

    def lifted_velocity(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return z with dp(z) = x for the covering map p (see :meth:`Covered.lifted_velocity`)."""
        y, u = self._split(x)
        return self._covered().lifted_velocity(d, y) + u

    def pivots(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """For g = (q, a), return the pivots of q (see :meth:`Covered.pivots`)."""
        return self._covered().pivots(d, self._element(g)[0])

    def lift(self, d: Domain, g: Vector[S], formula: int) -> Vector[S]:
        """Return an element (r, a) of the covering group whose image under :meth:`covering` is g = (q, a).

        ``formula`` is the index of the formula that computes r.
        """
        q, a = self._element(g)
        return self._covered().lift(d, q, formula) + a

    def symbols(self, name: str) -> list[sympy.Symbol]:
        """Return the symbols of the linear factor, followed by the symbols of the vector.

        The symbols of the vector are ``name`` followed by an index. If the linear factor uses one of these
        symbols, the letter v is inserted before the index in every symbol of the vector.
        """
        from sympy import Symbol

        own = self.linear.symbols(name)
        plain = {f"{name}{i}" for i in range(self.point_size)}
        letter = "v" if any(s.name in plain for s in own) else ""
        return [*own, *(Symbol(f"{name}{letter}{i}", real=True) for i in range(self.point_size))]
