"""Invert a matrix with the same operations, in the same order, as the emitted function ``invert``."""

from __future__ import annotations

from math import inf
from typing import Any


def inverted(n: int, matrix: list[Any]) -> int:
    """Replace a matrix (a flat list) by its inverse and return 1.

    If the matrix is singular, or contains an infinity or a NaN, the result is 0. A matrix with an infinity or
    a NaN still contains one afterwards.
    """
    import numpy

    # For doubles, the result equals that of the emitted code, because the operations have the same order.
    rows = numpy.array(matrix, dtype=object if not all(isinstance(x, float) for x in matrix) else float)
    rows = rows.reshape(n, n)
    order = []
    # The emitted code gives no warning of overflow or NaN, so the warnings of numpy are switched off.
    with numpy.errstate(all="ignore"):
        for k in range(n):
            sizes = abs(rows[k:, k])
            pivot = k + max(range(n - k), key=sizes.__getitem__)
            # The reciprocal of an infinite pivot is 0. Later products with it would hide the infinity.
            if not 0 < sizes[pivot - k] < inf:
                # There is no usable pivot. The emitted function stops here, too, and leaves the partly
                # eliminated matrix in the array, so the same numbers are stored in ``matrix``.
                matrix[:] = rows.ravel().tolist()
                return 0
            order.append(pivot)
            rows[[k, pivot]] = rows[[pivot, k]]
            factor = 1 / rows[k, k]
            rows[k] *= factor
            rows[k, k] = factor
            multiples = rows[:, k].copy()
            others = numpy.arange(n) != k
            rows[others] -= numpy.outer(multiples[others], rows[k])
            rows[others, k] = -(multiples[others] * factor)
        # If rows i and j of the matrix were exchanged, columns i and j of the inverse must be exchanged.
        for k in reversed(range(n)):
            rows[:, [k, order[k]]] = rows[:, [order[k], k]]
    matrix[:] = rows.ravel().tolist()
    return 1
