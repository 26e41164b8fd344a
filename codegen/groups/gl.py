"""GL(n): invertible matrices."""

from __future__ import annotations

from codegen.groups.construction import check_size
from codegen.groups.matrix import MatrixGroup
from codegen.groups.unit_matrices import elementary


class GL(MatrixGroup):
    """Invertible n x n matrices. The basis of the algebra consists of the elementary matrices E_ij, row by
    row.
    """

    def __init__(self, n: int) -> None:
        check_size("GL", n, 1)
        super().__init__(f"GL({n})", [elementary(n, (i, j)) for i in range(n) for j in range(n)])
