"""A step of an integrator on n x k matrices with orthonormal columns. The step never forms an n x n matrix.

A generator is an element of so(n) whose exponential is applied to the state. All generators of a step have
the form B S B^T with the same n x r matrix B. The matrix B is the basis of the step. The skew r x r matrix S
is the core of the generator.

The first k columns of B are the state X_0 at the start of the step. Let V be the value of the vector field at
a point X (an n x k matrix). The generator at X is W X^T - X W^T with W = V - X (X^T V)/2. The k columns of W
become new columns of B. Hence r = k (m + 1) for a step with m evaluations of the vector field.

There are r x k matrices C and E with X = B C and W = B E. Hence the core of the generator at X is
E C^T - C E^T. The point X is stored as X = X_0 + B D, where the r x k matrix D is the displacement of X.

Let S and T be two cores, and let G = B^T B be the Gram matrix. Commutators and exponentials are computed by

    [B S B^T, B T B^T] = B (S G T - T G S) B^T,
    exp(B S B^T) B C = B (C + S phi(G S) G C),   phi(z) = (exp(z) - 1)/z.
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
"""The estimated cost of a step assumes this number of terms in the series of phi(z) = (exp(z) - 1)/z."""

MOST_TERMS = 18
"""The largest number of terms in the series of phi(z) = (exp(z) - 1)/z for a matrix z. For matrices with a
norm of at most 1, the omitted terms are smaller than the rounding errors.
"""


@dataclass(frozen=True)
class AddUnit:
    """The statement target = target + ``value`` times the unit matrix. The target is a square matrix."""

    target: Matrix
    value: int


@dataclass(frozen=True)
class Move:
    """A statement that multiplies a point X by the exponential of a generator.

    - X_0 is the state at the start of the step.
    - B is the basis of the step (see the beginning of this module).
    - ``start`` is the matrix D_0 that defines the point X = X_0 + B D_0. If X is X_0, ``start`` is None.
    - ``start`` may have fewer rows than ``target``. The missing rows are zero.
    - ``core`` is the matrix S of the generator B S B^T, and ``gram`` is B^T B.
    - ``target`` is set to the matrix D with exp(B S B^T) X = X_0 + B D.
    """

    target: Matrix
    core: Matrix
    gram: Matrix
    start: Matrix | None

    @property
    def operations(self) -> dict[str, int]:
        """The numbers of additions and multiplications of this statement.

        The series of phi(z) = (exp(z) - 1)/z is assumed to have :data:`TERMS` terms.
        """
        m, k = self.core.rows, self.target.columns
        rows = 0 if self.start is None else self.start.rows
        # The statement uses the formula exp(B S B^T) B C = B (C + S phi(G S) G C), where S is ``core`` and G
        # is ``gram``. The four terms of ``products`` are the numbers of multiplications for G S, for the norm
        # of B S B^T, for G C, and for S phi(G S) G C.
        products = m**3 + m * (m + 1) // 2 + m * k * rows + (TERMS + 1) * m * m * k
        return {"add": products, "mul": products + TERMS * m * k}


StepStatement = ArrayStatement | AddUnit | Move


@dataclass(frozen=True)
class ArrayStep:
    """The statements of one step: ``body`` computes the matrix ``result`` from the matrix ``argument``.

    If the method has an error estimate, the statements ``estimate`` compute the matrix ``error``. The matrix
    ``error`` is the difference between ``result`` and an embedded solution of lower order.
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
        """Return the constant matrices in ``body`` without duplicates, in the order of first use."""
        # ``dict.fromkeys`` removes duplicates and keeps the order of first use.
        return tuple(dict.fromkeys(s.constant for s in self.body if isinstance(s, Apply)))

    def operations(self) -> dict[str, int]:
        """Return the numbers of additions and multiplications of the step.

        The series of phi(z) = (exp(z) - 1)/z is assumed to have :data:`TERMS` terms.
        """
        total = {"add": 0, "mul": 0}
        for statement in (*self.body, *self.estimate):
            match statement:
                case AddUnit(target=target):
                    # A multiple of the unit matrix is added to ``target``. In each row, only the diagonal
                    # entry needs an addition.
                    own = {"add": target.rows}
                case Move():
                    own = statement.operations
                case _:
                    own = operations(statement)
            # An :class:`AddUnit` needs no multiplications, so ``own`` has no key ``mul``.
            total = {name: n + own.get(name, 0) for name, n in total.items()}
        return total
