"""U(n) and SU(n): unitary matrices, as real matrices of twice the size."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.groups.construction import check_size
from codegen.groups.linear_algebra import S, Vector
from codegen.groups.matrix import RotationGroup
from codegen.ir.domain import Domain
from codegen.ir.unitary_exponential import ROWS, SIZE


class Unitary(RotationGroup):
    """Unitary n x n matrices A + i B with real matrices A and B. Each element is stored as the real 2n x 2n
    matrix with the block rows (A, -B) and (B, A).

    The basis of the algebra begins with the matrices E_jk - E_kj and i (E_jk + E_kj) for j < k. The pairs
    (j, k) are ordered by j, then by k. The diagonal matrices i E_jj follow.
    """

    def __init__(self, n: int) -> None:
        check_size("Unitary", n, 1)
        self._generate(f"U({n})", n, [{(j, j): 1} for j in range(n)])

    def _generate(self, name: str, n: int, diagonal: Sequence[dict[tuple[int, int], int]]) -> None:
        """Compute the basis of the algebra, and initialise the group with this basis.

        Each table in ``diagonal`` describes a diagonal matrix. The table maps the place (row, column) of a
        non-zero entry to the imaginary part of the entry.
        """
        pairs = [(j, k) for j in range(n) for k in range(j + 1, n)]
        basis = []
        for j, k in pairs:
            basis += [_real(n, {(j, k): 1, (k, j): -1}, {}), _real(n, {}, {(j, k): 1, (k, j): 1})]
        self.rows = n
        RotationGroup.__init__(self, name, [*basis, *(_real(n, {}, imaginary) for imaginary in diagonal)])

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of the group as pairs (name, residual).

        The equations say that g^T g = 1, that the two diagonal blocks of g are equal, and that the sum of the
        other two blocks is zero.
        """
        n, width = self.rows, self.n
        places = [(i, j) for i in range(n) for j in range(n)]
        blocks = [g[width * i + j] - g[width * (n + i) + n + j] for i, j in places]
        blocks += [g[width * (n + i) + j] + g[width * i + n + j] for i, j in places]
        return (*super().laws(d, g), *(("g is complex", x) for x in blocks))


class SU(Unitary):
    """Unitary n x n matrices A + i B with determinant 1, where n >= 2 and the matrices A and B are real. Each
    element is stored as the real 2n x 2n matrix with the block rows (A, -B) and (B, A).

    The basis of the algebra begins with the matrices E_jk - E_kj and i (E_jk + E_kj) for j < k. The pairs
    (j, k) are ordered by j, then by k. The diagonal matrices i (E_jj - E_kk) with k = j + 1 follow.
    """

    def __init__(self, n: int) -> None:
        check_size("SU", n, 2)
        self._generate(f"SU({n})", n, [{(j, j): 1, (j + 1, j + 1): -1} for j in range(n - 1)])

    def exp(self, d: Domain, x: Vector[S]) -> Vector[S]:
        """Return the matrix exponential.

        For SU(3), it is computed by the function in :mod:`codegen.ir.unitary_exponential`.
        """
        if self.rows != ROWS:
            return super().exp(d, x)
        parts = d.vector(f"expsu{ROWS}", x)
        real, imaginary = (
            [half[i : i + ROWS] for i in range(0, SIZE, ROWS)] for half in (parts[:SIZE], parts[SIZE:])
        )
        upper = (y for a, b in zip(real, imaginary, strict=True) for y in (*a, *(-z for z in b)))
        lower = (y for a, b in zip(real, imaginary, strict=True) for y in (*b, *a))
        return (*upper, *lower)

    def laws(self, d: Domain, g: Vector[S]) -> tuple[tuple[str, S], ...]:
        """Return the equations of SU(n) as pairs (name, residual).

        These are the equations of U(n), and two equations for the real part and the imaginary part of
        det g = 1.
        """
        n, width = self.rows, self.n
        rows = [[(g[width * i + j], g[width * (n + i) + j]) for j in range(n)] for i in range(n)]
        real, imaginary = _complex_determinant(rows)
        return (*super().laws(d, g), ("det g = 1", real - d.rational(1)), ("det g = 1", imaginary))


def _real(n: int, real: dict[tuple[int, int], int], imaginary: dict[tuple[int, int], int]) -> list[list[int]]:
    """Return the real 2n x 2n matrix of a complex n x n matrix.

    The tables map (row, column) to the non-zero real parts and the non-zero imaginary parts of the entries.
    """
    rows = range(n)
    a, b = ([[part.get((i, j), 0) for j in rows] for i in rows] for part in (real, imaginary))
    upper = [[*a[i], *(-x for x in b[i])] for i in rows]
    return [*upper, *([*b[i], *a[i]] for i in rows)]


def _complex_determinant(rows: Sequence[Sequence[tuple[S, S]]]) -> tuple[S, S]:
    """Return the real and the imaginary part of a determinant, by expansion along the first row."""
    if len(rows) == 1:
        return rows[0][0]
    (first, *rest), total = rows, None
    for j, (a, b) in enumerate(first):
        c, e = _complex_determinant([[*row[:j], *row[j + 1 :]] for row in rest])
        x, y = a * c - b * e, a * e + b * c
        if total is None:
            total = x, y
        else:
            total = (total[0] - x, total[1] - y) if j % 2 else (total[0] + x, total[1] + y)
    assert total is not None
    return total
