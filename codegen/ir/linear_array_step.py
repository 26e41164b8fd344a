"""A step of a large linear problem y' = A(t) y, computed with matrix-vector products.

The step evaluates the matrices a_i = h A(t_i) at the nodes t_i, and applies exponentials to the state. Each
exponent is a letter plus multiples of commutators. A letter is a linear combination of the a_i. A commutator
[X, Y] is applied to a vector v as X (Y v) - Y (X v). Products and exponentials of matrices are never formed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from codegen.ir.array_program import ConstantMatrix, Entry, Matrix
from codegen.ir.expr import Expr
from codegen.ir.number import Number

TERMS = 14
"""The degree of the Taylor polynomials of exponentials in the estimate :meth:`LinearArrayStep.operations`.

In emitted code the degree depends on the norm of the matrix in the exponential.
"""

Letter = tuple[tuple[int, Number], ...]
"""A linear combination of the matrices a_i = h A(t_i), as pairs (i, coefficient of a_i)."""


@dataclass(frozen=True)
class TimeMatrix:
    """A square matrix A(t) that is a sum of scalar coefficients times matrices.

    ``terms`` contains the pairs (coefficient, matrix). The coefficients and the entries of the matrices may
    depend on t.
    """

    terms: tuple[tuple[Expr, ConstantMatrix], ...]

    @property
    def rows(self) -> int:
        """The number of rows of the matrix."""
        return self.terms[0][1].rows

    @property
    def is_banded(self) -> bool:
        """True if the matrix of every term is stored by its diagonals."""
        return all(matrix.diagonals for _, matrix in self.terms)

    @cached_property
    def offsets(self) -> tuple[int, ...]:
        """The offsets of the stored diagonals, sorted by absolute value, for example 0, -1, 1, -2, 2."""
        offsets = {d.offset for _, matrix in self.terms for d in matrix.diagonals}
        # The offset -d comes before d.
        return tuple(sorted(offsets, key=lambda x: (abs(x), x)))

    @property
    def filled(self) -> int:
        """The number of stored entries of A(t). For a banded matrix these are the entries on its
        diagonals.
        """
        n = self.rows
        # The diagonal with the offset d has n - |d| entries.
        return sum(n - abs(d) for d in self.offsets) if self.is_banded else n * n

    def constants(self) -> tuple[ConstantMatrix, ...]:
        """Return the matrices in ``terms``, without repetitions."""
        return tuple(dict.fromkeys(matrix for _, matrix in self.terms))

    def expressions(self) -> Iterator[Expr]:
        """Yield the coefficients in ``terms`` and the formulas for the entries of the matrices."""
        for coefficient, matrix in self.terms:
            yield coefficient
            entries: tuple[Entry, ...] = matrix.entries
            # An entry is an expression or a tuple of numbers.
            yield from (e for e in entries if not isinstance(e, tuple))


@dataclass(frozen=True)
class Element:
    """A linear combination of matrices h A(t_i) and of commutators, for example an exponent.

    The part without commutators is ``LinearArrayStep.letters[letter]``. If the element contains only
    commutators, ``letter`` is None. ``commutators`` contains pairs of a coefficient and an index in
    :attr:`LinearArrayStep.commutators`.
    """

    letter: int | None
    commutators: tuple[tuple[Number, int], ...] = ()


@dataclass(frozen=True)
class LinearArrayStep:
    """A step y1 = exp(X_m) ... exp(X_1) y0, where y0 and y1 are n x k matrices.

    - ``argument`` is y0.
    - ``matrix`` is the matrix A(t) of the equation y' = A(t) y.
    - ``times`` are the times t_i at which A(t) is evaluated.
    - ``letters`` are linear combinations of the matrices h A(t_i).
    - ``commutators`` contains the pair (X, Y) for each commutator [X, Y]. X and Y may contain commutators of
      earlier pairs.
    - ``exponents`` are X_1, ..., X_m in this order.
    """

    argument: Matrix
    matrix: TimeMatrix
    times: tuple[Expr, ...]
    letters: tuple[Letter, ...]
    commutators: tuple[tuple[Element, Element], ...]
    exponents: tuple[Element, ...]

    def expressions(self) -> Iterator[Expr]:
        """Yield the times t_i and the expressions in ``matrix``."""
        yield from self.times
        yield from self.matrix.expressions()

    def products(self, element: Element) -> int:
        """Return the number of matrix-vector products that are needed to multiply ``element`` by a vector."""
        # The part of ``element`` without commutators is one matrix and needs one matrix-vector product.
        own = 0 if element.letter is None else 1
        for _, number in element.commutators:
            # The commutator needs the products Y v, X (Y v), X v and Y (X v).
            own += 2 * sum(map(self.products, self.commutators[number]))
        return own

    def operations(self) -> dict[str, int]:
        """Return the numbers of additions and multiplications of a step.

        Each exponential is counted as a Taylor polynomial of degree :data:`TERMS`. The formulas for the
        entries of the matrix are not counted.
        """
        # y has k columns, so each matrix is multiplied by k vectors.
        size, k = self.argument.size, self.argument.columns
        # Term j of the Taylor polynomial of exp(X) y is the product of X and term j - 1, divided by j.
        products = TERMS * sum(map(self.products, self.exponents))
        sums = sum(map(len, self.letters)) * self.matrix.filled if self.matrix.is_banded else 0
        each = products * self.matrix.filled * k + sums
        # Each Taylor polynomial has ``TERMS`` terms with ``size`` entries. Each entry needs one addition and
        # two multiplications.
        vectors = TERMS * len(self.exponents) * size
        return {"add": each + vectors, "mul": each + 2 * vectors}
