"""Methods y1 = M y0 for the equation y' = A(t) y. The scene defines the matrix M by a formula.

The formula contains the step size :data:`h`, numbers, the matrix :data:`IDENTITY`, and the function
:func:`A`. In a formula, A(c) is the matrix of the equation at the time t + c h, where c is a number, and t is
the time at the beginning of the step. Sums, products and the functions :func:`bracket`, :func:`projected`,
:func:`expm` and :func:`logm` combine these matrices.
The values of a formula are in one of three sets (:class:`Place`): the Lie algebra, the group, or all square
matrices. Logarithms are available only for 2 x 2 matrices. For larger matrices, the argument of :func:`expm`
must be in the Lie algebra.

>>> projection = expm(projected(logm(IDENTITY + h * A(0))))
>>> projection.place, projection.text()
(<Place.GROUP: 'group'>, 'exp(proj(log((1 + h A(t)))))')
>>> expm(h * A(0) * (IDENTITY + h * A(0) * bracket(A(0), A(1)))).place
<Place.MATRIX: 'matrix'>
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from fractions import Fraction
from functools import lru_cache
from typing import Generic

from codegen.groups.base import LieGroup
from codegen.groups.capabilities import MatrixElements
from codegen.groups.linear_algebra import S, Vector, product, units
from codegen.ir.domain import Domain, FloatDomain


class Place(Enum):
    """A set that contains the values of a formula: the Lie algebra, the group, or all square matrices."""

    ALGEBRA = "algebra"
    GROUP = "group"
    MATRIX = "matrix"


@dataclass(frozen=True)
class Evaluation(Generic[S]):
    """The data for evaluating a formula in a step from t to t + h.

    ``generator`` is the function that maps c to the components of A(t + c h) in the basis of the Lie algebra.
    """

    group: MatrixElements
    domain: Domain
    generator: Callable[[Fraction], Vector[S]]


@dataclass(frozen=True)
class Scalar:
    """The scalar a h^k, where a is ``value``, k is ``power``, and h is the step size."""

    value: Fraction
    power: int

    def __rmul__(self, number: int | Fraction) -> Scalar:
        """Return the product of a number and the scalar."""
        return replace(self, value=number * self.value)

    def __truediv__(self, number: int | Fraction) -> Scalar:
        """Return the quotient of the scalar and a number."""
        return replace(self, value=self.value / number)

    def __pow__(self, n: int) -> Scalar:
        """Return the n-th power of the scalar, for n >= 0."""
        return Scalar(self.value**n, self.power * n)

    def text(self) -> str:
        """Return the scalar as text, for example ``1/2 h^2``."""
        power = "" if not self.power else "h" if self.power == 1 else f"h^{self.power}"
        number = "" if self.value == 1 and power else str(self.value)
        return " ".join(filter(None, (number, power)))


h = Scalar(Fraction(1), 1)
"""The step size."""


class MatrixFormula(ABC):
    """A formula whose values are square matrices."""

    @property
    @abstractmethod
    def place(self) -> Place:
        """The Lie algebra, the group, or all square matrices: the set that contains the formula's values."""

    @abstractmethod
    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""

    @abstractmethod
    def text(self) -> str:
        """Return the formula as text."""

    def parts(self) -> tuple[MatrixFormula, ...]:
        """Return the operands of this formula."""
        return ()

    def closed_forms(self) -> Iterator[MatrixFormula]:
        """Yield the exponentials and logarithms in this formula that are computed by closed forms.

        The closed forms exist only for 2 x 2 matrices.
        """
        for part in self.parts():
            yield from part.closed_forms()

    def __add__(self, other: MatrixFormula) -> MatrixFormula:
        """Return the sum."""
        return Sum(self, other)

    def __sub__(self, other: MatrixFormula) -> MatrixFormula:
        """Return the difference."""
        return Sum(self, Multiple(Scalar(Fraction(-1), 0), other))

    def __mul__(self, other: MatrixFormula) -> MatrixFormula:
        """Return the product of matrices."""
        return Product(self, other)

    def __rmul__(self, factor: Scalar | int | Fraction) -> MatrixFormula:
        """Return the product of a scalar and the matrix."""
        return Multiple(factor if isinstance(factor, Scalar) else Scalar(Fraction(factor), 0), self)


@dataclass(frozen=True)
class Generator(MatrixFormula):
    """The matrix A(t + c h) for a step from t to t + h. The equation is y' = A(t) y."""

    c: Fraction

    @property
    def place(self) -> Place:
        """Always ``Place.ALGEBRA``."""
        return Place.ALGEBRA

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        return at.group.hat(at.domain, at.generator(self.c))

    def text(self) -> str:
        """Return the formula as text."""
        return "A(t)" if not self.c else f"A(t + {Scalar(self.c, 1).text()})"


@dataclass(frozen=True)
class Unit(MatrixFormula):
    """The unit matrix."""

    @property
    def place(self) -> Place:
        """Always ``Place.GROUP``."""
        return Place.GROUP

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        n = at.group.order
        return tuple(at.domain.rational(int(i == j)) for i in range(n) for j in range(n))

    def text(self) -> str:
        """Return the formula as text."""
        return "1"


