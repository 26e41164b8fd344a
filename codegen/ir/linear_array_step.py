"""A step of a large linear problem y' = A(t) y, by products of A and vectors.

The step evaluates the matrices a_i = h A(t_i) at its nodes t_i. It applies exponentials of sums of letters
and commutators. A letter is a linear combination of the a_i. A commutator [X, Y] is applied to a vector v as
X (Y v) - Y (X v). Products and exponentials of matrices are never formed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from codegen.ir.array_program import ConstantMatrix, Entry, Matrix
from codegen.ir.expr import Expr
from codegen.ir.number import Number

TERMS = 14
"""Operations are counted for Taylor polynomials of this degree. In a run the degree depends on the norm of
the exponent.
"""

Letter = tuple[tuple[int, Number], ...]
"""A linear combination of the matrices a_i, as pairs (i, coefficient of a_i)."""


@dataclass(frozen=True)
class TimeMatrix:
    """A square matrix A(t) = sum of coefficients times matrices. Coefficients and entries may depend on t."""

    terms: tuple[tuple[Expr, ConstantMatrix], ...]

    @property
    def rows(self) -> int:
        """The number of rows."""
        return self.terms[0][1].rows

    @property
    def is_banded(self) -> bool:
        """True if every term is given by its diagonals."""
        return all(matrix.diagonals for _, matrix in self.terms)

    @cached_property
    def offsets(self) -> tuple[int, ...]:
        """The offsets of the diagonals of a banded matrix. The main diagonal comes first."""
        offsets = {d.offset for _, matrix in self.terms for d in matrix.diagonals}
        # The number itself decides between the offsets d and -d, so the order does not depend on the set.
        return tuple(sorted(offsets, key=lambda x: (abs(x), x)))

    @property
    def filled(self) -> int:
        """The number of stored entries. A banded matrix stores only the entries on its diagonals."""
        n = self.rows
        # The diagonal with the offset d has n - |d| entries.
        return sum(n - abs(d) for d in self.offsets) if self.is_banded else n * n

    def constants(self) -> tuple[ConstantMatrix, ...]:
        """Return the matrices of the terms, each once."""
        return tuple(dict.fromkeys(matrix for _, matrix in self.terms))

    def expressions(self) -> Iterator[Expr]:
        """Yield the expressions of the matrix: coefficients of its terms, and formulas for entries."""
        for coefficient, matrix in self.terms:
            yield coefficient
            entries: tuple[Entry, ...] = matrix.entries
            # Entries that are given as numbers contain no expressions.
            yield from (e for e in entries if not isinstance(e, tuple))


@dataclass(frozen=True)
class Element:
    """An exponent: a letter plus multiples of commutators.

    ``letter`` is an index in the letters of the step, or None. ``commutators`` contains pairs of a
    coefficient and an index in the commutators of the step.
    """

    letter: int | None
    commutators: tuple[tuple[Number, int], ...] = ()


@dataclass(frozen=True)
class LinearArrayStep:
    """A step y1 = exp(X_m) ... exp(X_1) y0 for n x k matrices y.

    - ``times`` are the times at which the matrix is evaluated.
    - ``letters`` are linear combinations of the values of the matrix.
    - ``commutators`` are commutators of letters and of earlier commutators.
    - ``exponents`` are X_1, ..., X_m in this order.
    """

    argument: Matrix
    matrix: TimeMatrix
    times: tuple[Expr, ...]
    letters: tuple[Letter, ...]
    commutators: tuple[tuple[Element, Element], ...]
    exponents: tuple[Element, ...]

    def expressions(self) -> Iterator[Expr]:
        """Yield the scalar expressions of the step: its times, and the expressions of its matrix."""
        yield from self.times
        yield from self.matrix.expressions()

    def products(self, element: Element) -> int:
        """Return the number of matrix-vector products needed to multiply ``element`` by a vector."""
        # A letter is one stored matrix, so it costs one product.
        own = 0 if element.letter is None else 1
        for _, number in element.commutators:
            # X (Y v) - Y (X v) contains two products by X and two by Y.
            own += 2 * sum(map(self.products, self.commutators[number]))
        return own

    def operations(self) -> dict[str, int]:
        """Return the number of additions and multiplications of a step.

        One Taylor polynomial of degree :data:`TERMS` is counted for each exponential. The evaluation of
        formulas for entries is not counted.
        """
        # Each of the k columns of y is multiplied by the matrix.
        size, k = self.argument.size, self.argument.columns
        # Each term of a Taylor polynomial multiplies a vector by the exponent once.
        products = TERMS * sum(map(self.products, self.exponents))
        sums = sum(map(len, self.letters)) * self.matrix.filled if self.matrix.is_banded else 0
        each = products * self.matrix.filled * k + sums
        # Each term of a Taylor polynomial is scaled and added to the sum.
        vectors = TERMS * len(self.exponents) * size
        return {"add": each + vectors, "mul": each + 2 * vectors}
