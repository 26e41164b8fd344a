"""Linear algebra over Q: the rank and the kernel of a matrix of fractions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from flint import fmpq, fmpq_mat

Row = Sequence[Fraction | int]


def rank(rows: Sequence[Row]) -> int:
    """Return the rank of the matrix with the rows ``rows``. The rows must have equal lengths.

    >>> rank([[1, 2], [Fraction(1, 2), 1]])
    1
    """
    return int(_matrix(rows).rank()) if rows and rows[0] else 0


def kernel(rows: Sequence[Row], width: int) -> Iterator[list[tuple[int, Fraction]]]:
    """Yield a basis of the kernel of the matrix with the rows ``rows`` and ``width`` columns. A basis vector
    is given as a list with a pair (index, entry) for each non-zero entry.

    A column of the matrix is a pivot column if it is not a linear combination of the columns to its left.
    Each other column k of the matrix gives one basis vector. Its first pair is (k, 1). The indices of its
    other pairs belong to pivot columns.

    >>> [[(place, str(x)) for place, x in vector] for vector in kernel([[1, 2, 0]], 3)]
    [[(1, '1'), (0, '-2')], [(2, '1')]]
    """
    if not rows:
        yield from ([(place, Fraction(1))] for place in range(width))
        return
    reduced, pivot_count = _matrix(rows).rref()
    pivots = [next(k for k in range(width) if reduced[r, k] != 0) for r in range(pivot_count)]
    for free in (k for k in range(width) if k not in pivots):
        entries = [(p, -reduced[r, free]) for r, p in enumerate(pivots) if reduced[r, free] != 0]
        yield [(free, Fraction(1)), *((p, Fraction(int(x.p), int(x.q))) for p, x in entries)]


def _matrix(rows: Sequence[Row]) -> fmpq_mat:
    return fmpq_mat([[_rational(x) for x in row] for row in rows])


def _rational(x: Fraction | int) -> fmpq:
    return fmpq(x.numerator, x.denominator)