@dataclass(frozen=True)
class Binary(MatrixFormula):
    """A formula with two operands: the formulas ``left`` and ``right``."""

    left: MatrixFormula
    right: MatrixFormula

    def parts(self) -> tuple[MatrixFormula, ...]:
        """Return both operands."""
        return self.left, self.right

    def _both(self, place: Place) -> bool:
        return self.left.place is self.right.place is place


class Sum(Binary):
    """The sum of two matrices."""

    @property
    def place(self) -> Place:
        """ALGEBRA if both terms are elements of the algebra, otherwise MATRIX."""
        return Place.ALGEBRA if self._both(Place.ALGEBRA) else Place.MATRIX

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        return tuple(x + y for x, y in zip(self.left.value(at), self.right.value(at), strict=True))

    def text(self) -> str:
        """Return the formula as text."""
        return f"({self.left.text()} + {self.right.text()})"


class Product(Binary):
    """The product of two matrices."""

    @property
    def place(self) -> Place:
        """GROUP if both factors are elements of the group, otherwise MATRIX."""
        return Place.GROUP if self._both(Place.GROUP) else Place.MATRIX

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        return product(at.domain, self.left.value(at), self.right.value(at), at.group.order)

    def text(self) -> str:
        """Return the formula as text."""
        return f"{self.left.text()} {self.right.text()}"


class Commutator(Binary):
    """The commutator X Y - Y X of two matrices."""

    @property
    def place(self) -> Place:
        """ALGEBRA if both matrices are elements of the algebra, otherwise MATRIX."""
        return Place.ALGEBRA if self._both(Place.ALGEBRA) else Place.MATRIX

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        x, y, d, n = self.left.value(at), self.right.value(at), at.domain, at.group.order
        return tuple(a - b for a, b in zip(product(d, x, y, n), product(d, y, x, n), strict=True))

    def text(self) -> str:
        """Return the formula as text."""
        return f"[{self.left.text()}, {self.right.text()}]"


@dataclass(frozen=True)
class Unary(MatrixFormula):
    """A formula with one operand. The attribute ``of`` is the operand."""

    of: MatrixFormula

    def parts(self) -> tuple[MatrixFormula, ...]:
        """Return a tuple that contains only the operand."""
        return (self.of,)


@dataclass(frozen=True)
class Multiple(MatrixFormula):
    """The product of a scalar and a matrix."""

    factor: Scalar
    of: MatrixFormula

    @property
    def place(self) -> Place:
        """ALGEBRA if the matrix is an element of the algebra, otherwise MATRIX."""
        return Place.ALGEBRA if self.of.place is Place.ALGEBRA else Place.MATRIX

    def parts(self) -> tuple[MatrixFormula, ...]:
        """Return a tuple with one entry: the formula of the matrix."""
        return (self.of,)

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        factor = at.domain.rational(*self.factor.value.as_integer_ratio())
        for _ in range(self.factor.power):
            factor = factor * at.domain.h
        return tuple(factor * x for x in self.of.value(at))

    def text(self) -> str:
        """Return the formula as text."""
        return f"{self.factor.text()} {self.of.text()}"


class Projected(Unary):
    """The orthogonal projection of a matrix onto the Lie algebra. The scalar product is tr(X^T Y).

    For sp(2n) the projection of X is (X + J X^T J)/2 with J = (0, I; -I, 0), as in equation (4.18) of
    H. Marthinsen's thesis.
    """

    @property
    def place(self) -> Place:
        """ALGEBRA, because the value of this formula is in the Lie algebra."""
        return Place.ALGEBRA

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        d, entries = at.domain, self.of.value(at)
        result = []
        for row in projection_matrix(at.group):
            total = d.rational(0)
            for c, x in zip(row, entries, strict=True):
                if c:
                    total = total + d.rational(*c.as_integer_ratio()) * x
            result.append(total)
        return tuple(result)

    def text(self) -> str:
        """Return the formula as text."""
        return f"proj({self.of.text()})"


class Exponential(Unary):
    """The exponential of a matrix."""

    @property
    def place(self) -> Place:
        """GROUP if the argument X of exp(X) is in the Lie algebra, otherwise MATRIX."""
        return Place.GROUP if self.of.place is Place.ALGEBRA else Place.MATRIX

    def closed_forms(self) -> Iterator[MatrixFormula]:
        """Yield the exponentials and logarithms in this formula that are computed by closed forms.

        Exponentials of elements of the Lie algebra are omitted, because the group computes them.
        """
        if self.of.place is not Place.ALGEBRA:
            yield self
        yield from super().closed_forms()

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        x = self.of.value(at)
        if self.of.place is Place.ALGEBRA:
            return at.group.exp(at.domain, at.group.vee(at.domain, x))
        return _exponential(at.domain, x)

    def text(self) -> str:
        """Return the formula as text."""
        return f"exp({self.of.text()})"


