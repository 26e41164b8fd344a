"""The field A(t) y, where y is a vector or a matrix. The entries of A(t) are formulas."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from codegen.ir.array_program import Apply, ArrayProgram, Combination, Matrix, Term
from codegen.ir.domain import Domain, Scalar
from codegen.ir.expr import evaluate
from codegen.ir.linear_array_step import TimeMatrix
from codegen.scene.matrix_field import MatrixField


@dataclass(frozen=True)
class LinearField(MatrixField):
    """The field A(t) X on n x k matrices X. The attribute ``matrix`` contains A(t)."""

    matrix: TimeMatrix
    linear: ClassVar[bool] = True

    def generator(
        self, domain: Domain, x: Sequence[Scalar], symbols: Mapping[str, Scalar]
    ) -> tuple[Scalar, ...]:
        """Return the n^2 entries of A(t) row by row. This method is practical only for small n."""
        n = self.rows
        entries = [domain.rational(0)] * (n * n)
        for coefficient, matrix in self.matrix.terms:
            (c,) = evaluate([coefficient], domain, symbols)
            for i, j, value in matrix.values(domain, symbols):
                entries[n * i + j] = entries[n * i + j] + c * value
        return tuple(entries)


def linear_field(matrix: TimeMatrix, columns: int) -> LinearField:
    """Return the field A(t) X on n x k matrices X with k = ``columns``."""
    n = matrix.rows
    argument, result = Matrix("point", n, columns), Matrix("velocity", n, columns)
    parts = [Matrix(f"value {k}", n, columns) for k in range(1, len(matrix.terms) + 1)]
    applied = [Apply(part, own, argument) for part, (_, own) in zip(parts, matrix.terms, strict=True)]
    terms = tuple(Term(c, part) for part, (c, _) in zip(parts, matrix.terms, strict=True))
    return LinearField(ArrayProgram(argument, (*applied, Combination(result, terms)), result), matrix)
