"""The inverse of an n x n matrix by Gauss-Jordan elimination with row exchanges."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar


def inverse(
    n: int, a: Sequence[Scalar], one: Scalar, size: Callable[[Scalar], Any]
) -> tuple[Scalar, ...] | None:
    """Return the inverse of the n x n matrix ``a``, row by row, or None if it is singular or not finite.

    ``one`` is the number 1 in the type of the entries. In each column, the pivot is the entry x on or below
    the diagonal with the largest ``size(x)``. Emitted code executes the same operations in the same order.
    """
    rows = [list(a[n * i : n * i + n]) for i in range(n)]
    order: list[int] = []
    for k in range(n):
        # Division by a tiny pivot would amplify rounding errors.
        pivot = max(range(k, n), key=lambda i: size(rows[i][k]))
        # The size of the pivot can be 0, infinite or a NaN. With an infinite pivot, the elimination would
        # give a finite result.
        if not 0 < size(rows[pivot][k]) < math.inf:
            return None
        order.append(pivot)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        factor = one / rows[k][k]
        rows[k] = [x * factor for x in rows[k]]
        # The inverse matrix overwrites ``rows``, one column in each pass.
        rows[k][k] = factor
        for i in range(n):
            if i != k:
                multiple = rows[i][k]
                rows[i] = [x - multiple * y for x, y in zip(rows[i], rows[k], strict=True)]
                rows[i][k] = -(multiple * factor)
    # In pass k of the elimination, the rows k and ``order[k]`` were exchanged. To undo this exchange, the
    # columns k and ``order[k]`` of the inverse are exchanged. The last exchange is undone first.
    for k in reversed(range(n)):
        for row in rows:
            row[k], row[order[k]] = row[order[k]], row[k]
    return tuple(x for row in rows for x in row)
