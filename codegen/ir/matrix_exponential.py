"""The exponential of an n x n matrix, and the derivatives of the exponential.

A jet of level 1 is a sum A + d E, where A and E are matrices and d is a symbol with d^2 = 0. The exponential
of this jet is exp(A) + d L. Here L is the derivative of exp at A in the direction E.

A jet of level l contains l symbols d_0, ..., d_(l-1) with d_k^2 = 0. The jet is the sum of the terms A_m e_m
for m = 0, ..., 2^l - 1. Here A_m is a matrix, and e_m is the product of the symbols d_k for which bit k of m
is 1. The matrices are stored in the order A_0, A_1, ..., and each matrix is stored row by row.

In double precision the exponential is computed by scaling and squaring (N. J. Higham, *Functions of
Matrices*, SIAM 2008, ch. 10). A Taylor polynomial of degree 4, 8, 12 or 16 is evaluated by the method of
Paterson and Stockmeyer. Emitted code executes the same operations in the same order
(:mod:`codegen.run.matrix_functions`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from itertools import chain
from typing import TYPE_CHECKING, Any

from codegen.ir import matrix_balls

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar

DEGREES = (4, 8, 12, 16)
"""The degrees of the Taylor polynomials."""

LEAST_DIGITS = 10
"""The least number of correct binary digits in the exponential exp(A) of a matrix A. If the estimated error
of exp(A) is larger than 2^-LEAST_DIGITS times the Frobenius norm of exp(A), all results are NaN.
"""

Pairs = tuple[tuple[tuple[int, int], ...], ...]


@cache
def pairs(level: int) -> Pairs:
    """Return the pairs of indices that define the product of two jets of level ``level``.

    A jet is a matrix with its derivatives. A jet of level l consists of 2^l matrices. Let the jets A and B
    consist of the matrices A_j and B_k. Matrix m of the product A B is the sum of A_j B_k over the pairs
    (j, k) in entry m of the returned tuple.

    >>> pairs(1)
    (((0, 0),), ((0, 1), (1, 0)))
    """
    # Term j of the jet A is the matrix A_j times a product of symbols d_i. The symbol d_i is a factor of this
    # product if bit i of the number j is 1. If bit i is 1 in the numbers j and k of two terms, the product of
    # the two terms is zero, because d_i^2 = 0.
    masks = range(2**level)
    return tuple(tuple((a, m ^ a) for a in masks if a & m == a) for m in masks)


@cache
def largest_norms(bits: int) -> tuple[float, ...]:
    """Return the largest matrix norms for which the Taylor polynomials of :data:`DEGREES` are used.

    The largest norm for degree m is (m! 2^-(bits + 2))^(1/m), rounded to three digits. For smaller norms, the
    error of the polynomial is below a quarter of the unit roundoff 2^-``bits``.

    >>> largest_norms(53)
    (0.000161, 0.0321, 0.221, 0.628)
    """
    return tuple(
        float(f"{math.exp((math.lgamma(m + 1) - (bits + 2) * math.log(2)) / m):.3g}") for m in DEGREES
    )


def in_doubles(n: int, level: int, a: Sequence[float]) -> tuple[float, ...]:
    """Return the exponential of a jet in double precision.

    ``a`` contains the entries of the 2^``level`` matrices of the jet (see the module docstring).

    All results are NaN if fewer than three decimal digits are reliable.
    """
    size = n * n
    scale, squarings, norm = _halvings(_norm(a[:size]))
    # The norm of the first matrix determines ``scale``, and all matrices are multiplied by ``scale``.
    total = _polynomial(n, level, [x * scale for x in a], norm)
    if squarings:
        total = _squared(n, level, total, squarings, _growth(n, a, scale))
    # If the norm is too large after the largest number of halvings, the results are NaN.
    if norm > largest_norms(53)[-1]:
        total = [math.nan] * len(total)
    return tuple(total)


def _halvings(norm: float) -> tuple[float, int, float]:
    """Return the scale 2^-s, the number s of halvings, and the norm of the scaled matrix."""
    scale, squarings = 1.0, 0
    # Each squaring approximately doubles the relative error. After 53 squarings, no digit is correct.
    while norm * scale > largest_norms(53)[-1] and squarings < 53:
        # A power of two scales a double without rounding, apart from underflow.
        scale *= 0.5
        squarings += 1
    return scale, squarings, norm * scale


def _norm(a: Sequence[float]) -> float:
    """Return the Frobenius norm of the matrix with the entries ``a``."""
    total = 0.0
    for x in a:
        total += x * x
    return math.sqrt(total)


def product(n: int, level: int, a: Sequence[Scalar], b: Sequence[Scalar]) -> list[Scalar]:
    """Return the product of the jets ``a`` and ``b``.

    A jet contains 2^``level`` matrices of size n x n: a matrix A and derivatives of A (see the module
    docstring).
    """
    size, rows = n * n, range(n)
    result: list[Scalar] = []
    for parts in pairs(level):
        factors = [(a[size * p : size * p + size], b[size * q : size * q + size]) for p, q in parts]
        # The products x y of the pairs (x, y) in ``factors`` are added.
        left = [[x[n * i : n * i + n] for i in rows] for x, _ in factors]
        right = [[y[j::n] for j in rows] for _, y in factors]
        for i in rows:
            for j in rows:
                # Entry (i, j) of the sum of all matrix products x y is the sum of the numbers x_ik y_kj over
                # all k and over all pairs (x, y).
                pairs_of = [zip(x[i], y[j], strict=True) for x, y in zip(left, right, strict=True)]
                merged = (
                    pairs_of[0] if len(pairs_of) == 1 else chain.from_iterable(zip(*pairs_of, strict=True))
                )
                # The sum begins with the first product and not with 0, to save one addition.
                x, y = next(merged)
                total = x * y
                for x, y in merged:
                    total = total + x * y
                result.append(total)
    return result


def _polynomial(n: int, level: int, b1: list[float], norm: float) -> list[float]:
    """Return the Taylor polynomial of the exponential, evaluated at the jet ``b1``.

    The list ``b1`` contains the entries of a matrix A, followed by the entries of derivatives of A. The norm
    ``norm`` of A determines the degree of the polynomial (:func:`largest_norms`).
    """
    # The degree of the polynomial is 4 * ``groups``. Group g contains the terms of degrees 4 g to 4 g + 3.
    # The term of the highest degree is in no group.
    groups = 1 + sum(norm > bound for bound in largest_norms(53)[:-1])
    c = [1 / math.factorial(k) for k in range(DEGREES[-1] + 1)]
    b2 = product(n, level, b1, b1)
    b3, b4 = product(n, level, b2, b1), product(n, level, b2, b2)
    # Horner's rule in powers of ``b4`` begins with the coefficient of the highest power.
    total = [c[4 * groups] * x for x in b4]
    for group in reversed(range(groups)):
        k = 4 * group
        if group < groups - 1:
            total = product(n, level, total, b4)
        # Adding the largest terms last reduces rounding errors.
        terms = zip(total, b3, b2, b1, strict=True)
        total = [((w + c[k + 3] * x) + c[k + 2] * y) + c[k + 1] * z for w, x, y, z in terms]
        for i in range(n):
            # The last term of the group is c[k] times the unit matrix. This term has no derivatives, so it
            # changes only the first matrix of ``total``.
            total[(n + 1) * i] += c[k]
    return total


def _growth(n: int, a: Sequence[float], scale: float) -> float:
    """Return a bound of the spectral norm of exp(``scale`` * ``a``), where ``a`` is an n x n matrix.

    Gershgorin's circles give an upper bound b of the eigenvalues of the symmetric part of ``a``. The bound of
    the norm is exp(``scale`` * b).
    """
    # ``largest`` becomes b, the maximum of ``total`` over all rows. It does not begin at 0, because b may be
    # negative.
    largest = a[0]
    for i in range(n):
        total = a[(n + 1) * i]
        for j in range(n):
            if j != i:
                # The symmetric part (A + A^T)/2 has the entry (a_ij + a_ji)/2 at (i, j).
                total += 0.5 * abs(a[n * i + j] + a[n * j + i])
        largest = max(largest, total)
    # As in emitted code, the exponential of ``largest * scale`` is computed by a Taylor polynomial.
    *rest, result = (1 / math.factorial(k) for k in range(DEGREES[-1] + 1))
    for c in reversed(rest):
        result = c + (largest * scale) * result
    return result


def _squared(n: int, level: int, total: list[float], squarings: int, growth: float) -> list[float]:
    """Square ``total`` repeatedly, and test the accuracy of the result.

    Let E be a computed n x n matrix with the spectral norm |E|, and let e be a bound of its error. The error
    of the computed square of E is at most about 2 |E| e + n^2 u |E|^2, where u is the unit roundoff.
    """
    size, unit = n * n, 2.0**-53
    # The matrix E is ``total[:size]``, and ``error`` is the bound e. The next line is the bound before the
    # first squaring.
    error = (n + 8) * unit * n
    for _ in range(squarings):
        # Both ``growth`` and the Frobenius norm are bounds of the spectral norm of ``total[:size]``.
        bound = min(growth, _norm(total[:size]))
        error = 2.0 * bound * error + n * n * unit * (bound * bound)
        # The norm of the squared matrix is at most the square of ``growth``.
        growth *= growth
        total = product(n, level, total, total)
    if error > 2.0**-LEAST_DIGITS * _norm(total[:size]):
        return [math.nan] * len(total)
    return total


def in_digits(context: Any, n: int, level: int, a: Sequence[Scalar]) -> tuple[Scalar, ...]:
    """Return the exponential of the jet ``a``. The entries of the jet are mpmath numbers.

    The error is about one rounding unit of ``context`` times the norm of the exponential. OverflowError is
    raised in the same cases as in :func:`codegen.ir.matrix_balls.exponential`.
    """
    # Eight additional bits make the error of the exponential much smaller than the rounding unit.
    result = matrix_balls.exponential(n, level, context.prec + 8, [matrix_balls.ball(x) for x in a])
    return tuple(matrix_balls.midpoint(x, context) for x in result)


def over_series(ring: Any, longest: int, n: int, level: int, a: Sequence[Scalar]) -> tuple[Scalar, ...]:
    """Return the exponential of a jet of 2^``level`` matrices (see the module docstring).

    ``a`` contains the entries of these n x n matrices. Each entry is a power series.

    If the Taylor series of the exponential has more than ``longest`` non-zero terms, ArithmeticError is
    raised.
    """
    total = [ring.one if k < n * n and k % (n + 1) == 0 else ring.zero for k in range(len(a))]
    term = total
    for k in range(1, longest + 1):
        # In pass k of the loop, ``term`` becomes A^k/k!, where A is the jet ``a``.
        factor = ring.rational(1, k)
        term = [factor * x for x in product(n, level, term, a)]
        # A zero power A^k makes all higher powers of A zero.
        if all(ring.is_zero(x) is True for x in term):
            return tuple(total)
        total = [x + y for x, y in zip(total, term, strict=True)]
    raise ArithmeticError(f"the series of a matrix exponential has more than {longest} terms")
