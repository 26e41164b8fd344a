"""The groups and actions that tests try."""

from __future__ import annotations

from typing import Any

from codegen.groups import (
    SE2,
    SO3,
    Action,
    AdjointAction,
    AffineAction,
    CoadjointAction,
    Columns,
    Conjugation,
    DiagonalAction,
    FactorwiseAction,
    LeftMultiplication,
    Linear,
    MatrixGroup,
    Motion,
    Product,
    RightMultiplication,
    Rotation,
    Stiefel,
)
from tests.strategies import ALL_GROUPS


def elementary(n: int, *places: tuple[int, int, int]) -> list[list[int]]:
    """The n x n matrix with the given entries, as (row, column, value)."""
    rows = [[0] * n for _ in range(n)]
    for i, j, value in places:
        rows[i][j] = value
    return rows


def orthogonal(n: int) -> MatrixGroup:
    """SO(n) by structure constants."""
    pairs = [(i, j) for i in range(n) for j in range(i)]
    return MatrixGroup(f"SO({n})", [elementary(n, (i, j, 1), (j, i, -1)) for i, j in pairs])


AFFINE = MatrixGroup(
    "affine maps of the plane", [elementary(3, (i, j, 1)) for i in range(2) for j in range(3)]
)

HERE: dict[str, Any] = ALL_GROUPS | {
    "SO(4)": orthogonal(4),
    "Aff(2)": AFFINE,
    "SO(3) x SE(2)": Product(SO3(), SE2()),
}

ACTIONS: list[tuple[Action, str, int]] = [
    (Rotation(), "SO(3)", 3),
    (Rotation(), "GL(2)", 2),
    (Rotation(), "SL(2)", 2),
    (Rotation(), "Heisenberg", 3),
    (Motion(), "SE(2)", 2),
    (Conjugation(), "SO(3)", 9),
    (Conjugation(), "GL(2)", 4),
    (Conjugation(), "SL(2)", 4),
    (Columns(2), "SO(3)", 6),
    (Columns(2), "GL(2)", 4),
    (Columns(3), "SL(2)", 6),
    (Stiefel(2), "SO(4)", 8),
    (AffineAction(), "Aff(2)", 2),
    (DiagonalAction(LeftMultiplication(), Motion()), "SE(2)", 6),
    (DiagonalAction(Rotation(), CoadjointAction(), Columns(2)), "SO(3)", 12),
    (FactorwiseAction(Rotation(), Motion()), "SO(3) x SE(2)", 5),
]
"""Actions, each with a group, and the number of coordinates of a point."""


ONE_OF_EACH: dict[str, tuple[Action, str]] = {
    type(action).__name__: (action, name)
    for action, name in (
        *reversed([(action, name) for action, name, _ in ACTIONS]),
        (LeftMultiplication(), "SO(3)"),
        (RightMultiplication(), "SO(3)"),
        (AdjointAction(), "SO(3) x SE(2)"),
        (CoadjointAction(), "SE(2)"),
        (Linear(), "SL(2)"),
    )
}
"""An action of each class with a group, by the name of the class."""
