"""Scalars, vectors and matrices over any domain, and their linear algebra.

A domain is a set of scalars, for example floats, mpmath numbers, power series or expressions. A vector is a
tuple of scalars, and a matrix is a tuple of its entries row by row.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from typing import Protocol, Self, TypeVar

from codegen.ir.domain import Domain


class Scalar(Protocol):
    """A number of a domain (:mod:`codegen.ir.domain`). Both operands of an operation must belong to the same
    domain.
    """

    def __add__(self, other: Self, /) -> Self:
        """Return the sum."""

    def __sub__(self, other: Self, /) -> Self:
        """Return the difference."""

    def __mul__(self, other: Self, /) -> Self:
        """Return the product."""

    def __truediv__(self, other: Self, /) -> Self:
        """Return the quotient."""

    def __neg__(self) -> Self:
        """Return the negative."""


S = TypeVar("S", bound=Scalar)
"""The type of the scalars of one domain."""

Vector = tuple[S, ...]
"""A flat tuple of scalars of one domain."""


def dot(a: Vector[S], b: Vector[S]) -> S:
    """Return the scalar product of a and b. The terms are added from the first to the last."""
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def rescaled(d: Domain, v: Vector[S], e: S) -> Vector[S]:
    """Return v (1 + e/2 + 3 e^2/8) = v/sqrt(1 - e) + O(e^3).

    If e = 1 - |v|^2, the vector v/sqrt(1 - e) is the unit vector v/|v|.
    """
    excess: S = e * (d.rational(1, 2) + d.rational(3, 8) * e)
    # The factor 1 + excess is not computed, because rounding would lose a small excess.
    return tuple(a + excess * a for a in v)


def cross(a: Vector[S], b: Vector[S]) -> Vector[S]:
    """Return the cross product of two 3-vectors."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def units(d: Domain, n: int) -> tuple[Vector[S], ...]:
    """Return the n unit vectors."""
    return tuple(tuple(d.rational(int(i == j)) for j in range(n)) for i in range(n))


def matmul(a: Vector[S], b: Vector[S], n: int) -> Vector[S]:
    """Return the product of two n x n matrices."""
    rows = range(n)
    return tuple(dot(a[n * i : n * i + n], b[j::n]) for i in rows for j in rows)


def matvec(a: Vector[S], v: Vector[S]) -> Vector[S]:
    """Return the product of the matrix ``a`` and the vector ``v``."""
    n = len(v)
    return tuple(dot(a[i : i + n], v) for i in range(0, len(a), n))


def transposed(a: Vector[S], n: int) -> Vector[S]:
    """Return the transpose of an n x n matrix."""
    return tuple(x for j in range(n) for x in a[j::n])


def determinant(a: Vector[S], n: int) -> S:
    """Return the determinant of an n x n matrix by Laplace expansion along the rows.

    The result needs n (2^(n-1) - 1) products and no divisions.

    >>> determinant((1, 2, 3, 4), 2)
    -2
    """
    # ``minors`` maps each tuple of m columns to the minor of these columns in the last m rows.
    minors: dict[tuple[int, ...], S] = {(j,): a[n * (n - 1) + j] for j in range(n)}
    for i in reversed(range(n - 1)):
        larger: dict[tuple[int, ...], S] = {}
        for columns in combinations(range(n), n - i):
            terms = [a[n * i + j] * minors[(*columns[:k], *columns[k + 1 :])] for k, j in enumerate(columns)]
            total = terms[0]
            for k, x in enumerate(terms[1:], 1):
                total = total - x if k % 2 else total + x
            larger[columns] = total
        minors = larger
    return minors[tuple(range(n))]


LOOPED = 5
"""Products of matrices with at least this number of rows are loops in emitted code."""


def product(d: Domain, a: Vector[S], b: Vector[S], n: int) -> Vector[S]:
    """Return the product of two n x n matrices."""
    return matmul(a, b, n) if n < LOOPED else d.vector(f"product{n}", (*a, *b))


WITHOUT_PIVOTS = 3
"""The largest number of rows for which :func:`invert` uses a formula without pivots."""


def invert(d: Domain, g: Vector[S], n: int) -> Vector[S]:
    """Return the inverse of an n x n matrix.

    Small matrices are inverted by the Faddeev-LeVerrier recursion. Large matrices are inverted by elimination
    with row exchanges.
    """
    if n > WITHOUT_PIVOTS:
        return d.vector(f"inverse{n}", g)
    identity: Vector[S] = tuple(d.rational(int(i == j)) for i in range(n) for j in range(n))
    ones: Vector[S] = (d.rational(1),) * n
    m, c = identity, ones[0]
    for k in range(1, n + 1):
        product = matmul(g, m, n)
        trace = dot(product[:: n + 1], ones)
        c = -(trace * d.rational(1, k))
        if k < n:
            m = tuple(p + c * u for p, u in zip(product, identity, strict=True))
    return tuple(-(x / c) for x in m)


def solved_near_identity(a: Vector[S], b: Vector[S], n: int) -> Vector[S]:
    """Return the solution x of ``a`` x = ``b`` by elimination without row exchanges.

    The matrix ``a`` has n rows and columns, and the matrix ``b`` has n rows. If ``a`` is close to the unit
    matrix, all pivots are close to 1. If the symmetric part of ``a`` is positive definite, all pivots are
    positive.
    """
    width = len(b) // n
    rows = [[*a[n * i : n * i + n], *b[width * i : width * i + width]] for i in range(n)]
    for k in range(n):
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i][k:] = [x - factor * y for x, y in zip(rows[i][k:], rows[k][k:], strict=True)]
    for k in reversed(range(n)):
        rows[k][n:] = [x / rows[k][k] for x in rows[k][n:]]
        for i in range(k):
            factor = rows[i][k]
            rows[i][n:] = [x - factor * y for x, y in zip(rows[i][n:], rows[k][n:], strict=True)]
    return tuple(x for row in rows for x in row[n:])


def rational_inverse(a: Sequence[Sequence[Fraction]]) -> list[list[Fraction]] | None:
    """Return the inverse of a rational matrix by Gauss-Jordan elimination, or None for a singular matrix.

    >>> rational_inverse([[Fraction(2)]]), rational_inverse([[Fraction(0)]])
    ([[Fraction(1, 2)]], None)
    """
    n = len(a)
    rows = [[*row, *(Fraction(int(i == j)) for j in range(n))] for i, row in enumerate(a)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [row[n:] for row in rows]


def vector_sum(first: Vector[S], *others: Vector[S]) -> Vector[S]:
    """Return the sum of vectors."""
    total = first
    for other in others:
        total = tuple(a + b for a, b in zip(total, other, strict=True))
    return total


def vector_difference(a: Vector[S], b: Vector[S]) -> Vector[S]:
    """Return a - b."""
    return tuple(p - q for p, q in zip(a, b, strict=True))
