"""Unitriangular matrices and the Heisenberg groups."""

from __future__ import annotations

from codegen.groups.construction import check_size
from codegen.groups.linear_algebra import S, Vector
from codegen.groups.matrix import MatrixGroup
from codegen.groups.unit_matrices import Place, elementary
from codegen.ir.domain import Domain


class Unitriangular(MatrixGroup):
    """Upper triangular matrices with ones on the diagonal.

    The basis of the algebra consists of the elementary matrices E_ij with i < j. These matrices are ordered
    by i, then by j.
    """

    def __init__(self, n: int) -> None:
        check_size("Unitriangular", n, 2)
        self.places: list[Place] = [(i, j) for i in range(n) for j in range(i + 1, n)]
        super().__init__(f"UT({n})", [elementary(n, place) for place in self.places])

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return a pair (name, residual) for each entry of g outside of ``self.places``.

        In the group, these entries are 1 on the diagonal and 0 elsewhere. The entries at ``self.places`` are
        arbitrary numbers.
        """
        fixed = [(i, j) for i in range(self.n) for j in range(self.n) if (i, j) not in self.places]
        unit: Vector[S] = self.identity(d)
        places = [(i, j, self.n * i + j) for i, j in fixed]
        return tuple((f"g_{i}{j} = {int(i == j)}", g[k] - unit[k]) for i, j, k in places)


class Heisenberg(Unitriangular):
    """The Heisenberg group of dimension 2 n + 1: unitriangular (n + 2) x (n + 2) matrices. Above the
    diagonal, only the first row and the last column have nonzero entries.

    The basis of the algebra begins with the elementary matrices E_{1,j} with 1 < j < n + 2. The matrices
    E_{i,n+2} with 1 < i < n + 2 follow. The last matrix is E_{1,n+2}.
    """

    def __init__(self, n: int) -> None:
        check_size("Heisenberg", n, 1)
        last = n + 1
        row, column = [(0, k) for k in range(1, last)], [(k, last) for k in range(1, last)]
        self.places = [*row, *column, (0, last)]
        MatrixGroup.__init__(self, f"H({2 * n + 1})", [elementary(n + 2, place) for place in self.places])
