"""Linear representations of groups, from which semidirect products are built.

A representation rho is a linear action of a group on a vector space V. A vector v of V and a covector p of
the dual space are flat tuples, and <p, v> is their dot product. For x in the algebra, x.v is the derivative
of rho(exp(eps x)) v at eps = 0.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from math import isqrt
from typing import ClassVar

from codegen.errors import SceneError
from codegen.groups.ad_polynomial import ad_polynomial
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import (
    ClosedFormSeries,
    Coadjoint,
    LeftTranslation,
    MatrixRepresentation,
    Rotations,
)
from codegen.groups.cubic_ad import DEXP
from codegen.groups.dual_numbers import DualDomain, duals
from codegen.groups.linear_algebra import S, Vector, dot, invert, matvec, units
from codegen.ir.ad_series import Factor
from codegen.ir.domain import Domain, FloatDomain

Pair = tuple[Vector[S], Vector[S]]
"""Either (element of the algebra, vector) or (element of the dual of the algebra, covector)."""


class Representation(ABC):
    """A representation of a group on one or more copies of a vector space V.

    ``copies`` is the number of copies. A vector of the whole space lists its components copy by copy. Each
    method of this class acts on the vectors of one copy. ``needs`` is the capability that the group must
    have.
    """

    needs: type[LieGroup] = Coadjoint
    of_algebra: ClassVar[bool] = False
    """True if the group acts on its Lie algebra by Ad."""

    def __init__(self, copies: int = 1) -> None:
        if copies < 1:
            raise SceneError(f"the number of copies of a space is {copies}", expected="at least one copy")
        self.copies = copies

    @abstractmethod
    def dim(self, group: LieGroup) -> int:
        """Return the dimension of the vector space V (see :class:`Representation`)."""

    @abstractmethod
    def act(self, d: Domain, group: LieGroup, g: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return rho(g) v for the representation rho."""

    @abstractmethod
    def inverse(self, d: Domain, group: LieGroup, g: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return rho(g)^-1 v for the representation rho."""

    @abstractmethod
    def dual(self, d: Domain, group: LieGroup, g: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return rho(g)^T p for the representation rho: <rho(g)^T p, v> = <p, rho(g) v> for all v."""

    @abstractmethod
    def dual_inverse(self, d: Domain, group: LieGroup, g: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return rho(g)^-T p for the representation rho, where -T means the inverse of the transpose."""

    @abstractmethod
    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return x.v, the derivative of rho(exp(eps x)) v at eps = 0 for the representation rho."""

    @abstractmethod
    def dual_velocity(self, d: Domain, group: LieGroup, x: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return X^T p, where X is the linear map v -> x.v. Thus <X^T p, v> = <p, x.v> for all v."""

    @abstractmethod
    def momentum(self, d: Domain, group: LieGroup, v: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return the momentum map J(v, p), an element of the dual of the algebra.

        J is defined by <J(v, p), x> = <p, x.v> for all x in the algebra. For x.v see :meth:`velocity`.
        """

    @abstractmethod
    def translation(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S]) -> Vector[S]:
        """Return phi(x) u. Here phi(x) is the sum of X^k/(k+1)! over k >= 0, and X is the map v -> x.v.

        In the semidirect product, the exponential of (x, u) is (exp(x), phi(x) u).
        """

    def gradient(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S], p: Vector[S]) -> Pair[S]:
        """Return the derivatives of <p, phi(x) u> with respect to x and u. For phi see :meth:`translation`.

        A subclass whose :meth:`closed` returns False must implement this method.
        """
        raise self._missing("gradient")

    def closed(self, group: LieGroup) -> bool:
        """Return True if :meth:`series` has a closed form for this group."""
        return False

    def series(self, d: Domain, group: LieGroup, word: Sequence[Factor], x: Pair[S], v: Pair[S]) -> Pair[S]:
        """Apply ``word``, a product of functions of ad_x, to v.

        Each of x and v is a pair: an element of the group's algebra, and a vector of V (see
        :class:`Representation`).
        """
        raise self._missing("series")

    def dual_series(
        self, d: Domain, group: LieGroup, word: Sequence[Factor], x: Pair[S], p: Pair[S]
    ) -> Pair[S]:
        """Apply ``word``, a product of functions of ad*_x, to p.

        p is a pair: an element of the dual of the group's algebra, and a covector of V (see
        :class:`Representation`). For x see :meth:`series`.
        """
        raise self._missing("dual_series")

    def _missing(self, method: str) -> SceneError:
        """Return the error for a subclass of :class:`Representation` that lacks the given method."""
        return SceneError(
            f"the representation {type(self).__name__} has no method {method}",
            expected="series() and dual_series() if closed() returns True, otherwise gradient()",
            hint=f"write {method} in the class {type(self).__name__}",
        )

    def of_matrices(self, group: LieGroup) -> MatrixRepresentation | None:
        """Return ``group`` if this representation multiplies vectors by the matrices of the group.
        Otherwise return None.
        """
        return None


class AlgebraVectors(Representation):
    """One or more copies of the Lie algebra. The group acts on each copy by Ad.

    For this representation, x.v is the bracket [x, v].
    """

    of_algebra = True

    needs = ClosedFormSeries

    def dim(self, group: LieGroup) -> int:
        """Return the dimension of the group."""
        return group.dim

    def act(self, d: Domain, group: LieGroup, g: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return Ad_g v."""
        return group.require(Coadjoint).Ad(d, g, v)

    def inverse(self, d: Domain, group: LieGroup, g: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return Ad_{g^-1} v."""
        return group.require(LeftTranslation).Adinv(d, g, v)

    def dual(self, d: Domain, group: LieGroup, g: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return the covector Ad*_g p with <Ad*_g p, x> = <p, Ad_g x> for all x."""
        return group.require(Coadjoint).Adt(d, g, p)

    def dual_inverse(self, d: Domain, group: LieGroup, g: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return Ad*_{g^-1} p."""
        return group.require(Coadjoint).Adtinv(d, g, p)

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return the bracket [x, v] of the Lie algebra."""
        return group.ad(d, x, v)

    def dual_velocity(self, d: Domain, group: LieGroup, x: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return ad*_x p."""
        return group.require(Coadjoint).adt(d, x, p)

    def momentum(self, d: Domain, group: LieGroup, v: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return the momentum map J(v, p) = -ad*_v p. Thus <J(v, p), x> = <p, [x, v]> for all x."""
        return tuple(-a for a in group.require(Coadjoint).adt(d, v, p))

    def translation(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S]) -> Vector[S]:
        """Return dexp_x u."""
        return group.require(ClosedFormSeries).series(d, DEXP, False, x, u)

    def closed(self, group: LieGroup) -> bool:
        """Return True: :meth:`series` has a closed form (see :class:`ClosedFormSeries`)."""
        return True

    def series(self, d: Domain, group: LieGroup, word: Sequence[Factor], x: Pair[S], v: Pair[S]) -> Pair[S]:
        """Apply ``word``, a product of functions of ad_x, to v."""
        closed = group.require(ClosedFormSeries)
        result = closed.series(DualDomain(d), word, False, duals(*x), duals(*v))
        return tuple(a.real for a in result), tuple(a.rate for a in result)

    def dual_series(
        self, d: Domain, group: LieGroup, word: Sequence[Factor], x: Pair[S], p: Pair[S]
    ) -> Pair[S]:
        """Apply ``word``, a product of functions of ad*_x, to p."""
        closed = group.require(ClosedFormSeries)
        # The pairing of p = (m, q) and x = (y, v) is m.y + q.v. If e^2 = 0, this pairing is the coefficient
        # of e in the product (q + m e).(y + v e). Therefore x is represented by y + v e, and p by q + m e.
        result = closed.series(DualDomain(d), word, True, duals(*x), duals(p[1], p[0]))
        return tuple(a.rate for a in result), tuple(a.real for a in result)

    def of_matrices(self, group: LieGroup) -> MatrixRepresentation | None:
        """Return the group if its elements are the rotation matrices of R^3. Otherwise return None.

        On this group, Ad_g is the multiplication with the matrix g.
        """
        rotations = group.offers(Rotations)
        return rotations if rotations is not None and rotations.order == rotations.dim else None


class MatrixColumns(Representation):
    """One or more copies of the space of columns with n entries. An element of the group acts on a column by
    multiplication with its n x n matrix.
    """

    needs = MatrixRepresentation

    def _matrices(self, group: LieGroup) -> MatrixRepresentation:
        return group.require(MatrixRepresentation)

    def dim(self, group: LieGroup) -> int:
        """Return the number of rows of the matrices that represent the group."""
        matrices, d = self._matrices(group), FloatDomain(0.0)
        return isqrt(len(matrices.matrix(d, matrices.identity(d))))

    def act(self, d: Domain, group: LieGroup, g: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return M v for the matrix M of g."""
        return matvec(self._matrices(group).matrix(d, g), v)

    def inverse(self, d: Domain, group: LieGroup, g: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return M^-1 v for the matrix M of g."""
        return matvec(self._inverse(d, group, g), v)

    def dual(self, d: Domain, group: LieGroup, g: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return M^T p for the matrix M of g."""
        return matvec(_transposed(self._matrices(group).matrix(d, g)), p)

    def dual_inverse(self, d: Domain, group: LieGroup, g: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return M^-T p for the matrix M of g."""
        return matvec(_transposed(self._inverse(d, group, g)), p)

    def _inverse(self, d: Domain, group: LieGroup, g: Vector[S]) -> Vector[S]:
        return invert(d, self._matrices(group).matrix(d, g), self.dim(group))

    def velocity(self, d: Domain, group: LieGroup, x: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return M v for the matrix M of x."""
        return matvec(self._matrices(group).hat(d, x), v)

    def dual_velocity(self, d: Domain, group: LieGroup, x: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return M^T p for the matrix M of x."""
        return matvec(_transposed(self._matrices(group).hat(d, x)), p)

    def momentum(self, d: Domain, group: LieGroup, v: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return the numbers <p, B v>, where B runs over the matrices of the basis of the algebra."""
        basis: tuple[Vector[S], ...] = units(d, group.dim)
        return tuple(dot(p, self.velocity(d, group, e, v)) for e in basis)

    def translation(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S]) -> Vector[S]:
        """Return phi(x) u. Here phi(x) is the sum of A^k/(k+1)! over k >= 0, and A is the matrix of x.

        The exponential of [[A, u], [0, 0]] is [[exp(A), phi(x) u], [0, 1]].
        """
        n, bordered = self._bordered(d, group, x, u)
        exponential: Vector[S] = d.vector(f"expm{n}", bordered)
        return tuple(exponential[n * i + n - 1] for i in range(n - 1))

    def gradient(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S], p: Vector[S]) -> Pair[S]:
        """Return the derivatives of <p, phi(x) u> with respect to x and u.

        The function phi is defined in :meth:`translation`.
        """
        n, bordered = self._bordered(d, group, x, u)
        zero: S = d.rational(0)
        direction = (*(a for q in p for a in (*(zero,) * (n - 1), q)), *(zero,) * n)
        both: Vector[S] = d.vector(f"expm{n}_d1", (*_transposed(bordered), *direction))
        slope = both[n * n :]
        block = tuple(slope[n * i + j] for i in range(n - 1) for j in range(n - 1))
        basis: tuple[Vector[S], ...] = units(d, group.dim)
        forces = tuple(dot(block, self._matrices(group).hat(d, e)) for e in basis)
        return forces, tuple(slope[n * i + n - 1] for i in range(n - 1))

    def _bordered(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S]) -> tuple[int, Vector[S]]:
        """Return two values for the square matrix [[A, u], [0, 0]]: its number of rows, and its entries.

        A is the matrix that represents the algebra element x.
        """
        n, hat = len(u), self._matrices(group).hat(d, x)
        rows = (a for i in range(n) for a in (*hat[n * i : n * i + n], u[i]))
        return n + 1, (*rows, *(d.rational(0),) * (n + 1))

    def of_matrices(self, group: LieGroup) -> MatrixRepresentation | None:
        """Return ``group`` if it has matrices (:class:`MatrixRepresentation`). Otherwise raise
        :class:`SceneError`.
        """
        return self._matrices(group)


class PlaneVectors(MatrixColumns):
    """One or more copies of R^2. SO(2) acts on each copy by rotations."""

    def inverse(self, d: Domain, group: LieGroup, g: Vector[S], v: Vector[S]) -> Vector[S]:
        """Return R^-1 v = R^T v, where R is the rotation matrix of g."""
        return self.dual(d, group, g, v)

    def dual_inverse(self, d: Domain, group: LieGroup, g: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return R^-T p = R p, where R is the rotation matrix of g."""
        return self.act(d, group, g, p)

    def momentum(self, d: Domain, group: LieGroup, v: Vector[S], p: Vector[S]) -> Vector[S]:
        """Return v_0 p_1 - v_1 p_0, the momentum map of a vector v and a covector p."""
        return (v[0] * p[1] - v[1] * p[0],)

    def translation(self, d: Domain, group: LieGroup, x: Vector[S], u: Vector[S]) -> Vector[S]:
        """Return phi(x) u = c_1(w^2) u + c_2(w^2) w J u, where w is the only component of x.

        c_1 and c_2 are Stumpff functions, and J is the rotation by a right angle: J(a, b) = (-b, a).
        """
        z = x[0] * x[0]
        c1, turned = d.call("stumpff1", z), x[0] * d.call("stumpff2", z)
        return (c1 * u[0] - turned * u[1], c1 * u[1] + turned * u[0])

    def closed(self, group: LieGroup) -> bool:
        """Return True: :meth:`series` has a closed form, because ad_x^3 = -w^2 ad_x for x = (w, u)."""
        return True

    def series(self, d: Domain, group: LieGroup, word: Sequence[Factor], x: Pair[S], v: Pair[S]) -> Pair[S]:
        """Apply ``word``, a product of functions of ad_x, to v.

        Let x = (w, u) and v = (y, q) with numbers w, y and vectors u, q. Let J be the rotation by a right
        angle: J(s, t) = (-t, s). Then ad_x v = (0, r) and ad_x^2 v = (0, w J r) with r = w J q - y J u. The
        product of the factors of ``word`` is 1 + b ad_x + c ad_x^2 with numbers b and c. The result is
        (y, q + b r + c w J r).
        """
        (w,), u = x
        b, c = ad_polynomial(d, word, w * w)
        first = (v[0][0] * u[1] - w * v[1][1], w * v[1][0] - v[0][0] * u[0])
        turned = c * w
        second = (b * first[0] - turned * first[1], b * first[1] + turned * first[0])
        return v[0], tuple(p + q for p, q in zip(v[1], second, strict=True))

    def dual_series(
        self, d: Domain, group: LieGroup, word: Sequence[Factor], x: Pair[S], p: Pair[S]
    ) -> Pair[S]:
        """Return L^T p, where L is the linear map v -> series(d, group, word, x, v)."""
        (w,), u = x
        b, c = ad_polynomial(d, word, w * w)
        turned = c * w
        first = (b * p[1][0] + turned * p[1][1], b * p[1][1] - turned * p[1][0])
        moment = p[0][0] + (u[1] * first[0] - u[0] * first[1])
        return (moment,), (p[1][0] + w * first[1], p[1][1] - w * first[0])


def _transposed(matrix: Vector[S]) -> Vector[S]:
    n = round(len(matrix) ** 0.5)
    return tuple(matrix[n * j + i] for i in range(n) for j in range(n))
