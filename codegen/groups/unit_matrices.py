"""Basis matrices of Lie algebras as sums of elementary matrices E_ij."""

from __future__ import annotations

Place = tuple[int, int]
"""The row and the column of an entry."""


def elementary(n: int, *places: Place) -> list[list[int]]:
    """Return the sum of the n x n matrices E_ij over the places (i, j)."""
    return [[places.count((i, j)) for j in range(n)] for i in range(n)]


def difference(n: int, plus: Place, minus: Place) -> list[list[int]]:
    """Return E_plus - E_minus for two places (row, column)."""
    return [[int((i, j) == plus) - int((i, j) == minus) for j in range(n)] for i in range(n)]
