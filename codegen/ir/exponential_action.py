"""The action exp(A) y of the exponential of an n x n matrix on a vector, without the matrix exp(A).

In doubles the matrix A is halved s times, until its largest row sum is small. Then a Taylor polynomial of
exp(A 2^-s) is applied 2^s times (A. H. Al-Mohy and N. J. Higham, SIAM J. Sci. Comput. 33 (2011) 488). For a
matrix A, the polynomial of degree m is y + A (p/m!). Horner's rule computes p, which is the sum of (m!/j!)
A^(j-1) y for j = 1, ..., m.

The integers m!/j! are exact in floating-point arithmetic. Rounded coefficients 1/j! would cause the same
error in every step, so the length of y would drift if A is skew. Emitted code executes the same operations in
the same order (:mod:`codegen.run.exponential_action`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from codegen.ir.vector_function import VectorFunction

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar
    from codegen.ir.expr import Expr

HALVINGS = 13
"""The largest number s of halvings. The Taylor polynomial is applied 2^s times, so a larger s would take too
long. If a matrix needs more halvings, every result is NaN.
"""

SPARSE = 12
"""For matrices with at most this number of rows, the arguments of a call are y and the non-zero entries of A.
For such a matrix, emitted code has one sum for each row, without a loop.
"""


@cache
def degrees(bits: int) -> tuple[int, ...]:
    """Return the degrees of the Taylor polynomials.

    The largest degree is the largest m for which all integers m!/j!, 0 <= j <= m, are floating-point numbers
    with ``bits`` binary digits. The other degrees are smaller by 4, 8, and so on.

    >>> degrees(53), degrees(24)
    ((6, 10, 14, 18, 22), (5, 9, 13))
    """
    # An integer is exact if its odd part fits into the significand. For j > 0 the odd part of m!/j! divides
    # that of m!, so the test of m! is sufficient.
    m = 1
    while _odd(math.factorial(m + 1)) < 2**bits:
        m += 1
    # Steps of 4 keep the table short. A degree that is too large by 3 costs only three more products by A.
    return tuple(range(m, 3, -4))[::-1]


def _odd(x: int) -> int:
    # x & -x is the largest power of two that divides x.
    return x // (x & -x)


@cache
def largest_norms(bits: int) -> tuple[float, ...]:
    """Return, for each degree m, the largest row sum of a matrix for which this degree is used.

    The row sum is ((m + 1)! 2^-(bits + 10))^(1/(m + 1)), rounded to three digits. The remainder of the Taylor
    polynomial is then below 2^-10 times the unit roundoff. The bound of the remainder is so small, because
    the remainder changes the length of y by the same amount in every step.

    >>> largest_norms(53)
    (0.0066, 0.0927, 0.349, 0.796, 1.41)
    """
    # lgamma(m + 2) is the logarithm of (m + 1)!.
    norms = ((math.lgamma(m + 2) - (bits + 10) * math.log(2)) / (m + 1) for m in degrees(bits))
    return tuple(float(f"{math.exp(x):.3g}") for x in norms)


@dataclass(frozen=True)
class ExponentialAction(VectorFunction):
    """The function exp(A) y. Its arguments are the entries of A, row by row, and y.

    If ``pattern`` is not zero, an entry k of A is an argument only if bit k of the pattern is set. All other
    entries are zero.
    """

    n: int
    pattern: int = 0

    @property
    def name(self) -> str:
        """The name in expressions and in emitted code."""
        return f"expmv{self.n}" + (f"_{self.pattern:x}" if self.pattern else "")

    @property
    def size(self) -> int:
        """The number of results."""
        return self.n

    @property
    def places(self) -> tuple[int, ...]:
        """The positions, counted row by row, of those entries of the matrix that are arguments."""
        return tuple(k for k in range(self.n**2) if not self.pattern or self.pattern >> k & 1)

    @property
    def rows(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        """For each row of the matrix, the entries that are arguments.

        An entry is given as the pair (index among the arguments, column).
        """
        entries = list(enumerate(self.places))
        return tuple(
            tuple((k, place % self.n) for k, place in entries if place // self.n == i) for i in range(self.n)
        )

    @property
    def arrays(self) -> tuple[int, ...]:
        """The number of entries of the matrix that are arguments, and the length of the vector."""
        return (len(self.places), self.n)

    @property
    def operations(self) -> dict[str, int]:
        """The number of operations of exp(A) y for a polynomial of degree 18 without halvings."""
        products = 18 * (len(self.places) + self.n)
        return {"add": products, "mul": products}

    def matrix(self, args: Sequence[Scalar], zero: Scalar) -> list[Scalar]:
        """Return all entries of the matrix."""
        result = [zero] * self.n**2
        for place, x in zip(self.places, args, strict=False):
            result[place] = x
        return result

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivative of exp(A) y, where ``args`` are A and y, and ``rates`` are their derivatives
        A' and y'.

        The vector exp([[A, A'], [0, A]]) (y', y) has two halves. The first half is this derivative, and the
        second half is exp(A) y.
        """
        space, n, entries = args[0].space, self.n, len(self.places)
        a, e = (self.matrix(x[:entries], space.zero) for x in (args, rates))
        y, v = args[entries:], rates[entries:]
        zeros = [space.zero] * n
        # The block matrix has the rows (A, A') and (0, A). It is stored row by row.
        block = [x for i in range(n) for x in (*a[n * i : n * i + n], *e[n * i : n * i + n])]
        block += [x for i in range(n) for x in (*zeros, *a[n * i : n * i + n])]
        larger = ExponentialAction(2 * n)
        both = (*block, *v, *y)
        # The block of zeros leaves gaps in the larger matrix, so its call may have a shorter form.
        expanded = larger.expanded(both)
        results = space.vector(larger.name, both) if expanded is None else expanded
        return tuple(results[:n])

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return exp(A) y in a simpler form if one exists, otherwise None.

        If A is zero, the result is y. If A has at most :data:`SPARSE` rows, the zero entries of A are removed
        from the arguments.
        """
        # The zeros of a matrix with a pattern have already been removed.
        if self.pattern:
            return None
        size = self.n**2
        # Bit k of the pattern is set if entry k is not the constant 0.
        pattern = sum(1 << k for k, x in enumerate(args[:size]) if not x.is_zero)
        # exp(0) y is y, so no function is called.
        if not pattern:
            return tuple(args[size:])
        # A large matrix stays an array, because one sum for each row would be long code.
        if self.n > SPARSE:
            return None
        own = ExponentialAction(self.n, pattern)
        return args[0].space.vector(own.name, (*(args[k] for k in own.places), *args[size:]))

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return exp(A) y in doubles."""
        entries, rows = len(self.places), self.rows
        a, y = list(args[:entries]), list(args[entries:])
        # The largest row sum of absolute values is the norm that belongs to the maximum norm of vectors.
        norm = 0.0
        for row in rows:
            total = 0.0
            for k, _ in row:
                total += abs(a[k])
            norm = max(norm, total)
        norms = largest_norms(53)
        scale, parts = 1.0, 1
        # The second test ends the loop if the norm is infinite.
        while norm * scale > norms[-1] and parts < 2**HALVINGS:
            scale, parts = 0.5 * scale, 2 * parts
        norm *= scale
        # This test is also true for a NaN.
        if not norm <= norms[-1]:
            return (math.nan,) * self.n
        # ``scale`` is a power of two, so this product causes no rounding errors.
        a = [x * scale for x in a]
        # The smallest sufficient degree costs the least.
        degree = next(m for m, bound in zip(degrees(53), norms, strict=True) if norm <= bound)
        for _ in range(parts):
            p, weight = y, 1.0
            for k in range(degree, 1, -1):
                # After this product, ``weight`` is m!/(k - 1)! for the degree m. It is an exact integer.
                weight *= k
                # Horner's rule without divisions: p becomes A p + ``weight`` y.
                p = [x + weight * z for x, z in zip(_product(rows, a, p), y, strict=True)]
            # ``weight`` is now m!, so the new vector is y + A (p/m!).
            y = [z + x for z, x in zip(y, _product(rows, a, [x / weight for x in p]), strict=True)]
        return tuple(y)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return exp(A) y for mpmath numbers.

        :class:`OverflowError` is raised if n times the largest absolute value of an entry is 2^40 or more.
        """
        entries, rows = len(self.places), self.rows
        largest = max((abs(x) for x in args[:entries]), default=0) * self.n
        if not largest < 2**40:
            raise OverflowError("the norm of the matrix is too large for its exponential")
        # exp(A) y is computed by applying exp(A/parts) repeatedly. The norm of A/parts is below 1, so each
        # series loses only few digits.
        # ``largest`` is a bound of all row sums, and ``parts`` is larger.
        parts = int(largest) + 1
        work = context.clone()
        # Each of the ``parts`` passes adds a rounding error, so further digits are needed.
        work.dps = digits + 15 + len(str(parts))
        a = [work.mpf(x) / parts for x in args[:entries]]
        y = [work.mpf(x) for x in args[entries:]]
        for _ in range(parts):
            term, k = y, 0
            # The sum ends when a term is below the working precision.
            while any(abs(x) > work.eps * max(1, max(map(abs, y))) for x in term):
                k += 1
                term = [x / k for x in _product(rows, a, term)]
                y = [x + z for x, z in zip(y, term, strict=True)]
        # The conversion rounds the results to the precision of the caller.
        return tuple(context.mpf(x) for x in y)

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return exp(A) y for power series, exactly. The constant terms of A must form a nilpotent matrix."""
        entries, rows = len(self.places), self.rows
        total = term = list(args[entries:])
        # A product of n (order + 1) factors A is zero. Each of its terms contains a truncated power of h, or
        # n successive factors equal to the constant term of A, a nilpotent matrix.
        longest = self.n * (ring.order + 2)
        for k in range(1, longest + 1):
            factor = ring.rational(1, k)
            term = [factor * x for x in _product(rows, args[:entries], term, ring.zero)]
            # Each later term is a multiple of A times the term before, so it is zero, too.
            if all(ring.is_zero(x) is True for x in term):
                return tuple(total)
            total = [x + z for x, z in zip(total, term, strict=True)]
        raise ArithmeticError(f"an exponential series does not end within {longest} terms")


def _product(
    rows: Sequence[Sequence[tuple[int, int]]], a: Sequence[Scalar], y: Sequence[Scalar], zero: Scalar = 0.0
) -> list[Scalar]:
    """Return A y. For each row of A, ``rows`` contains the pairs (index in ``a``, column) of its entries."""
    result = []
    for row in rows:
        terms = [a[k] * y[j] for k, j in row]
        # A row without entries gives 0.
        total = terms[0] if terms else zero
        for x in terms[1:]:
            total = total + x
        result.append(total)
    return result
