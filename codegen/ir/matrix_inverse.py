"""The inverse of an n x n matrix by Gauss-Jordan elimination with row exchanges."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar


def inverse(
    n: int, a: Sequence[Scalar], one: Scalar, size: Callable[[Scalar], Any]
) -> tuple[Scalar, ...] | None:
    """Return the inverse of a matrix, row by row, or None for a singular matrix.

    ``a`` contains the entries of the n x n matrix, row by row. ``one`` is the number 1 with the type of the
    entries. The pivot of a column is the entry x with the largest ``size(x)``. Emitted code executes the same
    operations in the same order, so it computes exactly the same doubles.
    """
    rows = [list(a[n * i : n * i + n]) for i in range(n)]
    order: list[int] = []
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: size(rows[i][k]))
        # The test ``not ... > 0`` is also true for a NaN, because comparisons with a NaN are false.
        if not size(rows[pivot][k]) > 0:
            return None
        order.append(pivot)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        factor = one / rows[k][k]
        rows[k] = [x * factor for x in rows[k]]
        # Column k of the matrix becomes a unit vector and need not be stored. The array stores column k of
        # the inverse in its place.
        rows[k][k] = factor
        for i in range(n):
            if i != k:
                multiple = rows[i][k]
                rows[i] = [x - multiple * y for x, y in zip(rows[i], rows[k], strict=True)]
                rows[i][k] = -(multiple * factor)
    # An exchange of two rows of a matrix exchanges two columns of its inverse. The columns are therefore
    # exchanged here, in the reverse order of the row exchanges.
    for k in reversed(range(n)):
        for row in rows:
            row[k], row[order[k]] = row[order[k]], row[k]
    return tuple(x for row in rows for x in row)
