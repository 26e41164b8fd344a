"""The exponential and the inverse of a matrix as vector functions."""

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
"""The exponential of a matrix A is expanded as a polynomial if the zeros in A imply that A^``EXPANDED`` is
zero.
"""


@dataclass(frozen=True)
class MatrixExponential(VectorFunction):
    """The exponential of a jet of n x n matrices (:mod:`codegen.ir.matrix_exponential`).

    Level 0 is the exponential of a matrix. The arguments of level l + 1 are the arguments of level l followed
    by their derivatives. The results of level l + 1 are the results of level l followed by their derivatives.
    """

    n: int
    level: int = 0

    @property
    def name(self) -> str:
        """The name in expressions and in emitted code."""
        return f"expm{self.n}" + (f"_d{self.level}" if self.level else "")

    @property
    def size(self) -> int:
        """The number of arguments and of results."""
        return (1 << self.level) * self.n**2

    @property
    def operations(self) -> dict[str, int]:
        """A typical number of operations of a call, without squarings."""
        # A product of two jets of level l consists of 3^l products of matrices. A polynomial of degree 12
        # needs five products of jets.
        products = 5 * 3**self.level * self.n**3
        return {"add": products, "mul": products}

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivatives of the results. These are the second half of the next level's results."""
        space, both = args[0].space, (*args, *rates)
        # The next level has one more symbol d with d^2 = 0. Its factor in the result is the derivative.
        next_level = MatrixExponential(self.n, self.level + 1)
        expanded = next_level.expanded(both)
        results = space.vector(next_level.name, both) if expanded is None else expanded
        return tuple(results[self.size :])

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return the sum 1 + A + A^2/2 + ... if it has at most :data:`EXPANDED` terms, otherwise None.

        The number of terms follows from the zeros in A.
        """
        # The pattern has the number 1 for each entry that may be non-zero. Its powers have no cancellation,
        # so a zero in such a power is also a zero in the same power of A.
        pattern = power = [int(not x.is_zero) for x in args]
        # Only the first matrix of the jet is tested. Each derivative contains a symbol d_k with square zero,
        # so a non-zero product contains few derivatives.
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
        """Return the exponential in doubles."""
        return matrix_exponential.in_doubles(self.n, self.level, args)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the exponential for mpmath numbers."""
        return matrix_exponential.in_digits(context, digits, self.n, self.level, args)

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the exponential for power series. The constant terms of the first matrix must be
        nilpotent.
        """
        # A product of ``longest`` factors is zero. Each of its terms contains a truncated power of h, the
        # square of a symbol d_k, or n successive factors equal to the same nilpotent matrix.
        longest = self.n * (ring.order + self.level + 1)
        return matrix_exponential.over_series(ring, longest, self.n, self.level, args)


@dataclass(frozen=True)
class MatrixInverse(VectorFunction):
    """The inverse of an n x n matrix."""

    n: int

    @property
    def name(self) -> str:
        """The name in expressions and in emitted code."""
        return f"inverse{self.n}"

    @property
    def size(self) -> int:
        """The number of arguments and of results."""
        return self.n**2

    @property
    def operations(self) -> dict[str, int]:
        """The number of operations of Gauss-Jordan elimination."""
        return {"add": self.n**3, "mul": self.n**3}

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivative of the inverse of g: -g^-1 r g^-1, where r is the derivative of g."""
        # Differentiation of g g^-1 = 1 gives r g^-1 + g (g^-1)' = 0.
        inverse = args[0].space.vector(self.name, args)
        inner = matrix_exponential.product(self.n, 0, rates, inverse)
        return tuple(-x for x in matrix_exponential.product(self.n, 0, inverse, inner))

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return None, because a call of the inverse is never replaced by expressions."""
        return None

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the inverse in doubles, or NaNs for a singular matrix."""
        return matrix_inverse.inverse(self.n, args, 1.0, abs) or (math.nan,) * self.size

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the inverse for mpmath numbers. ZeroDivisionError is raised for a singular matrix."""
        return self._invertible(matrix_inverse.inverse(self.n, args, context.mpf(1), abs))

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the inverse of a matrix of power series.

        ZeroDivisionError is raised if the constant terms of the entries form a singular matrix.
        """

        def size(x: Scalar) -> int:
            # A power series has an inverse only if its constant term is not zero. Valuation 0 means such a
            # term.
            return int(ring.valuation(x) == 0)

        return self._invertible(matrix_inverse.inverse(self.n, args, ring.one, size))

    def _invertible(self, result: tuple[Scalar, ...] | None) -> tuple[Scalar, ...]:
        if result is None:
            raise ZeroDivisionError("the matrix is singular, so it has no inverse")
        return result


def is_nilpotent(n: int, pattern: Sequence[int]) -> bool:
    """Return True if every n x n matrix with zeros at the zeros of ``pattern`` is nilpotent.

    The criterion uses a graph with an edge from i to j for each non-zero entry (i, j) of ``pattern``. The
    matrices are nilpotent if the graph has no cycle.

    >>> is_nilpotent(2, (0, 1, 0, 0)), is_nilpotent(2, (0, 1, 1, 0))
    (True, False)
    """
    # ``left`` contains the vertices that may be in a cycle.
    left = set(range(n))
    while left:
        # A vertex without an edge to the remaining vertices is in no cycle, so it is removed. If there is no
        # such vertex, a cycle exists.
        ends = {i for i in left if not any(pattern[n * i + j] for j in left)}
        if not ends:
            return False
        left -= ends
    return True
