"""A step on n x k matrices with orthonormal columns. The step loops over arrays and forms no n x n matrix.

A generator is an element B S B^T of so(n) whose exponential moves the state. The n x r matrix B, the basis,
is the same for all generators of a step. The skew r x r matrix S is the core of the generator. The first k
columns of B are the state X_0. Each evaluation of the field adds k columns, so r = k (m + 1) for a step with
m evaluations. For two cores S and T, an r x k matrix C and the Gram matrix G = B^T B,

    [B S B^T, B T B^T] = B (S G T - T G S) B^T,
    exp(B S B^T) B C = B (C + S phi(G S) G C),   phi(z) = (exp(z) - 1)/z.

Each point X of the step is X_0 + B D. The small r x k matrix D is the displacement of the point. Let the
tangent vector V be the value of the field at X. The generator at X is W X^T - X W^T with W = V - X (X^T V)/2.
If X = B C and W = B E, the core of this generator is E C^T - C E^T.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from codegen.ir.array_program import (
    Apply,
    ArrayStatement,
    Combination,
    ConstantMatrix,
    Matrix,
    operations,
)
from codegen.ir.expr import Expr

TERMS = 8
"""Counts of operations assume that phi(z) = (exp(z) - 1)/z is a sum of this number of terms. In a run the
number of terms depends on the norm of z.
"""

MOST_TERMS = 18
"""If the norm of z is at most 1, the remainder of phi(z) = (exp(z) - 1)/z after this number of terms is below
the rounding errors.
"""


@dataclass(frozen=True)
class AddUnit:
    """target = target + ``value`` times the unit matrix. The target is square."""

    target: Matrix
    value: int


@dataclass(frozen=True)
class Move:
    """target = the matrix D with exp(B S B^T) X = X_0 + B D.

    - X_0 is the state at the start of the step.
    - B is the basis of the step.
    - ``core`` is S, and ``gram`` is B^T B.
    - The point X is X_0 + B ``start``, or X_0 if ``start`` is None. ``start`` has at most as many rows as
      ``target``.
    """

    target: Matrix
    core: Matrix
    gram: Matrix
    start: Matrix | None

    @property
    def operations(self) -> dict[str, int]:
        """The number of additions and multiplications if phi has :data:`TERMS` terms."""
        m, k = self.core.rows, self.target.columns
        rows = 0 if self.start is None else self.start.rows
        # The summands are the products for G S, for the norm of G S, for G C, and for S phi(G S) G C. In phi,
        # one product by G S is counted for each term.
        products = m**3 + m * (m + 1) // 2 + m * k * rows + (TERMS + 1) * m * m * k
        return {"add": products, "mul": products + TERMS * m * k}


StepStatement = ArrayStatement | AddUnit | Move


@dataclass(frozen=True)
class ArrayStep:
    """The statements of one step, which compute the matrix ``result`` from the matrix ``argument``.

    ``estimate`` contains the statements that compute ``error``, the difference between the result and an
    embedded solution.
    """

    argument: Matrix
    body: tuple[StepStatement, ...]
    result: Matrix
    estimate: tuple[ArrayStatement, ...] = ()
    error: Matrix | None = None

    def expressions(self) -> Iterator[Expr]:
        """Yield the scalar expressions in the statements."""
        for statement in (*self.body, *self.estimate):
            if isinstance(statement, Combination):
                yield from (term.coefficient for term in statement.terms)
            elif isinstance(statement, Apply):
                yield from (e for e in statement.constant.entries if not isinstance(e, tuple))

    def constants(self) -> tuple[ConstantMatrix, ...]:
        """Return the distinct constant matrices."""
        # A dictionary keeps the order of first use, which a set does not.
        return tuple(dict.fromkeys(s.constant for s in self.body if isinstance(s, Apply)))

    def operations(self) -> dict[str, int]:
        """Return the number of additions and multiplications, with :data:`TERMS` terms of phi."""
        total = {"add": 0, "mul": 0}
        for statement in (*self.body, *self.estimate):
            match statement:
                case AddUnit(target=target):
                    # Only the diagonal changes.
                    own = {"add": target.rows}
                case Move():
                    own = statement.operations
                case _:
                    own = operations(statement)
            # A statement without products has no entry for them.
            total = {name: n + own.get(name, 0) for name, n in total.items()}
        return total
