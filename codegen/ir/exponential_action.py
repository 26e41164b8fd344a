"""The product exp(A) y of the exponential of an n x n matrix A and a vector y.

In doubles, the number s is chosen such that the matrix B = A/2^s has a small norm. The vector y is multiplied
2^s times by the Taylor polynomial of exp(B) (A. H. Al-Mohy and N. J. Higham, SIAM J. Sci. Comput. 33 (2011)
488). A multiplication by the Taylor polynomial of degree m replaces y by y + B p/m!. Here the vector p is the
sum of (m!/j!) B^(j-1) y over j = 1, ..., m.

Unlike the coefficients 1/j! of the Taylor polynomial, the integers m!/j! need no rounding.
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
"""The largest number s of halvings of the matrix A. If A needs more halvings, all results are NaN."""

SPARSE = 12
"""If A has more rows than this number, the emitted function contains a loop over all entries of A. For
smaller matrices, the emitted function contains one sum for each row, without the zero entries.
"""


@cache
def degrees(bits: int) -> tuple[int, ...]:
    """Return the degrees of the Taylor polynomials, for floating-point numbers with ``bits`` bits.

    Let m be the largest degree for which the integers m!/j! with 0 <= j <= m need no rounding. The degrees
    are the numbers m, m - 4, m - 8, ... that are larger than 3.

    >>> degrees(53), degrees(24)
    ((6, 10, 14, 18, 22), (5, 9, 13))
    """
    # The Taylor polynomial times m! has the coefficients m!/j!, which are divisors of m!. An integer needs no
    # rounding if its largest odd divisor is below 2^bits. If m! satisfies this condition, each divisor of m!
    # satisfies it, too.
    m = 1
    while _odd(math.factorial(m + 1)) < 2**bits:
        m += 1
    # Emitted code uses the lowest degree in this list that is accurate enough. A list of all degrees up to m
    # would save few operations, so the list contains only every fourth degree.
    return tuple(range(m, 3, -4))[::-1]


def _odd(x: int) -> int:
    # ``x & -x`` is the largest power of two that divides x.
    return x // (x & -x)


@cache
def largest_norms(bits: int) -> tuple[float, ...]:
    """Return the largest matrix norm for which a Taylor polynomial is accurate, for each degree of
    :func:`degrees`.

    The norm is the largest row sum of absolute values. For degree m, the largest norm is
    ((m + 1)! 2^-(bits + 10))^(1/(m + 1)), rounded to three digits. The truncation error of the Taylor
    polynomial is then about 2^-10 times the unit roundoff 2^-bits.

    >>> largest_norms(53)
    (0.0066, 0.0927, 0.349, 0.796, 1.41)
    """
    # ``lgamma(m + 2)`` is the logarithm of (m + 1)!.
    norms = ((math.lgamma(m + 2) - (bits + 10) * math.log(2)) / (m + 1) for m in degrees(bits))
    return tuple(float(f"{math.exp(x):.3g}") for x in norms)


@dataclass(frozen=True)
class ExponentialAction(VectorFunction):
    """The function exp(A) y. The arguments are entries of A, row by row, and the vector y.

    If ``pattern`` is not 0, entry k of A is an argument only if bit k of ``pattern`` is set. All other
    entries are zero.
    """

    n: int
    pattern: int = 0

    @property
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""
        return f"expmv{self.n}" + (f"_{self.pattern:x}" if self.pattern else "")

    @property
    def size(self) -> int:
        """The number of results of the function."""
        return self.n

    @property
    def places(self) -> tuple[int, ...]:
        """The indices n i + j of the entries A_ij that are arguments of the function."""
        return tuple(k for k in range(self.n**2) if not self.pattern or self.pattern >> k & 1)

    @property
    def rows(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        """One tuple of pairs (k, j) for each row of A: argument k of the function is the entry in column j.

        If all entries of a 2 x 2 matrix are arguments, the rows are ((0, 0), (1, 1)) and ((2, 0), (3, 1)).
        """
        entries = list(enumerate(self.places))
        return tuple(
            tuple((k, place % self.n) for k, place in entries if place // self.n == i) for i in range(self.n)
        )

    @property
    def arrays(self) -> tuple[int, ...]:
        """The lengths of the two argument arrays. The first array contains the entries of A at the
        indices :attr:`places`. The second array is the vector y.
        """
        return (len(self.places), self.n)

    @property
    def operations(self) -> dict[str, int]:
        """The numbers of additions and multiplications in one call, for a Taylor polynomial of degree 18."""
        products = 18 * (len(self.places) + self.n)
        return {"add": products, "mul": products}

    def matrix(self, args: Sequence[Scalar], zero: Scalar) -> list[Scalar]:
        """Return all entries of A, row by row.

        ``args`` begins with the entries of A at the indices :attr:`places`. All other entries are ``zero``.
        """
        result = [zero] * self.n**2
        for place, x in zip(self.places, args, strict=False):
            result[place] = x
        return result

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivative of exp(A) y in the direction ``rates``.

        ``args`` are A and y, and ``rates`` are their derivatives A' and y'. The result is the first half of
        the vector exp([[A, A'], [0, A]]) (y', y).
        """
        space, n, entries = args[0].space, self.n, len(self.places)
        a, e = (self.matrix(x[:entries], space.zero) for x in (args, rates))
        y, v = args[entries:], rates[entries:]
        zeros = [space.zero] * n
        # ``block`` becomes the matrix [[a, e], [0, a]], where ``e`` is the derivative of ``a``.
        block = [x for i in range(n) for x in (*a[n * i : n * i + n], *e[n * i : n * i + n])]
        block += [x for i in range(n) for x in (*zeros, *a[n * i : n * i + n])]
        larger = ExponentialAction(2 * n)
        both = (*block, *v, *y)
        # The block matrix contains zeros. If ``expanded`` can omit these zeros, it returns simpler
        # expressions for the results, otherwise None.
        expanded = larger.expanded(both)
        results = space.vector(larger.name, both) if expanded is None else expanded
        # The first half of ``results`` is the derivative of exp(A) y, and the second half is exp(A) y itself.
        return tuple(results[:n])

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return simpler expressions for exp(A) y, or None.

        - If ``pattern`` is not 0, the result is None.
        - If A is zero, the result is y.
        - If A has at most :data:`SPARSE` rows, the expressions are calls of an :class:`ExponentialAction`
          with a ``pattern`` that omits the zero entries of A.
        - If A has more rows, the result is None.
        """
        # If ``pattern`` is not 0, the arguments already omit the zero entries of A, so no simpler form is
        # returned.
        if self.pattern:
            return None
        size = self.n**2
        # Bit k of the pattern is set if entry k is not the constant 0.
        pattern = sum(1 << k for k, x in enumerate(args[:size]) if not x.is_zero)
        # If A = 0, then exp(A) y = y.
        if not pattern:
            return tuple(args[size:])
        # For a large matrix, a loop over all entries is shorter than separate sums for the rows.
        if self.n > SPARSE:
            return None
        own = ExponentialAction(self.n, pattern)
        return args[0].space.vector(own.name, (*(args[k] for k in own.places), *args[size:]))

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return exp(A) y for doubles. Emitted code computes exp(A) y by the same operations."""
        entries, rows = len(self.places), self.rows
        a, y = list(args[:entries]), list(args[entries:])
        # ``norm`` is the largest row sum of absolute values.
        norm = 0.0
        for row in rows:
            total = 0.0
            for k, _ in row:
                total += abs(a[k])
            norm = max(norm, total)
        norms = largest_norms(53)
        scale, parts = 1.0, 1
        # For an infinite norm, the test ``parts < 2**HALVINGS`` ends the loop.
        while norm * scale > norms[-1] and parts < 2**HALVINGS:
            scale, parts = 0.5 * scale, 2 * parts
        norm *= scale
        # ``norm`` is never a NaN, because ``max`` ignores a NaN in its second argument. If an entry of A is a
        # NaN, the entries of the result that depend on it are NaN, too.
        if norm > norms[-1]:
            return (math.nan,) * self.n
        # ``scale`` is a power of two, so this product causes no rounding errors.
        a = [x * scale for x in a]
        # The smallest sufficient degree is used.
        degree = next(m for m, bound in zip(degrees(53), norms, strict=True) if norm <= bound)
        for _ in range(parts):
            p, weight = y, 1.0
            for k in range(degree, 1, -1):
                # With m = ``degree``, the next line changes ``weight`` from m!/k! to m!/(k - 1)!.
                weight *= k
                # This step of Horner's rule needs no division. The division by m! follows after the loop.
                p = [x + weight * z for x, z in zip(_product(rows, a, p), y, strict=True)]
            # The new y is y + B p/m!. Here B is the matrix ``a``, m is ``degree``, and ``weight`` is m!.
            y = [z + x for z, x in zip(y, _product(rows, a, [x / weight for x in p]), strict=True)]
        return tuple(y)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return exp(A) y. ``args`` contains mpmath numbers: entries of A, then y.

        OverflowError is raised if an entry of the n x n matrix A is a NaN, or has an absolute value of 2^40/n
        or more.
        """
        entries, rows = len(self.places), self.rows
        # All numbers in ``sizes`` are compared with 2^40, because ``max(sizes)`` may be finite although one
        # of the numbers is a NaN. The comparison of a NaN is false, so the error is raised.
        sizes = [abs(x) * self.n for x in args[:entries]]
        if not all(x < 2**40 for x in sizes):
            raise OverflowError("the norm of the matrix is too large for its exponential")
        # The largest absolute entry times n is a bound for all row sums.
        largest = max(sizes, default=0)
        # The norm of A/``parts`` is below 1, so the Taylor series of exp(A/``parts``) loses only few digits
        # by cancellation.
        parts = int(largest) + 1
        work = context.clone()
        # Each product with exp(A/``parts``) adds a rounding error, so the working precision is higher than
        # the requested precision.
        work.dps = digits + 15 + len(str(parts))
        a = [work.mpf(x) / parts for x in args[:entries]]
        y = [work.mpf(x) for x in args[entries:]]
        for _ in range(parts):
            term, k = y, 0
            # The sum ends when all entries of a term are negligible at the working precision.
            while any(abs(x) > work.eps * max(1, max(map(abs, y))) for x in term):
                k += 1
                term = [x / k for x in _product(rows, a, term)]
                y = [x + z for x, z in zip(y, term, strict=True)]
        # The conversion rounds the results to the precision of the caller.
        return tuple(context.mpf(x) for x in y)

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the exact value of exp(A) y for truncated power series.

        The result is the sum of A^k y/k! over k = 0, 1, .... If the constant terms of the entries of A form a
        nilpotent matrix, only finitely many terms are nonzero. If infinitely many terms are nonzero,
        :class:`ArithmeticError` is raised.
        """
        entries, rows = len(self.places), self.rows
        total = term = list(args[entries:])
        # The vector y has n entries with ``ring.order`` + 1 coefficients each, in total N coefficients. By
        # linear algebra, if A^k y = 0 for some k, then A^N y = 0. The loop finds this zero term, because
        # N = n (``ring.order`` + 1) is less than ``longest``.
        longest = self.n * (ring.order + 2)
        for k in range(1, longest + 1):
            factor = ring.rational(1, k)
            term = [factor * x for x in _product(rows, args[:entries], term, ring.zero)]
            # After a zero term, all terms are zero.
            if all(ring.is_zero(x) is True for x in term):
                return tuple(total)
            total = [x + z for x, z in zip(total, term, strict=True)]
        raise ArithmeticError(f"the exponential series of a matrix does not end within {longest} terms")


def _product(
    rows: Sequence[Sequence[tuple[int, int]]], a: Sequence[Scalar], y: Sequence[Scalar], zero: Scalar = 0.0
) -> list[Scalar]:
    """Return A y.

    For each pair (k, j) in ``rows[i]``, ``a[k]`` is the entry of A in row i and column j.
    """
    result = []
    for row in rows:
        terms = [a[k] * y[j] for k, j in row]
        # If ``row`` is empty, ``terms`` is empty.
        total = terms[0] if terms else zero
        for x in terms[1:]:
            total = total + x
        result.append(total)
    return result
