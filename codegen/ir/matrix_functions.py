"""The exponential and the inverse of a matrix as vector functions (functions whose result is an array)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from codegen.ir import matrix_exponential, matrix_inverse
from codegen.ir.vector_function import VectorFunction

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar
    from codegen.ir.expr import Expr

EXPANDED = 4
"""If the sum exp(A) = 1 + A + A^2/2 + ... has at most this number of non-zero terms, it is written as scalar
formulas. The sum is finite if the zeros in the matrix A imply that a power of A is zero.
"""


@dataclass(frozen=True)
class MatrixExponential(VectorFunction):
    """The exponential of an n x n matrix, and its derivatives (:mod:`codegen.ir.matrix_exponential`).

    For ``level`` = 0 the function maps a matrix to its exponential. The function of level l + 1 computes the
    function of level l and its derivative. It has the arguments of the function of level l, followed by the
    derivatives of these arguments. It returns the results of the function of level l, followed by the
    derivatives of these results. All arguments together are called a jet: a matrix with its derivatives.
    """

    n: int
    level: int = 0

    @property
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""
        return f"expm{self.n}" + (f"_d{self.level}" if self.level else "")

    @property
    def size(self) -> int:
        """The number of arguments, which is also the number of results."""
        return (1 << self.level) * self.n**2

    @property
    def operations(self) -> dict[str, int]:
        """The typical numbers of additions and multiplications in one call. Squarings are not counted."""
        # A product of two jets of level l (matrices with their derivatives) consists of 3^l products of
        # matrices. A Taylor polynomial of degree 12 needs five products of jets.
        products = 5 * 3**self.level * self.n**3
        return {"add": products, "mul": products}

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivatives of the results. ``rates`` are the derivatives of the arguments ``args``.

        The exponential of the next level (``level`` + 1) returns these derivatives in the second half of its
        results.
        """
        space, both = args[0].space, (*args, *rates)
        next_level = MatrixExponential(self.n, self.level + 1)
        expanded = next_level.expanded(both)
        results = space.vector(next_level.name, both) if expanded is None else expanded
        return tuple(results[self.size :])

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return the sum 1 + A + A^2/2 + ... if it has at most :data:`EXPANDED` terms, otherwise None.

        A is the jet ``args`` (a matrix with its derivatives). Its zeros determine the number of terms.
        """
        # ``pattern`` is 1 for each entry of A that may be non-zero, and 0 for all others. It has no negative
        # entries, so nothing cancels in its powers. Hence a zero in a power of ``pattern`` is also a zero in
        # the same power of A.
        pattern = power = [int(not x.is_zero) for x in args]
        # The sum is finite if the first matrix of the jet is nilpotent. The other matrices of the jet are
        # derivatives. They may be arbitrary, because products of more than ``level`` derivatives are zero.
        if not is_nilpotent(self.n, pattern):
            return None
        # ``count`` is the number of terms 1, A, A^2/2, ... that may be non-zero.
        count = 1
        while any(power):
            count += 1
            if count > EXPANDED:
                return None
            power = matrix_exponential.product(self.n, self.level, power, pattern)
        space, size = args[0].space, self.n**2
        diagonal = range(0, size, self.n + 1)
        total = [space.one if k in diagonal else space.zero for k in range(self.size)]
        term = list(args)
        for k in range(1, count):
            # ``term`` is A^k/k! at this point.
            total = [x + y for x, y in zip(total, term, strict=True)]
            divisor = space.coerce(k + 1)
            term = [x / divisor for x in matrix_exponential.product(self.n, self.level, term, args)]
        return tuple(total)

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the exponential in doubles, computed by the same operations as in emitted code."""
        return matrix_exponential.in_doubles(self.n, self.level, args)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the exponential in mpmath numbers with about ``digits`` correct digits."""
        return matrix_exponential.in_digits(context, digits, self.n, self.level, args)

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the exponential of a matrix of truncated power series, and its derivatives.

        ``args`` is a jet: a matrix A, followed by its derivatives. The constant terms of A must form a
        nilpotent matrix.
        """
        # Let N be the nilpotent matrix of the constant terms, so that N^n = 0. All other terms of the jet
        # contain h or a symbol d_k with d_k^2 = 0 (see :mod:`codegen.ir.matrix_exponential`). A product of
        # ``longest`` terms of the jet contains n successive factors N, or a factor d_k twice, or a power of h
        # that is truncated. It is zero in each of these three cases.
        longest = self.n * (ring.order + self.level + 1)
        return matrix_exponential.over_series(ring, longest, self.n, self.level, args)


@dataclass(frozen=True)
class MatrixInverse(VectorFunction):
    """The inverse of an n x n matrix."""

    n: int

    @property
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""
        return f"inverse{self.n}"

    @property
    def size(self) -> int:
        """The number of arguments, which is also the number of results."""
        return self.n**2

    @property
    def operations(self) -> dict[str, int]:
        """The numbers of additions and multiplications of Gauss-Jordan elimination."""
        return {"add": self.n**3, "mul": self.n**3}

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivative of the inverse of a matrix g: -g^-1 g' g^-1, where g' is the derivative of g.

        ``args`` are the entries of g, and ``rates`` are the entries of g'.
        """
        # Differentiation of g g^-1 = 1 gives g' g^-1 + g (g^-1)' = 0, so (g^-1)' = -g^-1 g' g^-1.
        inverse = args[0].space.vector(self.name, args)
        inner = matrix_exponential.product(self.n, 0, rates, inverse)
        return tuple(-x for x in matrix_exponential.product(self.n, 0, inverse, inner))

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return None, because a call of the inverse is never replaced by scalar formulas."""
        return None

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the inverse in doubles, or NaNs for a singular matrix."""
        return matrix_inverse.inverse(self.n, args, 1.0, abs) or (math.nan,) * self.size

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the inverse in mpmath numbers. ZeroDivisionError is raised for a singular matrix."""
        return self._invertible(matrix_inverse.inverse(self.n, args, context.mpf(1), abs))

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the inverse of a matrix of power series.

        ZeroDivisionError is raised if the constant terms of the entries form a singular matrix.
        """

        def size(x: Scalar) -> int:
            # The pivot must be a power series with an inverse, that is, with a non-zero constant term. Its
            # valuation (the lowest power of h) is then 0.
            return int(ring.valuation(x) == 0)

        return self._invertible(matrix_inverse.inverse(self.n, args, ring.one, size))

    def _invertible(self, result: tuple[Scalar, ...] | None) -> tuple[Scalar, ...]:
        if result is None:
            raise ZeroDivisionError("the matrix is singular, so it has no inverse")
        return result


def is_nilpotent(n: int, pattern: Sequence[int]) -> bool:
    """Return True if every n x n matrix with the zeros of ``pattern`` is nilpotent.

    Such a matrix has a zero at each place at which ``pattern`` has a zero. Its other entries are arbitrary.
    The criterion uses the graph on the vertices 0, ..., n - 1 with an edge from i to j for each non-zero
    entry (i, j) of ``pattern``. All such matrices are nilpotent if the graph has no cycle.

    >>> is_nilpotent(2, (0, 1, 0, 0)), is_nilpotent(2, (0, 1, 1, 0))
    (True, False)
    """
    # ``left`` contains the vertices that may be in a cycle.
    left = set(range(n))
    while left:
        # A vertex without an edge to a vertex in ``left`` is in no cycle, so it is removed. If each vertex
        # has such an edge, a cycle exists.
        ends = {i for i in left if not any(pattern[n * i + j] for j in left)}
        if not ends:
            return False
        left -= ends
    return True
