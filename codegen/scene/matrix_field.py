"""Fields V(X) on Stiefel manifolds. V is a matrix formula, for example V(X) = A X - X (X^T A X)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from codegen.ir.array_program import ArrayProgram
from codegen.ir.domain import Domain, Scalar
from codegen.ir.expr import walk


@dataclass(frozen=True)
class MatrixField:
    """A tangent field V(X) on the n x k matrices X with orthonormal columns; ``program`` computes V(X).

    V(X) = S X holds for the skew matrix S = W X^T - X W^T with W = V - X (X^T V)/2.
    """

    program: ArrayProgram
    linear: ClassVar[bool] = False
    """True if the field is linear: V(X) = A X with a matrix A that does not depend on X."""

    @property
    def rows(self) -> int:
        """The number of rows of the state matrix X."""
        return self.program.argument.rows

    @property
    def columns(self) -> int:
        """The number of columns of the state matrix X."""
        return self.program.argument.columns

    def reads(self, symbol: str) -> bool:
        """Return True if the scalar ``symbol`` occurs in the formula of V(X)."""
        nodes = walk(self.program.expressions())
        return any(node.op == "sym" and node.payload == symbol for node in nodes)

    def velocity(
        self, domain: Domain, x: Sequence[Scalar], symbols: Mapping[str, Scalar]
    ) -> tuple[Scalar, ...]:
        """Return the entries of V(X) row by row. ``x`` contains the entries of the matrix X."""
        return tuple(self.program.evaluate(domain, x, symbols))

    def generator(
        self, domain: Domain, x: Sequence[Scalar], symbols: Mapping[str, Scalar]
    ) -> tuple[Scalar, ...]:
        """Return the n x n matrix S with V(X) = S X, row by row. ``x`` contains the entries of X."""
        n, k = self.rows, self.columns
        v, half = self.velocity(domain, x, symbols), domain.rational(1, 2)

        def total(terms: Sequence[Scalar]) -> Scalar:
            value = terms[0]
            for term in terms[1:]:
                value = value + term
            return value

        gram = [[total([x[k * i + a] * v[k * i + b] for i in range(n)]) for b in range(k)] for a in range(k)]
        w = [
            v[k * i + b] - half * total([x[k * i + a] * gram[a][b] for a in range(k)])
            for i in range(n)
            for b in range(k)
        ]
        return tuple(
            total([w[k * i + b] * x[k * j + b] - x[k * i + b] * w[k * j + b] for b in range(k)])
            for i in range(n)
            for j in range(n)
        )
