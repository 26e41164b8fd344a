"""GL(n): invertible matrices."""

from __future__ import annotations

from codegen.groups.matrix import MatrixGroup


class GL(MatrixGroup):
    """Invertible n x n matrices; the algebra has the elementary matrices E_ij as its basis, row by row."""

    def __init__(self, n: int) -> None:
        r = range(n)
        super().__init__(f"GL({n})", [[[int((k, m) == (i, j)) for m in r] for k in r] for i in r for j in r])
