"""The affine group of R^n."""

from __future__ import annotations

from codegen.groups.construction import check_size
from codegen.groups.linear_algebra import S, Vector
from codegen.groups.matrix import MatrixGroup
from codegen.groups.unit_matrices import elementary
from codegen.ir.domain import Domain


class Affine(MatrixGroup):
    """The group of the invertible affine maps y -> A y + b, where y is in R^n. An element is the (n + 1) x
    (n + 1) block matrix [[A, b], [0, 1]].

    Each basis element of the algebra has one nonzero entry, a 1 in the first n rows. The basis is ordered
    row by row.
    """

    def __init__(self, n: int) -> None:
        check_size("Affine", n, 1)
        basis = [elementary(n + 1, (i, j)) for i in range(n) for j in range(n + 1)]
        super().__init__(f"Aff({n})", basis)

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return one pair (name, residual) for each entry of the last row of g.

        If g is an element of the group, the last row is (0, ..., 0, 1), and the residuals are zero.
        """
        *zeros, one = g[-self.n :]
        return tuple(("the last row is (0, ..., 0, 1)", x) for x in (*zeros, one - d.rational(1)))