class Logarithm(Unary):
    """The principal logarithm of a matrix."""

    @property
    def place(self) -> Place:
        """Always ``Place.MATRIX``."""
        return Place.MATRIX

    def closed_forms(self) -> Iterator[MatrixFormula]:
        """Yield this logarithm, and then the ``closed_forms`` of the argument."""
        yield self
        yield from super().closed_forms()

    def value(self, at: Evaluation[S]) -> Vector[S]:
        """Return the entries of the matrix, row by row."""
        return _logarithm(at.domain, self.of.value(at))

    def text(self) -> str:
        """Return the formula as text."""
        return f"log({self.of.text()})"


IDENTITY = Unit()
"""The unit matrix."""


def A(c: int | Fraction = 0) -> MatrixFormula:
    """Return the matrix A(t + c h) for a step from t to t + h. The equation is y' = A(t) y."""
    return Generator(Fraction(c))


def bracket(x: MatrixFormula, y: MatrixFormula) -> MatrixFormula:
    """Return [x, y] = x y - y x."""
    return Commutator(x, y)


def projected(x: MatrixFormula) -> MatrixFormula:
    """Return the orthogonal projection of x onto the Lie algebra."""
    return Projected(x)


def expm(x: MatrixFormula) -> MatrixFormula:
    """Return the exponential of x."""
    return Exponential(x)


def logm(x: MatrixFormula) -> MatrixFormula:
    """Return the principal logarithm of x."""
    return Logarithm(x)


@dataclass(frozen=True)
class MatrixStep:
    """A method that the scene defines: y1 = M y0, where M is the value of ``formula``.

    ``order`` is the order of the method. The scene states the order.
    """

    formula: MatrixFormula
    order: int

    @property
    def canonical(self) -> bool:
        """True if the type of the formula is GROUP. The value of the formula is then in the group."""
        return self.formula.place is Place.GROUP


@lru_cache(maxsize=16)
def projection_matrix(group: LieGroup) -> tuple[tuple[Fraction, ...], ...]:
    """Return the matrix of the orthogonal projection onto the Lie algebra of the group.

    The result acts on vectors of n^2 entries: the entries of an n x n matrix, listed row by row.
    """
    from sympy import Matrix, Rational

    d = FloatDomain(0.0)
    matrices = group.require(MatrixElements)
    basis: tuple[Vector[float], ...] = units(d, group.dim)
    columns = Matrix([[Rational(x) for x in matrices.hat(d, e)] for e in basis]).T
    both = columns * (columns.T * columns).inv() * columns.T
    return tuple(tuple(Fraction(int(x.p), int(x.q)) for x in both.row(i)) for i in range(both.rows))


def _split(d: Domain, m: Vector[S]) -> tuple[S, Vector[S], S]:
    """Return s, N and det N for the 2 x 2 matrix m = s I + N, where s is a number and N has trace zero."""
    half = d.rational(1, 2)
    s, a = half * (m[0] + m[3]), half * (m[0] - m[3])
    return s, (a, m[1], m[2], -a), -(a * a + m[1] * m[2])


def _exponential(d: Domain, m: Vector[S]) -> Vector[S]:
    """Return the exponential of a 2 x 2 matrix m = s I + N, where s is a number and N has trace zero.

    The result is e^s (c_0(det N) I + c_1(det N) N) with the Stumpff functions c_0(z) = cos(sqrt z) and c_1(z)
    = sin(sqrt z)/sqrt z.
    """
    s, traceless, z = _split(d, m)
    scale = d.call("exp", s)
    c0, c1 = scale * d.call("signed_stumpff0", z), scale * d.call("signed_stumpff1", z)
    diagonal = c1 * traceless[0]
    return (c0 + diagonal, c1 * m[1], c1 * m[2], c0 - diagonal)


def _logarithm(d: Domain, m: Vector[S]) -> Vector[S]:
    """Return the logarithm of a 2 x 2 matrix m = s I + N, where s is a number and N has trace zero.

    The result is (1/2 log(det m)) I + g N, with z = det N, r = sqrt(|z|) and this number g:

    - If z > 0, g = atan2(r, s)/r.
    - If z = 0, g = 1/s.
    - If z < 0, g = log((s + r)/(s - r))/(2 r).
    """
    s, traceless, z = _split(d, m)
    one, half = d.rational(1), d.rational(1, 2)
    r = d.call("sqrt", d.call("fabs", z))
    # ``choose`` evaluates both alternatives, so the logarithms must be finite for z > 0, too.
    above, below = (d.call("log", d.call("choose", z, one, x)) for x in (s + r, s - r))
    angle = d.call("choose", z, d.call("atan2", r, s), half * (above - below))
    g = d.call("choose", r, d.call("quotient", angle, r), d.call("quotient", one, s))
    middle = half * d.call("log", m[0] * m[3] - m[1] * m[2])
    diagonal = g * traceless[0]
    return (middle + diagonal, g * m[1], g * m[2], middle - diagonal)
