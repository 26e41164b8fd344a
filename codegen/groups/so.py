"""SO(n): rotations of R^n."""

from __future__ import annotations

from codegen.groups.construction import check_size
from codegen.groups.linear_algebra import S, Vector, determinant
from codegen.groups.matrix import RotationGroup
from codegen.groups.unit_matrices import difference
from codegen.ir.domain import Domain


class SO(RotationGroup):
    """Rotations of R^n, n >= 2.

    The basis of the algebra consists of the skew matrices E_ji - E_ij with i < j. The matrix E_ij has the
    entry 1 in row i and column j, and zeros elsewhere. The pairs (i, j) are in lexicographic order.
    """

    def __init__(self, n: int) -> None:
        check_size("SO", n, 2)
        pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
        super().__init__(f"SO({n})", [difference(n, (j, i), (i, j)) for i, j in pairs])

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return one pair (text, residual) for each entry of g^T g - 1, and one pair for det g = 1."""
        return (*super().laws(d, g), ("det g = 1", determinant(g, self.n) - d.rational(1)))
