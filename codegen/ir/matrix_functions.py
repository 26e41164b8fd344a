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
"""If the sum 1 + A + A^2/2 + ... has at most this number of non-zero terms, exp(A) is computed by scalar
formulas.
"""


@dataclass(frozen=True)
class MatrixExponential(VectorFunction):
    """The exponential of an n x n matrix, and its derivatives (:mod:`codegen.ir.matrix_exponential`).

    For ``level`` = 0 the function maps a matrix A to exp(A). For ``level`` = 1 the arguments are A and a
    derivative of A, and the results are exp(A) and the derivative of exp(A).

    Each further level doubles the number of matrices. The arguments for ``level`` = k + 1 are the arguments
    for ``level`` = k, followed by a derivative of each argument. The results for ``level`` = k + 1 are the
    results for ``level`` = k, followed by a derivative of each result.
    """

    n: int
    level: int = 0

    @property
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""
        return f"expm{self.n}" + (f"_d{self.level}" if self.level else "")

    @property
    def size(self) -> int:
        """The number of arguments, equal to the number of results."""
        return (1 << self.level) * self.n**2

    @property
    def operations(self) -> dict[str, int]:
        """Approximate numbers of additions and multiplications in one call.

        In the method of scaling and squaring, the squarings are not counted.
        """
        # A Taylor polynomial of degree 12 requires five products. Each level adds a derivative, so each
        # product a b is replaced by three products: a b, a' b and a b'.
        products = 5 * 3**self.level * self.n**3
        return {"add": products, "mul": products}

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivatives of the results. ``rates`` are the derivatives of the arguments ``args``."""
        space, both = args[0].space, (*args, *rates)
        next_level = MatrixExponential(self.n, self.level + 1)
        expanded = next_level.expanded(both)
        results = space.vector(next_level.name, both) if expanded is None else expanded
        # ``results`` contains the values of this function, then their derivatives.
        return tuple(results[self.size :])

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return the sum of the terms A^k/k! if at most :data:`EXPANDED` terms are non-zero, otherwise None.

        A is the jet ``args`` (a matrix with its derivatives).
        """
        # Where the k-th power of ``pattern`` has a zero, A^k has a zero, too.
        pattern = power = [int(not x.is_zero) for x in args]
        # The sum 1 + A + A^2/2 + ... has finitely many terms only if A is nilpotent. This test is cheaper
        # than the computation of powers of A.
        if not is_nilpotent(self.n, pattern):
            return None
        # The loop counts the nonzero powers of A, beginning with A^0.
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
            # At the beginning of pass k, ``term`` is A^k/k!.
            total = [x + y for x, y in zip(total, term, strict=True)]
            divisor = space.coerce(k + 1)
            term = [x / divisor for x in matrix_exponential.product(self.n, self.level, term, args)]
        return tuple(total)

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the results for the doubles ``args``, by the same operations as in emitted code."""
        return matrix_exponential.in_doubles(self.n, self.level, args)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results for the mpmath numbers ``args``, with about ``digits`` digits."""
        return matrix_exponential.in_digits(context, self.n, self.level, args)

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return exp(A), followed by the derivatives of exp(A). The entries are truncated power series.

        ``args`` contains A, followed by the derivatives of A. The matrix of the constant terms of A must be
        nilpotent.
        """
        # If the constant terms of A form a nilpotent matrix, all terms of degree ``longest`` or higher in the
        # Taylor series of the exponential are zero.
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
        """The number of arguments, equal to the number of results."""
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
        """Return None: an inverse is never replaced by scalar formulas."""
        return None

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the inverse in doubles, or NaNs if the matrix is singular or not finite."""
        return matrix_inverse.inverse(self.n, args, 1.0, abs) or (math.nan,) * self.size

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the inverse in mpmath numbers. ZeroDivisionError is raised for a singular matrix."""
        return self._invertible(matrix_inverse.inverse(self.n, args, context.mpf(1), abs))

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the inverse of a matrix of power series.

        ZeroDivisionError is raised if the constant terms of the entries form a singular matrix.
        """

        def size(x: Scalar) -> int:
            # A pivot must have an inverse, so its valuation (the lowest exponent of h) must be 0.
            return int(ring.valuation(x) == 0)

        return self._invertible(matrix_inverse.inverse(self.n, args, ring.one, size))

    def _invertible(self, result: tuple[Scalar, ...] | None) -> tuple[Scalar, ...]:
        if result is None:
            raise ZeroDivisionError("the matrix is singular, so it has no inverse")
        return result


def is_nilpotent(n: int, pattern: Sequence[int]) -> bool:
    """Return True if every n x n matrix with zeros at the zeros of ``pattern`` is nilpotent.

    Each non-zero entry (i, j) of ``pattern`` is an edge from i to j of a graph. The function returns True if
    this graph has no cycle.

    >>> is_nilpotent(2, (0, 1, 0, 0)), is_nilpotent(2, (0, 1, 1, 0))
    (True, False)
    """
    # Each pass of the loop removes vertices from ``left``. The removed vertices are in no cycle.
    left = set(range(n))
    while left:
        # ``ends`` contains the vertices without edges to vertices in ``left``. These vertices are in no
        # cycle, so they are removed next. If ``ends`` is empty, the graph has a cycle.
        ends = {i for i in left if not any(pattern[n * i + j] for j in left)}
        if not ends:
            return False
        left -= ends
    return True
