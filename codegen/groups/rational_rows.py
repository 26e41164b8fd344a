"""Conversion of a user's matrix to rows of exact rational numbers."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from codegen.errors import SceneError
from codegen.ir.decimals import exact


def rational_rows(name: str, matrix: object) -> tuple[tuple[Fraction, ...], ...]:
    """Return the rows of a matrix as exact fractions.

    ``matrix`` is a list of rows, a sympy matrix or a NumPy array. A float is read as the shortest decimal
    number that rounds to this float. :class:`SceneError` is raised if ``matrix`` has another type, or if an
    entry is not rational. ``name`` is the name of the group in error messages.

    >>> rational_rows("A", [[0, 0.1], ["1/3", 0]])[0]
    (Fraction(0, 1), Fraction(1, 10))
    """
    listed = matrix.tolist() if hasattr(matrix, "tolist") else matrix
    if not isinstance(listed, Sequence) or not all(isinstance(row, Sequence) for row in listed):
        raise SceneError(
            f"{matrix} is not a matrix",
            where=name,
            expected="a list of rows, a sympy matrix or a NumPy array",
        )
    rows = []
    for row in listed:
        values = [exact(x) for x in row]
        for x, value in zip(row, values, strict=True):
            if value is None:
                raise SceneError(
                    f"the entry {x} of a matrix is not rational", where=name, expected="a rational number"
                )
        rows.append(tuple(value for value in values if value is not None))
    return tuple(rows)
