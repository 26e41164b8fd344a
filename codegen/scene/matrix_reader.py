"""Translation of matrix formulas (:mod:`codegen.scene.matrix_formula`) into array programs.

Each product is computed in the order that needs the fewest multiplications.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import cast

from codegen.errors import SceneError
from codegen.ir.array_program import (
    COLUMN,
    ROW,
    Apply,
    ArrayProgram,
    ArrayStatement,
    Combination,
    ConstantMatrix,
    Diagonal,
    Entry,
    Matrix,
    Multiplication,
    Term,
)
from codegen.ir.decimals import exact
from codegen.ir.expr import Expr
from codegen.ir.number import Number
from codegen.scene.formulas import Reader
from codegen.scene.matrix_formula import (
    Coefficient,
    Constant,
    EntryFormula,
    MatrixFormula,
    Scaled,
    Sum,
    Times,
    Transposed,
    Unknown,
)

ARGUMENT, RESULT = "point", "velocity"
"""The names of the input and the output of an array program."""


@dataclass(frozen=True)
class _Factor:
    """A factor of a product. If ``transposed`` is True, the factor is the transpose of ``formula``."""

    formula: MatrixFormula
    transposed: bool

    @property
    def rows(self) -> int:
        return self.formula.columns if self.transposed else self.formula.rows

    @property
    def columns(self) -> int:
        return self.formula.rows if self.transposed else self.formula.columns

    @property
    def constant(self) -> Constant | None:
        return self.formula if isinstance(self.formula, Constant) else None


@dataclass(frozen=True)
class _Stored:
    """A computed value: ``matrix``, or the transpose of ``matrix`` if ``transposed`` is True."""

    matrix: Matrix
    transposed: bool = False

    @property
    def rows(self) -> int:
        return self.matrix.columns if self.transposed else self.matrix.rows

    @property
    def columns(self) -> int:
        return self.matrix.rows if self.transposed else self.matrix.columns


Summand = tuple[Expr, tuple[_Factor, ...]]
"""A scalar coefficient times a product of matrices: the coefficient, and the factors of the product."""


def array_program(reader: Reader, x: Unknown, formula: MatrixFormula) -> ArrayProgram:
    """Return the array program that computes a formula in the unknown matrix ``x``.

    :class:`SceneError` is raised in four cases:

    - The formula and ``x`` have different sizes.
    - The formula contains another unknown.
    - A summand does not contain ``x``.
    - An entry of a constant matrix is invalid.
    """
    if not isinstance(formula, MatrixFormula) or (formula.rows, formula.columns) != (x.rows, x.columns):
        size = f"{formula.rows} x {formula.columns}" if isinstance(formula, MatrixFormula) else repr(formula)
        raise SceneError(
            f"the velocity is {size}", where=reader.name, expected=f"a formula of size {x.rows} x {x.columns}"
        )
    return _Compiler(reader, x).program(formula)


def matrix_terms(reader: Reader, formula: MatrixFormula) -> tuple[tuple[Expr, ConstantMatrix], ...]:
    """Return the pairs (c, C) of a sum of terms c C, where c is a scalar and C is a constant matrix.

    :class:`SceneError` is raised if ``formula`` contains a product of matrices, an unknown matrix, or a
    constant matrix with an invalid entry.
    """
    compiler = _Compiler(reader, Unknown(formula.rows, 1))
    terms: list[tuple[Expr, ConstantMatrix]] = []
    for c, factors in compiler.summands(formula, reader.space.one, False):
        given = factors[0].constant if len(factors) == 1 else None
        if given is None:
            raise SceneError(
                "the matrix A contains an unknown or a product of matrices",
                where=reader.name,
                expected="a sum of multiples of banded(...) and full(...)",
            )
        terms.append((c, compiler.constant(given, transposed=factors[0].transposed)))
    return tuple(terms)


@dataclass
class _Compiler:
    """Translates one matrix formula into an array program."""

    reader: Reader
    x: Unknown
    body: list[ArrayStatement] = field(default_factory=list)
    known: dict[object, _Stored] = field(default_factory=dict)
    constants: dict[tuple[int, bool], ConstantMatrix] = field(default_factory=dict)

    def program(self, formula: MatrixFormula) -> ArrayProgram:
        """Return the array program that computes the formula."""
        one = self.reader.space.one
        stored = self.total(tuple(self.summands(formula, one, False)), self.x.rows, self.x.columns)
        result = Matrix(RESULT, self.x.rows, self.x.columns)
        self.body.append(Combination(result, (Term(one, stored.matrix, stored.transposed),)))
        return ArrayProgram(self.argument, tuple(_joined(self.body)), result)

    @property
    def argument(self) -> Matrix:
        """The array for the unknown matrix X."""
        return Matrix(ARGUMENT, self.x.rows, self.x.columns)

    def summands(self, formula: MatrixFormula, c: Expr, transposed: bool) -> Iterable[Summand]:
        """Yield products whose sum is c F. F is ``formula``, or its transpose if ``transposed`` is True."""
        match formula:
            case Scaled(factor=factor, matrix=matrix):
                own = self.reader.scalar(factor, "a scalar factor of a matrix")
                yield from self.summands(matrix, c * own, transposed)
            case Sum(left=left, right=right):
                yield from self.summands(left, c, transposed)
                yield from self.summands(right, c, transposed)
            case Transposed(matrix=matrix):
                yield from self.summands(matrix, c, not transposed)
            case Times():
                number, factors = self.factors(formula, transposed)
                yield from self.distributed(c * number, factors)
            case _:
                yield c, (self.factor(formula, transposed),)

    def factor(self, formula: MatrixFormula, transposed: bool) -> _Factor:
        """Return ``formula``, or its transpose if ``transposed`` is True, as a factor of a matrix product.

        :class:`SceneError` is raised for a matrix variable other than ``self.x``.
        """
        if isinstance(formula, Unknown) and formula is not self.x:
            raise SceneError(
                "the velocity contains an unknown matrix other than x",
                where=self.reader.name,
                expected="a formula in x",
            )
        return _Factor(formula, transposed)

    def factors(self, formula: MatrixFormula, transposed: bool) -> tuple[Expr, tuple[_Factor, ...]]:
        """Write ``formula`` as a scalar times a product of factors. Return the scalar and the factors.

        If ``transposed`` is True, use the transpose of the formula.
        """
        match formula:
            case Times(left=left, right=right):
                (a, first), (b, second) = (self.factors(part, transposed) for part in (left, right))
                return a * b, (*second, *first) if transposed else (*first, *second)
            case Transposed(matrix=matrix):
                return self.factors(matrix, not transposed)
            case Scaled(factor=factor, matrix=matrix):
                own, inner = self.factors(matrix, transposed)
                return self.reader.scalar(factor, "a scalar factor of a matrix") * own, inner
            case _:
                return self.reader.space.one, (self.factor(formula, transposed),)

    def distributed(self, c: Expr, factors: tuple[_Factor, ...]) -> Iterable[Summand]:
        """Yield products whose sum is c times the product of ``factors``."""
        for k, factor in enumerate(factors):
            parts = tuple(self.summands(factor.formula, self.reader.space.one, factor.transposed))
            alone = [inner for _, inner in parts if len(inner) == 1 and inner[0].constant is not None]
            large = min(factor.rows, factor.columns) > self.x.columns
            if isinstance(factor.formula, Sum) and (alone or large):
                for own, inner in parts:
                    yield from self.distributed(c * own, (*factors[:k], *inner, *factors[k + 1 :]))
                return
        yield c, factors

    def total(self, summands: tuple[Summand, ...], rows: int, columns: int) -> _Stored:
        """Append the statements for a sum of size ``rows`` x ``columns``, and return the sum."""
        values = [(c, self.product(factors)) for c, factors in summands]
        if len(values) == 1 and values[0][0] is self.reader.space.one:
            return values[0][1]
        # If the sum has more columns than rows, the program stores the transpose of the sum.
        flipped = columns > rows
        target = self.fresh(*((columns, rows) if flipped else (rows, columns)))
        terms = tuple(Term(c, v.matrix, v.transposed is not flipped) for c, v in values)
        self.body.append(Combination(target, terms))
        return _Stored(target, flipped)

    def fresh(self, rows: int, columns: int) -> Matrix:
        """Return a new array for an intermediate value."""
        return Matrix(f"value {len(self.body) + 1}", rows, columns)

    def product(self, factors: tuple[_Factor, ...]) -> _Stored:
        """Append the statements for the product of the factors, and return the product.

        If an earlier call had the same factors, return the product of that call, and append nothing.
        """
        if factors not in self.known:
            self.known[factors] = self._product(factors)
        return self.known[factors]

    def _product(self, factors: tuple[_Factor, ...]) -> _Stored:
        if len(factors) == 1:
            return self.single(factors[0])
        cost, k = _cheapest(factors)
        if cost == inf:
            raise self.constant_product()
        left, right = factors[:k], factors[k:]
        for side, others, from_right in ((left, right, False), (right, left, True)):
            if len(side) == 1 and side[0].constant is not None:
                return self.applied(side[0], self.product(others), from_right)
        return self.multiplied(self.product(left), self.product(right))

    def single(self, factor: _Factor) -> _Stored:
        """Return the value of one factor. Raise SceneError if the factor is a constant matrix."""
        if factor.constant is not None:
            raise self.constant_product()
        if isinstance(factor.formula, Unknown):
            return _Stored(self.argument, factor.transposed)
        summands = tuple(self.summands(factor.formula, self.reader.space.one, factor.transposed))
        return self.total(summands, factor.rows, factor.columns)

    def constant_product(self) -> SceneError:
        """Return the error for a summand that is a constant matrix or a product of constant matrices."""
        return SceneError(
            "a constant matrix that is not multiplied by X",
            where=self.reader.name,
            expected="a formula in which each product contains X",
        )

    def applied(self, factor: _Factor, other: _Stored, from_right: bool) -> _Stored:
        """Return the product of a constant matrix and the matrix ``other``.

        The constant matrix is the right factor if ``from_right`` is True, otherwise the left factor.
        """
        assert factor.constant is not None
        constant = self.constant(factor.constant)
        # The product C Z^T is stored as its transpose Z C^T, because the statement Apply cannot transpose Z.
        transposed = factor.transposed is not other.transposed
        right = from_right is not other.transposed
        rows = other.rows if from_right else factor.rows
        columns = factor.columns if from_right else other.columns
        target = self.fresh(*((columns, rows) if other.transposed else (rows, columns)))
        self.body.append(Apply(target, constant, other.matrix, transposed, right))
        return _Stored(target, other.transposed)

    def multiplied(self, left: _Stored, right: _Stored) -> _Stored:
        """Return the product of two matrices that depend on X."""
        rows, columns = left.rows, right.columns
        if columns > rows:
            # If the product A B has more columns than rows, its transpose B^T A^T is stored.
            target = self.fresh(columns, rows)
            turned = (not right.transposed, not left.transposed)
            self.body.append(Multiplication(target, right.matrix, left.matrix, *turned))
            return _Stored(target, True)
        target = self.fresh(rows, columns)
        self.body.append(Multiplication(target, left.matrix, right.matrix, left.transposed, right.transposed))
        return _Stored(target)

    def constant(self, given: Constant, *, transposed: bool = False) -> ConstantMatrix:
        """Return the matrix ``given`` as a :class:`ConstantMatrix`.

        If ``transposed`` is True, return the transpose of ``given``.
        """
        key = id(given), transposed
        if key not in self.constants:
            name = f"matrix_{len(self.constants) + 1}"
            own = _transposed(given) if transposed else given
            self.constants[key] = _constant(self.reader, name, own)
        return self.constants[key]


def _joined(body: list[ArrayStatement]) -> list[ArrayStatement]:
    """Return the statements, without the last one if it only assigns the preceding result to a new name.

    The preceding statement then stores its result under the new name.
    """
    *before, last = body
    assert isinstance(last, Combination)
    (term,) = last.terms
    if not before or before[-1].target != term.matrix or term.transposed:
        return body
    return [*before[:-1], replace(before[-1], target=last.target)]


def _cheapest(factors: tuple[_Factor, ...]) -> tuple[float, int]:
    """Return the pair (number of scalar multiplications, k) for the best order of a product of matrices.

    In the best order, the last multiplication is (product of the first k factors) times (product of the
    other factors).
    """
    n = len(factors)
    best: dict[tuple[int, int], tuple[float, int]] = {(i, i + 1): (0.0, i) for i in range(n)}
    for length in range(2, n + 1):
        for i in range(n - length + 1):
            j = i + length
            splits = [
                (best[i, k][0] + best[k, j][0] + _cost(factors[i:k], factors[k:j]), k)
                for k in range(i + 1, j)
            ]
            best[i, j] = min(splits)
    cost, k = best[0, n]
    return cost, k


def _cost(left: tuple[_Factor, ...], right: tuple[_Factor, ...]) -> float:
    """Return the number of scalar multiplications for the product of two matrices.

    ``left`` and ``right`` contain the factors of the two matrices.
    """
    rows, inner, columns = left[0].rows, right[0].rows, right[-1].columns
    first, second = (side[0].constant if len(side) == 1 else None for side in (left, right))
    if first is not None and second is not None:
        return inf
    if first is not None:
        return _filled(first) * columns
    if second is not None:
        return rows * _filled(second)
    return rows * inner * columns


def _filled(constant: Constant) -> float:
    if constant.diagonals is None:
        return constant.rows * constant.columns
    return len(constant.diagonals) * constant.rows


def _transposed(given: Constant) -> Constant:
    """Return the transpose of a constant matrix."""
    if given.diagonals is not None:
        # The diagonal ``offset`` of a matrix is the diagonal ``-offset`` of its transpose.
        diagonals = {-offset: _shifted(entry, offset) for offset, entry in given.diagonals.items()}
        return Constant(given.columns, given.rows, diagonals, None)
    entries = given.entries
    if callable(entries):
        formula = entries
        return Constant(given.columns, given.rows, None, lambda i, j: formula(j, i))
    numbers = _flat(entries)
    if numbers is None or len(numbers) != given.rows * given.columns:
        return Constant(given.columns, given.rows, None, entries)
    turned = [numbers[i * given.columns + j] for j in range(given.columns) for i in range(given.rows)]
    return Constant(given.columns, given.rows, None, cast("Sequence[Coefficient]", turned))


def _shifted(entry: EntryFormula, offset: int) -> EntryFormula:
    return (lambda i: entry(i - offset)) if callable(entry) else entry


def _constant(reader: Reader, name: str, given: Constant) -> ConstantMatrix:
    import sympy

    row, column = sympy.Symbol(ROW), sympy.Symbol(COLUMN)
    size = given.rows * given.columns
    if given.diagonals is None:
        assert given.entries is not None
        entry = _entry(
            reader, given.entries, (row, column), size, f"the {given.rows} x {given.columns} matrix"
        )
        return ConstantMatrix(name, given.rows, given.columns, (), entry)
    matrix = ConstantMatrix(name, given.rows, given.columns)
    diagonals = []
    # The main diagonal comes first, because it has an entry in every row of a square matrix. Then the first
    # loop of the emitted matrix product assigns all rows, and the result need not be set to zero before.
    for offset in sorted(given.diagonals, key=lambda x: (abs(x), x)):
        length = matrix.length(Diagonal(offset, ()))
        entry = _entry(reader, given.diagonals[offset], (row,), length, f"the diagonal {offset}")
        diagonals.append(Diagonal(offset, entry))
    return ConstantMatrix(name, given.rows, given.columns, tuple(diagonals))


def _entry(reader: Reader, given: EntryFormula, indices: tuple[object, ...], size: int, what: str) -> Entry:
    """Return the entries of a matrix or of a diagonal.

    ``given`` is a list of ``size`` rational numbers, a function of ``indices``, or one scalar for all
    entries. For a list, the result is a tuple of numbers. Otherwise the result is one formula for all
    entries. SceneError is raised for a list with a wrong number of entries, and for a list with an entry that
    is not a rational number.
    """
    if callable(given):
        given = given(*indices)
    numbers = _flat(given)
    if numbers is None:
        return reader.scalar(given, f"the entries of {what}", more=(ROW, COLUMN))
    if len(numbers) != size:
        raise SceneError(
            f"{len(numbers)} entries of {what}", where=reader.name, expected=f"{size} entries, or a function"
        )
    values = [exact(x) for x in numbers]
    if None in values:
        wrong = numbers[values.index(None)]
        raise SceneError(f"the entry {wrong!r} of {what}", where=reader.name, expected="a rational number")
    return tuple(Number.rational(x.numerator, x.denominator) for x in values if x is not None)


def _flat(given: object) -> list[object] | None:
    """Return the entries of a vector or of nested rows as one flat list. For a scalar, return None."""
    if hasattr(given, "tolist"):
        given = given.tolist()
    if not isinstance(given, list | tuple):
        return None
    entries: list[object] = []
    for entry in given:
        inner = _flat(entry)
        entries += [entry] if inner is None else inner
    return entries
