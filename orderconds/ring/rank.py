"""Linear dependences between the columns of a matrix modulo a prime."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from flint import nmod_mat

from orderconds.ring.residues import Residue


def pivot_columns(columns: Sequence[Residue]) -> tuple[int, ...]:
    """Return the indices of the pivot columns of a matrix. A pivot column is not a linear combination of the
    columns to its left.

    Each column contains the values of one function at random points, one point for each row. Let p be the
    prime modulus of the values, and let n be the number of columns. With a probability of about n / p, some
    independent functions seem dependent.

    >>> from orderconds.ring import Residues
    >>> R = Residues(101, 3)
    >>> x = R.element(np.array([1, 2, 3]))
    >>> pivot_columns([R.one, R.one * 2, x, x + 5, x * x])
    (0, 2, 4)
    """
    return _echelon(columns)[1] if columns else ()


def combinations(columns: Sequence[Residue]) -> dict[int, dict[int, int]]:
    """Return the columns that are not pivot columns as linear combinations of the pivot columns
    (:func:`pivot_columns`).

    The result has the form {column: {pivot column: coefficient}}, where columns are denoted by their indices.
    The coefficients are non-zero residues modulo the prime.

    >>> from orderconds.ring import Residues
    >>> R = Residues(101, 3)
    >>> x = R.element(np.array([1, 2, 3]))
    >>> combinations([R.one, R.one * 2, x, x + 5])
    {1: {0: 2}, 3: {0: 5, 2: 1}}
    """
    if not columns:
        return {}
    reduced, pivots = _echelon(columns)
    return {
        column: {pivot: value for row, pivot in enumerate(pivots) if (value := int(reduced[row, column]))}
        for column in range(len(columns))
        if column not in set(pivots)
    }


def _echelon(columns: Sequence[Residue]) -> tuple[nmod_mat, tuple[int, ...]]:
    """Return two values: the reduced echelon form of the matrix with the columns ``columns``, and the indices
    of the pivot columns."""
    matrix = np.stack([column.values for column in columns], axis=1)
    samples, width = matrix.shape
    reduced, rank = nmod_mat(samples, width, matrix.ravel().tolist(), columns[0].ring.prime).rref()
    pivots: list[int] = []
    for column in range(width):
        if len(pivots) < rank and int(reduced[len(pivots), column]):
            pivots.append(column)
    return reduced, tuple(pivots)
