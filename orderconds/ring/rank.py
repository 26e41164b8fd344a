"""Which columns are independent of those before them: greedy pivots of a matrix modulo a prime."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from flint import nmod_mat

from orderconds.ring.residues import Residue


def pivot_columns(columns: Sequence[Residue]) -> tuple[int, ...]:
    """Return the places of the columns that are no combination of earlier ones; their number is the rank.

    The rows are the samples: with random samples the answer is that for the functions that the columns
    sample, except with probability about (number of columns) / prime, and never more columns than that.

    >>> from orderconds.ring import Residues
    >>> R = Residues(101, 3)
    >>> x = R.element(np.array([1, 2, 3]))
    >>> pivot_columns([R.one, R.one * 2, x, x + 5, x * x])
    (0, 2, 4)
    """
    if not columns:
        return ()
    matrix = np.stack([column.values for column in columns], axis=1)
    samples, width = matrix.shape
    reduced, rank = nmod_mat(samples, width, matrix.ravel().tolist(), columns[0].ring.prime).rref()
    pivots: list[int] = []
    for column in range(width):
        if len(pivots) < rank and int(reduced[len(pivots), column]):
            pivots.append(column)
    return tuple(pivots)
