"""Basis matrices of Lie algebras as sums of elementary matrices E_ij."""

from __future__ import annotations

Place = tuple[int, int]
"""The row index and the column index of a matrix entry."""


def elementary(n: int, *places: Place) -> list[list[int]]:
    """Return the sum of the n x n elementary matrices E_ij over the given pairs (i, j)."""
    return [[places.count((i, j)) for j in range(n)] for i in range(n)]


def difference(n: int, plus: Place, minus: Place) -> list[list[int]]:
    """Return E_ij - E_kl, where (i, j) is the pair ``plus`` and (k, l) is the pair ``minus``."""
    return [[int((i, j) == plus) - int((i, j) == minus) for j in range(n)] for i in range(n)]
