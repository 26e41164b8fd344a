"""The matrix exponential and the derivatives of this function, computed to many digits.

The computation uses the balls of Arb. A ball is a midpoint with an error radius. If the radii of the results
are too large, the computation is repeated with a higher precision.

A matrix and its derivatives form a jet (:mod:`codegen.ir.matrix_exponential`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from flint import arb, arb_mat

from orderconds.ring.precision import precision

if TYPE_CHECKING:
    import mpmath

LARGEST_EXPONENT = 40
"""The absolute value of each matrix entry must be below 2^``LARGEST_EXPONENT``. Otherwise
:func:`exponential` raises OverflowError.
"""

MOST_BITS = 2**16
"""The largest working precision in bits."""


def ball(x: mpmath.mpf) -> arb:
    """Return a ball with radius zero around an mpmath number."""
    sign, mantissa, exponent, _ = x._mpf_
    if not mantissa:
        # In mpmath, zero, infinities and NaN have the mantissa 0.
        return arb(0) if not exponent else arb(float(x))
    # mpmath stores the sign separately, so ``mantissa`` is never negative.
    return arb((-int(mantissa) if sign else int(mantissa), int(exponent)))


def midpoint(x: arb, context: mpmath.ctx_mp.MPContext) -> mpmath.mpf:
    """Return the midpoint of a ball, rounded to the precision of an mpmath context.

    The result is NaN for a ball that is not finite.
    """
    if not x.is_finite():
        return context.nan
    mantissa, exponent = x.mid().man_exp()
    return context.mpf((int(mantissa), int(exponent)))


def exponent_of(x: arb) -> int:
    """Return the number e with 2^(e-1) <= abs(y) < 2^e for the midpoint y of ``x``, or 0 for y = 0."""
    # The midpoint is ``mantissa`` * 2^``exponent`` with an integer mantissa.
    mantissa, exponent = x.mid().man_exp()
    return int(exponent) + int(mantissa).bit_length() if mantissa else 0


def exponential(n: int, level: int, bits: int, jet: Sequence[arb]) -> tuple[arb, ...]:
    """Return the exponential of a jet. The entries of ``jet`` must be balls with radius zero.

    ``jet`` contains the entries of an n x n matrix A, followed by the entries of its derivatives.

    The results are approximations, stored as balls with radius zero. Let |X| be the largest absolute value of
    an entry of a matrix X. Let e be the maximum of |E| over all derivatives E of A in ``jet``. The errors of
    the results have these bounds:
    - The error of each entry of exp(A) is at most 2^-``bits`` |exp(A)|.
    - The error of each entry of a derivative D of exp(A) is at most 2^-``bits`` max(|D|, |exp(A)| (e + e^2)).

    OverflowError is raised in three cases:
    - An entry of ``jet`` is not finite.
    - An entry of A has an absolute value of 2^40 or more.
    - A computation with :data:`MOST_BITS` bits is not accurate enough.
    """
    size = n * n
    if not all(x.is_finite() for x in jet) or any(exponent_of(x) > LARGEST_EXPONENT for x in jet[:size]):
        raise OverflowError(
            f"the exponential of a matrix needs finite entries with absolute values below "
            f"2^{LARGEST_EXPONENT}"
        )
    # Rounding errors widen the balls, so the exponential needs more than ``bits`` bits.
    extra = 64
    while bits + extra <= MOST_BITS:
        with precision(bits + extra):
            result = _first_row(arb_mat(block_matrix(n, level, jet)).exp().tolist(), level)
            if _is_accurate(size, bits, jet, result):
                return tuple(x.mid() for x in result)
        # If no result is accurate, the loop ends with an error when ``bits + extra`` exceeds MOST_BITS.
        # Because ``extra`` is doubled, there are few attempts.
        extra *= 2
    raise OverflowError(f"the exponential of a matrix is not accurate with {MOST_BITS} bits")


def _is_accurate(size: int, bits: int, jet: Sequence[arb], result: Sequence[arb]) -> bool:
    """Return True if no radius in ``result`` exceeds the bounds in the docstring of :func:`exponential`."""
    # The comparison below would not detect a NaN.
    if not all(x.is_finite() for x in result):
        return False
    unit, largest = arb((1, -bits)), _largest(result[:size])
    derivative = _largest(jet[size:])
    for start in range(0, len(result), size):
        matrix = result[start : start + size]
        scale = max(_largest(matrix), largest * (derivative + derivative**2)) if start else largest
        # Both sides are balls with radius zero, so the comparison is exact.
        if any(x.rad() > (unit * scale).mid() for x in matrix):
            return False
    return True


def _largest(balls: Iterable[arb]) -> arb:
    """Return the largest absolute value of a midpoint, or 0 if there are no balls."""
    return max((abs(x.mid()) for x in balls), default=arb(0))


def block_matrix(n: int, level: int, numbers: Sequence[arb]) -> list[list[arb]]:
    """Return the rows of the block matrix that represents a jet (a matrix with its derivatives).

    ``numbers`` are the entries of the jet. A jet of level 0 is represented by its n x n matrix A. A jet of
    level 1 also contains a derivative E of A, and the block rows are (A, E) and (0, A). At level l, A and E
    are block matrices of level l - 1. The exponential of the block matrix represents the exponential of the
    jet.
    """
    if level == 0:
        return [list(numbers[n * i : n * i + n]) for i in range(n)]
    # ``numbers`` contains the numbers for ``a``, followed by the numbers for ``e``.
    half = len(numbers) // 2
    a, e = (block_matrix(n, level - 1, part) for part in (numbers[:half], numbers[half:]))
    zeros = [arb(0)] * len(a)
    return [*(x + y for x, y in zip(a, e, strict=True)), *([*zeros, *x] for x in a)]


def _first_row(rows: Sequence[Sequence[arb]], level: int) -> list[arb]:
    """Return the entries of the jet for which :func:`block_matrix` returns ``rows``.

    A jet is a matrix with its derivatives.
    """
    if level == 0:
        return [x for row in rows for x in row]
    half = len(rows) // 2
    # The block matrix is [[A, E], [0, A]]. Only the upper blocks A and E are read, because the lower blocks
    # are 0 and A again.
    a, e = [row[:half] for row in rows[:half]], [row[half:] for row in rows[:half]]
    return [*_first_row(a, level - 1), *_first_row(e, level - 1)]
