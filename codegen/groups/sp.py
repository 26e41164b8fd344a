"""Sp(2n): the symplectic 2n x 2n matrices."""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.construction import check_size
from codegen.groups.matrix import IsometryGroup
from codegen.groups.unit_matrices import difference, elementary


class Sp(IsometryGroup):
    """Symplectic 2n x 2n matrices g: g^T J g = J, where J has the block rows (0, 1) and (-1, 0).

    The argument of ``Sp`` is 2n.

    The matrix E_ij has the entry 1 in row i and column j, and zeros elsewhere. With i, j = 1, ..., n, the
    basis of the algebra consists of three kinds of matrices, in this order:

    - E_ij - E_(n+j)(n+i) for all i and j,
    - E_i(n+j) + E_j(n+i) for i < j, and E_i(n+i) for i = j,
    - E_(n+i)j + E_(n+j)i for i < j, and E_(n+i)i for i = j.
    """

    def __init__(self, rows: int) -> None:
        check_size("Sp", rows, 2)
        n = rows // 2
        if rows % 2:
            raise SceneError(f"Sp({rows}) has an odd number of rows", expected="an even number, as in Sp(4)")
        self.form = tuple((i + n, 1) if i < n else (i - n, -1) for i in range(rows))
        every = [(i, j) for i in range(n) for j in range(n)]
        basis = [difference(rows, (i, j), (n + j, n + i)) for i, j in every]
        for above in (True, False):
            for i, j in every:
                if i <= j:
                    places = {(i, n + j), (j, n + i)} if above else {(n + i, j), (n + j, i)}
                    basis.append(elementary(rows, *places))
        super().__init__(f"Sp({rows})", basis)
