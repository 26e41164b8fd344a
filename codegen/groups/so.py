"""SO(n): rotations of R^n."""

from __future__ import annotations

from codegen.groups.construction import check_size
from codegen.groups.linear_algebra import S, Vector, determinant
from codegen.groups.matrix import RotationGroup
from codegen.groups.unit_matrices import difference
from codegen.ir.domain import Domain


class SO(RotationGroup):
    """Rotations of R^n, n >= 2.

    The basis of the algebra consists of the skew matrices E_ji - E_ij with i < j. They are ordered by i, then
    by j.
    """

    def __init__(self, n: int) -> None:
        check_size("SO", n, 2)
        pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
        super().__init__(f"SO({n})", [difference(n, (j, i), (i, j)) for i, j in pairs])

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations g^T g = 1 and det g = 1, as pairs of a text and a residual."""
        return (*super().laws(d, g), ("det g = 1", determinant(g, self.n) - d.rational(1)))
