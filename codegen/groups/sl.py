"""SL(n): matrices of determinant 1."""

from __future__ import annotations

from codegen.groups.construction import check_size
from codegen.groups.linear_algebra import S, Vector, determinant
from codegen.groups.matrix import MatrixGroup
from codegen.groups.unit_matrices import difference, elementary
from codegen.ir.domain import Domain


class SL(MatrixGroup):
    """Matrices of determinant 1 with n >= 2 rows and columns.

    The matrix E_ij has the entry 1 in row i and column j, and zeros elsewhere. The basis of the algebra
    consists of two lists, each in lexicographic order of (i, j):

    - the matrices E_ij with i != j,
    - the diagonal matrices E_ii - E_jj with j = i + 1.
    """

    def __init__(self, n: int) -> None:
        check_size("SL", n, 2)
        basis = [elementary(n, (i, j)) for i in range(n) for j in range(n) if i != j]
        diagonal = [difference(n, (i, i), (i + 1, i + 1)) for i in range(n - 1)]
        super().__init__(f"SL({n})", [*basis, *diagonal])

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return one pair (text, residual) for the equation det g = 1."""
        return (("det g = 1", determinant(g, self.n) - d.rational(1)),)
