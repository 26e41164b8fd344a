"""Capabilities: additional operations that only some groups have.

A group declares a capability by inheriting the class of the capability. If the group lacks the capability,
``group.offers(Capability)`` returns None, and ``group.require(Capability)`` raises an error. Do not test
capabilities with ``isinstance``, because the answer can be wrong for direct products.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from fractions import Fraction
from math import isqrt
from typing import TYPE_CHECKING, ClassVar

from codegen.groups.base import LieGroup
from codegen.groups.bernoulli import bernoulli_over_factorial, bernoulli_sum, last_term
from codegen.groups.linear_algebra import S, Vector, invert, matvec
from codegen.ir.ad_series import Factor
from codegen.ir.domain import Domain
from codegen.ir.normal_form import Relation

if TYPE_CHECKING:
    import sympy

Term = tuple[S, Sequence[Factor], Vector[S]]
"""A triple (f, W, v) that represents the term f W(ad_x) v. Here f is a scalar, W is a product of functions of
ad_x, and v is an element of the algebra or of its dual.
"""


class Coadjoint(LieGroup):
    """The adjoint action and the coadjoint action.

    The argument g is an element of the group, x is an element of the algebra, and mu is an element of the
    dual of the algebra. The pairing <mu, x> is the dot product of the coordinates of mu and x.
    """

    provides: ClassVar[str] = "coadjoint action"

    @abstractmethod
    def Ad(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_g x = g x g^-1. The result satisfies g exp(x) = exp(Ad_g x) g."""

    @abstractmethod
    def Adt(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return the covector Ad*_g mu with <Ad*_g mu, x> = <mu, Ad_g x> for all x."""

    @abstractmethod
    def Adtinv(self, d: Domain, g: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} mu. The map Ad*_{g^-1} is the inverse of Ad*_g."""

    @abstractmethod
    def adt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return the covector ad*_x mu with <ad*_x mu, y> = <mu, [x, y]> for all y."""

    @abstractmethod
    def dexpt(self, d: Domain, x: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return dexp*_x mu, the sum of (ad*_x)^k mu/(k+1)! over k >= 0.

        The map dexp*_x is the transpose of dexp_x: <dexp*_x mu, y> = <mu, dexp_x y>.
        """

    def dexpinvt(self, d: Domain, x: Vector[S], mu: Vector[S], order: int) -> Vector[S]:
        """Return the sum of B_k/k! (ad*_x)^k mu for k = 0, ..., order.

        B_k are the Bernoulli numbers with B_1 = -1/2. The map from mu to the sum is the transpose of the
        map from y to dexpinv(x, y, order).
        """
        return bernoulli_sum(d, lambda power: self.adt(d, x, power), mu, order)

    def P(self, d: Domain, x: Vector[S], y: Vector[S], mu: Vector[S], order: int) -> Vector[S]:
        """Return the covector p with <p, v> = <mu, D v> for all v in the algebra.

        The linear map D is the derivative of dexpinv(x, y, order) with respect to x.

        Let B_k be the Bernoulli numbers, and let z(i, k) = ad_x^{k-1-i} y. The covector p is the sum of
        -B_k/k! ad*_{z(i, k)} (ad*_x)^i mu over all i and k with 0 <= i < k <= order (eq. 3.16 of
        H. Marthinsen's thesis).
        """
        last = last_term(order)
        brackets, powers = [y], [mu]
        for _ in range(1, last):
            brackets.append(self.ad(d, x, brackets[-1]))
            powers.append(self.adt(d, x, powers[-1]))
        total: Vector[S] = (d.rational(0),) * self.dim
        for i, power in enumerate(powers):
            terms = [(-bernoulli_over_factorial(k), brackets[k - 1 - i]) for k in range(i + 1, last + 1)]
            subscript = _combination(d, [(c, z) for c, z in terms if c])
            if last and subscript:
                pairs = zip(total, self.adt(d, subscript, power), strict=True)
                total = tuple(a + b for a, b in pairs)
        return total

    def transport(self, d: Domain, x: Vector[S], n: Vector[S], mu: Vector[S]) -> Vector[S]:
        """Return Ad*_{exp(-x)} mu + dexp*_{-x} n.

        The result is the momentum of the product exp(x, n) (q, mu) in the group T*G. This momentum does not
        depend on q.
        """
        turned = self.Adtinv(d, self.exp(d, x), mu)
        pushed = self.dexpt(d, tuple(-a for a in x), n)
        return tuple(a + b for a, b in zip(pushed, turned, strict=True))

    def cotangent_expmul(
        self, d: Domain, x: Vector[S], n: Vector[S], q: Vector[S], mu: Vector[S]
    ) -> Vector[S]:
        """Return the product of exp(x, n) and (q, mu) in the group T*G.

        Here (x, n) is an element of the algebra of T*G, and (q, mu) is an element of T*G.
        """
        return self.expmul(d, x, q) + self.transport(d, x, n, mu)


class RightTrivialisation(LieGroup):
    """A group with the method :meth:`rate`. The Jacobian of a step needs this method."""

    provides: ClassVar[str] = "right trivialisation of tangent vectors"

    @abstractmethod
    def rate(self, d: Domain, v: Vector[S], g: Vector[S]) -> Vector[S]:
        """Return the element x of the algebra with velocity(x, g) = v. Here v is a tangent vector at g."""


class LeftTranslation(Coadjoint):
    """A group with the methods :meth:`relations`, :meth:`left_velocity` and :meth:`Adinv`.

    Scenes with velocities or momenta in the body frame need this capability.
    """

    provides: ClassVar[str] = "left translation of velocities"

    @abstractmethod
    def relations(self, q: Sequence[str]) -> tuple[Relation, ...]:
        """Return the equations of the group as replacement rules.

        Each rule replaces a product of two coordinates by a polynomial. The argument ``q`` contains the names
        of the coordinates of an element.
        """

    @abstractmethod
    def left_velocity(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g.x, the derivative of g exp(eps x) at eps = 0. The result equals velocity(Ad_g x, g)."""

    @abstractmethod
    def Adinv(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return Ad_{g^-1} x. The map Ad_{g^-1} is the inverse of Ad_g."""


class BodyFrame(LeftTranslation):
    """A group with the method :meth:`mulexp`, which computes g exp(x) for an element x of the algebra.

    Integrators in the body frame use this method.
    """

    provides: ClassVar[str] = "body frame"

    @abstractmethod
    def mulexp(self, d: Domain, g: Vector[S], x: Vector[S]) -> Vector[S]:
        """Return g exp(x).

        If g is a matrix, row i of the result depends only on x and on row i of g.
        """


class ClosedFormSeries(Coadjoint):
    """Functions of ad_x in closed form. The functions are products of exp, dexp and dexp^{-1}."""

    provides: ClassVar[str] = "closed form of functions of ad"

    @abstractmethod
    def series(self, d: Domain, word: Sequence[Factor], dual: bool, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return W(ad_x) v, where W is the product of the factors in ``word``. If ``dual`` is true, return
        W(ad*_x) v.
        """

    @abstractmethod
    def series_sum(
        self,
        d: Domain,
        terms: Sequence[Term[S]],
        dual: bool,
        x: Vector[S],
        total: Callable[[tuple[int, ...]], Vector[S]] | None = None,
    ) -> Vector[S]:
        """Return the sum of f W(ad_x) v over the triples (f, W, v) in ``terms``.

        Here f is a number, and W is a product of factors as in :meth:`series`. If ``dual`` is true, ad*_x
        replaces ad_x.

        The series of W begins with 1, so each f W(ad_x) v is f v plus further terms. If the caller knows a
        faster way to compute sums of the vectors f v, the caller may pass a function ``total``. The argument
        of ``total`` is a tuple of indices. ``total`` must return the sum of f v over the triples in ``terms``
        with these indices. The method chooses the indices, and need not call ``total``. If ``total`` is None,
        the method itself adds the vectors f v.
        """


class MatrixRepresentation(LieGroup):
    """A faithful representation of the group by square matrices. A matrix is a tuple of its entries, row by
    row.

    The code for elementary differentials of a vector field uses these matrices.
    """

    provides: ClassVar[str] = "matrix representation"

    @abstractmethod
    def matrix(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the matrix of an element. The map satisfies matrix(g k) = matrix(g) matrix(k)."""

    @abstractmethod
    def element(self, matrix: Vector[S]) -> Vector[S]:
        """Return the coordinates of an element, given its matrix.

        The map from matrices to coordinates must be linear.
        """

    @abstractmethod
    def hat(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the matrix of the algebra element x: the derivative of matrix(exp(eps x)) at eps = 0."""

    @abstractmethod
    def vee(self, d: Domain, matrix: Vector[S]) -> Vector[S]:
        """Return the coordinates of an element of the algebra, given its matrix. The method inverts
        :meth:`hat`.
        """


class Inverse(LieGroup):
    """A group with a method that inverts elements."""

    provides: ClassVar[str] = "inverse of elements"

    @abstractmethod
    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the element g^-1 with g g^-1 = g^-1 g = e."""


class CayleyMap(LieGroup):
    """The Cayley map cay(x) = (1 - x/2)^-1 (1 + x/2) and the inverse of its differential. Here 1 is the
    identity, and x is a matrix or a quaternion.

    For each element x, the algebra must also contain x^3.
    """

    provides: ClassVar[str] = "Cayley map"

    @abstractmethod
    def cay(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return cay(x). The map satisfies cay(0) = e, and the derivative of cay(eps x) at eps = 0 is x."""

    @abstractmethod
    def dcayinv(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dcay^{-1}_x y = (1 - x/2) y (1 + x/2). The expanded product is y - [x, y]/2 - x y x/4.

        If x(t) satisfies x' = dcay^{-1}_x y, then g(t) = cay(x(t)) satisfies g' = y.g, where y.g is
        defined by :meth:`velocity`.
        """

    def sandwich(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return the product x y x = 4 y - 2 [x, y] - 4 dcay^{-1}_x y.

        For small x, this formula loses digits by cancellation.
        """
        terms = zip(y, self.ad(d, x, y), self.dcayinv(d, x, y), strict=True)
        four, two = d.rational(4), d.rational(2)
        return tuple(four * (a - c) - two * b for a, b, c in terms)


class MatrixElements(MatrixRepresentation, Inverse):
    """An element is the tuple of the n^2 entries of an n x n matrix, row by row. This matrix acts on columns
    of n scalars.

    The derivative velocity(x, g) of exp(eps x) g at eps = 0 is the matrix product hat(x) g. Here hat(x) is
    the matrix of x.
    """

    provides: ClassVar[str] = "matrix elements"
    coordinates: ClassVar[str] = "matrix"

    def matrix(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return g."""
        return g

    def element(self, matrix: Vector[S]) -> Vector[S]:
        """Return ``matrix``, because its entries are the coordinates of the element."""
        return matrix

    def exp_times(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y for a column y."""
        return matvec(self.exp(d, x), y)

    @property
    def order(self) -> int:
        """The number n for which the elements are n x n matrices."""
        return isqrt(self.size)

    def inverse(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return the inverse matrix."""
        return invert(d, g, self.order)

    def symbols(self, name: str) -> list[sympy.Symbol]:
        """Return the symbols of the entries: ``name`` followed by the row index and the column index.

        If there are more than ten rows, an underscore separates the two indices.
        """
        from sympy import Symbol

        rows, mark = range(self.order), "_" if self.order > 10 else ""
        return [Symbol(f"{name}{i}{mark}{j}", real=True) for i in rows for j in rows]

    def point(self, name: str) -> sympy.Matrix:
        """Return the symbols of an element (:meth:`symbols`) as a square sympy matrix."""
        from sympy import Matrix

        return Matrix(self.order, self.order, self.symbols(name))


class Covered(LieGroup):
    """The group has a covering group ``cover``.

    The covering map is a homomorphism and a local diffeomorphism. In the text ``covering_formula``, q denotes
    an element of the cover, and g denotes the image of q in the group.
    """

    provides: ClassVar[str] = "covering group"
    covering_formula: ClassVar[str]

    @property
    @abstractmethod
    def cover(self) -> LeftTranslation:
        """The group that covers this group."""

    @abstractmethod
    def covering(self, d: Domain, q: Vector[S]) -> Vector[S]:
        """Return the image of q under the covering map.

        The coordinates q must satisfy the equations of the covering group.
        """

    @abstractmethod
    def projected_covering(self, d: Domain, q: Vector[S]) -> Vector[S]:
        """Project q onto the cover, and return the image of the projected element under the covering map.

        The coordinates q can violate the equations of the cover by small errors.
        """

    @abstractmethod
    def lifted_velocity(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the element y of the cover's Lie algebra with dp(y) = x.

        Here dp is the derivative of the covering map at the neutral element.
        """

    @abstractmethod
    def pivots(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return one number, the pivot, for each formula of :meth:`lift`.

        If the pivot of a formula is positive, the formula is valid for g. For every g at least one pivot is
        positive.
        """

    @abstractmethod
    def lift(self, d: Domain, g: Vector[S], formula: int) -> Vector[S]:
        """Return an element of the cover whose image under the covering map is g.

        ``formula`` is the index of the formula that computes the element.
        """


class Rotations(MatrixElements):
    """A group of rotation matrices."""

    provides: ClassVar[str] = "rotation of vectors"

    @abstractmethod
    def rotate(self, d: Domain, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return exp(x) y for a column y. A subclass may use a formula without the matrix exp(x)."""


class PointMotions(LieGroup):
    """The group acts on the points of a vector space, for example by rotations and translations."""

    provides: ClassVar[str] = "motion of points"
    point_size: int
    """The number of coordinates of a point."""

    @abstractmethod
    def move(self, d: Domain, g: Vector[S], z: Vector[S]) -> Vector[S]:
        """Return g.z, the image of the point z under g. The method must satisfy move(g k, z) = move(g,
        move(k, z)).
        """

    @abstractmethod
    def point_velocity(self, d: Domain, x: Vector[S], z: Vector[S]) -> Vector[S]:
        """Return x.z, the derivative of exp(eps x).z at eps = 0."""


class DirectProduct(LieGroup):
    """The group is a direct product of ``factors``."""

    provides: ClassVar[str] = "factors"
    factors: tuple[LieGroup, ...]

    @abstractmethod
    def parts(self, x: Vector[S]) -> tuple[Vector[S], ...]:
        """Return the coordinates of x in each factor. The argument x is an element of the group, of the
        algebra, or of the dual of the algebra.
        """


class CotangentBundle(LieGroup):
    """The group is the cotangent bundle T*G of the group G = ``base``.

    The coordinates of an element are the coordinates of a point of G, followed by the coordinates of a
    momentum.
    """

    provides: ClassVar[str] = "structure of a cotangent bundle"
    base: Coadjoint

    @abstractmethod
    def canonical(self, d: Domain, z: Vector[S], covector: Vector[S]) -> Vector[S]:
        """Return the image of ``covector`` under the canonical Poisson bivector of T*G at the point z.

        The covector and its image are right-trivialised. If ``covector`` is the differential of a
        Hamiltonian, the image is the Hamiltonian vector field.
        """


class Projection(LieGroup):
    """A group with a projection that reduces small violations of the equations of the group."""

    provides: ClassVar[str] = "projection onto the group"

    @abstractmethod
    def project(self, d: Domain, g: Vector[S]) -> Vector[S]:
        """Return g after an approximate projection onto the group.

        If g violates the equations of the group by eps, the result violates the equations by O(eps^2).
        """


class DependentCoordinates(LieGroup):
    """A group in which some coordinates of an element determine the other coordinates."""

    provides: ClassVar[str] = "dependent coordinates"

    @abstractmethod
    def determined(self) -> tuple[tuple[int, ...], ...]:
        """Return the tuples of indices that :meth:`complete` accepts as ``missing``."""

    @abstractmethod
    def complete(self, d: Domain, g: Vector[S], missing: tuple[int, ...]) -> Vector[S]:
        """Return g with new values of the coordinates g[i] for all i in ``missing``.

        The new values are computed from the other coordinates of g. The tuple ``missing`` is an element of
        :meth:`determined`.
        """


def _combination(d: Domain, terms: Sequence[tuple[Fraction, Vector[S]]]) -> Vector[S]:
    """Return the sum of c x over the terms (c, x). Without terms, return the empty tuple."""
    total: Vector[S] = ()
    for c, x in terms:
        factor: S = d.rational(c.numerator, c.denominator)
        scaled = tuple(factor * a for a in x)
        total = tuple(a + b for a, b in zip(total, scaled, strict=True)) if total else scaled
    return total
