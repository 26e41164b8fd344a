"""Array programs: lists of assignments to matrices. Emitted code executes assignments in loops.

A :class:`Matrix` is an array, or a rectangular part of an array. The entries of a constant matrix are numbers
or formulas in the row index :data:`ROW` and the column index :data:`COLUMN`. Indices begin at zero.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from dataclasses import dataclass, replace

from codegen.ir.domain import Domain, ExprDomain, Scalar
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number

ROW, COLUMN = "row.index", "column.index"
"""The names of the symbols for the row index and the column index of an entry. The dot prevents a
collision with a name of a user.
"""

Arrays = MutableMapping[str, list[Scalar]]
"""A dictionary that maps the name of an array to the entries of the array, row by row."""


@dataclass(frozen=True)
class Matrix:
    """A matrix that is stored row by row in the array ``name``. The first entry of the matrix has the index
    ``start`` in the array.

    If ``stride`` is positive, it is the distance in the array between the first entries of successive rows.
    The default 0 means that this distance is the number of columns.
    """

    name: str
    rows: int
    columns: int
    start: int = 0
    stride: int = 0

    @property
    def step(self) -> int:
        """The distance in the array between the first entries of successive rows."""
        return self.stride or self.columns

    def place(self, row: int, column: int) -> int:
        """Return the index of the entry (``row``, ``column``) in the array of this matrix."""
        return self.start + row * self.step + column

    def part(self, row: int, column: int, rows: int, columns: int) -> Matrix:
        """Return the submatrix with ``rows`` rows and ``columns`` columns. The first entry of the submatrix
        is the entry (``row``, ``column``) of this matrix.
        """
        # The submatrix and this matrix use the same array, so they have the same distance between successive
        # rows.
        return Matrix(self.name, rows, columns, self.place(row, column), self.step)

    @property
    def size(self) -> int:
        """The number of entries."""
        return self.rows * self.columns


Entry = Expr | tuple[Number, ...]
"""The entries of a matrix or of one of its diagonals: numbers, or a formula in :data:`ROW` and
:data:`COLUMN`.
"""


@dataclass(frozen=True)
class Diagonal:
    """A diagonal of a matrix a: the entries a_{i, i + offset}.

    ``entry`` is a tuple of these entries from top to bottom, or one formula for all of these entries. In the
    formula, the symbols :data:`ROW` and :data:`COLUMN` are the row index and the column index of an entry.
    """

    offset: int
    entry: Entry


@dataclass(frozen=True)
class ConstantMatrix:
    """A constant matrix. ``diagonals`` contains the entries of a banded matrix.

    For other matrices, ``full`` is a tuple of numbers, row by row, or a formula in :data:`ROW` and
    :data:`COLUMN`.
    """

    name: str
    rows: int
    columns: int
    diagonals: tuple[Diagonal, ...] = ()
    full: Entry = ()

    @property
    def entries(self) -> tuple[Entry, ...]:
        """The attribute ``entry`` of each diagonal. If the matrix is not stored by diagonals, the result has
        one element: the attribute ``full``, which contains all entries or a formula for them.
        """
        return tuple(d.entry for d in self.diagonals) or (self.full,)

    def length(self, diagonal: Diagonal) -> int:
        """Return the number of entries of a diagonal."""
        # The rows low, ..., high - 1 have an entry on this diagonal.
        low, high = max(0, -diagonal.offset), min(self.rows, self.columns - diagonal.offset)
        # A diagonal outside of the matrix has ``low`` >= ``high``, so its length is zero.
        return max(0, high - low)

    @property
    def filled(self) -> int:
        """The number of entries on ``diagonals``, or of all entries if ``diagonals`` is empty."""
        if self.diagonals:
            return sum(map(self.length, self.diagonals))
        return self.rows * self.columns

    def values(self, domain: Domain, symbols: Mapping[str, Scalar]) -> Iterator[tuple[int, int, Scalar]]:
        """Yield (row, column, value) for each entry on ``diagonals``, or for all entries if there are no
        ``diagonals``.

        ``symbols`` maps the symbols in formulas to their values.
        """
        for diagonal in self.diagonals:
            # A diagonal with a negative offset begins in row -offset, because column indices begin at 0.
            first = max(0, -diagonal.offset)
            places = [(i, i + diagonal.offset) for i in range(first, first + self.length(diagonal))]
            yield from _valued(domain, symbols, places, diagonal.entry)
        if not self.diagonals:
            every = [(i, j) for i in range(self.rows) for j in range(self.columns)]
            yield from _valued(domain, symbols, every, self.full)


def _valued(
    domain: Domain, symbols: Mapping[str, Scalar], places: Sequence[tuple[int, int]], entry: Entry
) -> Iterator[tuple[int, int, Scalar]]:
    if isinstance(entry, tuple):
        yield from ((i, j, domain.number(x)) for (i, j), x in zip(places, entry, strict=True))
        return
    formulas, read = ExprDomain(entry.space), {n.payload for n in walk([entry]) if n.op == "sym"}
    # ``evaluate`` needs a value for each symbol, so each symbol is mapped to itself.
    kept = {s: entry.space.sym(s) for s in read}
    for i, j in places:
        # A formula may compare the indices i and j. The first call of ``evaluate`` decides the comparisons,
        # because it replaces the symbols of the indices by numbers.
        indices = {ROW: formulas.rational(i), COLUMN: formulas.rational(j)}
        formula = evaluate([entry], formulas, {**kept, **indices})
        yield i, j, evaluate(formula, domain, symbols)[0]


@dataclass(frozen=True)
class Multiplication:
    """The statement target = L R, or target = target + L R if ``added`` is true.

    L is the matrix ``left``, or its transpose if ``left_transposed`` is true. R is the matrix ``right``, or
    its transpose if ``right_transposed`` is true. The target must not share its array with L or R.
    """

    target: Matrix
    left: Matrix
    right: Matrix
    left_transposed: bool = False
    right_transposed: bool = False
    added: bool = False

    @property
    def inner(self) -> int:
        """The number of columns of the left factor L, equal to the number of rows of the right factor R."""
        return self.left.rows if self.left_transposed else self.left.columns


@dataclass(frozen=True)
class Apply:
    """The assignment ``target = C M``, or ``target = M C`` if ``from_right`` is true.

    C is the matrix ``constant``, or its transpose if ``transposed`` is true. M is ``matrix``.
    """

    target: Matrix
    constant: ConstantMatrix
    matrix: Matrix
    transposed: bool = False
    from_right: bool = False


@dataclass(frozen=True)
class Term:
    """One term of a :class:`Combination`: a coefficient times a matrix, or times its transpose.

    If the term has fewer rows or columns than the target, the missing entries are zero.
    """

    coefficient: Expr
    matrix: Matrix
    transposed: bool = False

    @property
    def shape(self) -> tuple[int, int]:
        """The number of rows and the number of columns of this term."""
        m = self.matrix
        return (m.columns, m.rows) if self.transposed else (m.rows, m.columns)


@dataclass(frozen=True)
class Combination:
    """Assign the sum of ``terms`` to ``target``. Without terms the target becomes zero.

    If a term contains the old value of the target, it must be the first term, and it must not be transposed.
    """

    target: Matrix
    terms: tuple[Term, ...]


ArrayStatement = Multiplication | Apply | Combination

Renaming = Callable[[Matrix], Matrix]
"""A function that returns the replacement of a given matrix."""


@dataclass(frozen=True)
class ArrayProgram:
    """The assignments in ``body`` compute the matrix ``result`` from the matrix ``argument``."""

    argument: Matrix
    body: tuple[ArrayStatement, ...]
    result: Matrix

    def expressions(self) -> Iterator[Expr]:
        """Yield the expressions in ``body``: coefficients of terms, and formulas of constant matrices."""
        for statement in self.body:
            if isinstance(statement, Combination):
                yield from (term.coefficient for term in statement.terms)
            elif isinstance(statement, Apply):
                yield from (e for e in statement.constant.entries if not isinstance(e, tuple))

    def constants(self) -> tuple[ConstantMatrix, ...]:
        """Return the constant matrices in the statements, each once, in the order of first use."""
        # ``dict.fromkeys`` removes duplicates and keeps the order of first use.
        return tuple(dict.fromkeys(s.constant for s in self.body if isinstance(s, Apply)))

    def evaluate(
        self, domain: Domain, argument: Sequence[Scalar], symbols: Mapping[str, Scalar]
    ) -> list[Scalar]:
        """Execute the program, and return the entries of the result, row by row.

        ``argument`` contains the entries of the argument, row by row. ``symbols`` contains the values of all
        symbols except :data:`ROW` and :data:`COLUMN`.
        """
        arrays: Arrays = {self.argument.name: list(argument)}
        for statement in self.body:
            evaluated(statement, domain, arrays, symbols)
        return _entries(self.result, arrays)

    def moved(self, argument: Matrix, result: Matrix, name: str) -> tuple[ArrayStatement, ...]:
        """Return the statements of this program for use inside another program.

        The matrices ``argument`` and ``result`` replace ``self.argument`` and ``self.result``. The names of
        all other arrays get the prefix ``name``.
        """

        def now(matrix: Matrix) -> Matrix:
            # ``argument`` and ``result`` belong to the surrounding program and keep their names. All other
            # matrices get the prefix ``name``, because the surrounding program may use their names, too.
            if matrix.name == self.argument.name:
                return argument
            return result if matrix == self.result else replace(matrix, name=f"{name} {matrix.name}")

        return tuple(_renamed(statement, now) for statement in self.body)


def _renamed(statement: ArrayStatement, now: Renaming) -> ArrayStatement:
    target = now(statement.target)
    match statement:
        case Multiplication(left=left, right=right):
            return replace(statement, target=target, left=now(left), right=now(right))
        case Apply(matrix=matrix):
            return replace(statement, target=target, matrix=now(matrix))
        case Combination(terms=terms):
            moved = tuple(replace(term, matrix=now(term.matrix)) for term in terms)
            return replace(statement, target=target, terms=moved)


def _entries(matrix: Matrix, arrays: Arrays) -> list[Scalar]:
    array = arrays[matrix.name]
    return [array[matrix.place(i, j)] for i in range(matrix.rows) for j in range(matrix.columns)]


def evaluated(
    statement: ArrayStatement, domain: Domain, arrays: Arrays, symbols: Mapping[str, Scalar]
) -> None:
    """Execute one statement with scalars of ``domain``, and store the result in ``arrays``."""
    target = statement.target
    zero = domain.rational(0)
    # The target of the first assignment to an array must be the whole array.
    array = arrays.setdefault(target.name, [zero] * target.size)
    match statement:
        case Multiplication():
            values = _product(statement, arrays, zero)
        case Apply():
            values = _applied(statement, domain, arrays, symbols)
        case Combination(terms=terms):
            # The old value of the target may occur in a term, so the target is changed last.
            values = [zero] * target.size
            for term in terms:
                c = evaluate([term.coefficient], domain, symbols)[0]
                other, (rows, columns) = arrays[term.matrix.name], term.shape
                for i in range(rows):
                    for j in range(columns):
                        at = term.matrix.place(j, i) if term.transposed else term.matrix.place(i, j)
                        # A term with fewer rows or columns is added to the upper left corner of the target.
                        place = i * target.columns + j
                        values[place] = values[place] + c * other[at]
    for i in range(target.rows):
        for j in range(target.columns):
            array[target.place(i, j)] = values[i * target.columns + j]


def _applied(statement: Apply, domain: Domain, arrays: Arrays, symbols: Mapping[str, Scalar]) -> list[Scalar]:
    target, matrix = statement.target, statement.matrix
    # The scalars may be power series, so the zero must come from ``domain``.
    values = [domain.rational(0)] * target.size
    other = arrays[matrix.name]
    for i, j, a in statement.constant.values(domain, symbols):
        row, column = (j, i) if statement.transposed else (i, j)
        # The entry C[row, column] is ``a``. The first loop adds M[b, row] * ``a`` to target[b, column].
        if statement.from_right:
            for b in range(target.rows):
                at = b * target.columns + column
                values[at] = values[at] + other[matrix.place(b, row)] * a
            continue
        for b in range(target.columns):
            at = row * target.columns + b
            values[at] = values[at] + a * other[matrix.place(column, b)]
    return values


def _product(statement: Multiplication, arrays: Arrays, zero: Scalar) -> list[Scalar]:
    target, left, right = statement.target, statement.left, statement.right
    a, b = arrays[left.name], arrays[right.name]
    # If ``added`` is true, the first term of each sum is the old entry of the target.
    start = _entries(target, arrays) if statement.added else [zero] * target.size
    values = []
    for i in range(target.rows):
        for j in range(target.columns):
            # ``start`` contains one value for each entry of the target, row by row without gaps.
            total = start[i * target.columns + j]
            for k in range(statement.inner):
                # The entries of a transposed factor are read with exchanged indices.
                x = a[left.place(k, i) if statement.left_transposed else left.place(i, k)]
                y = b[right.place(j, k) if statement.right_transposed else right.place(k, j)]
                total = total + x * y
            values.append(total)
    return values


def operations(statement: ArrayStatement) -> dict[str, int]:
    """Return the numbers of additions (``add``) and multiplications (``mul``) of a statement.

    Operations in the formulas for the entries of constant matrices are not counted.
    """
    size = statement.target.size
    match statement:
        case Multiplication():
            # A sum of k products needs k - 1 additions, and one more if the sum is added to the target.
            return {"add": size * (statement.inner - 1 + statement.added), "mul": size * statement.inner}
        case Apply(constant=constant, target=target):
            products = constant.filled * (target.rows if statement.from_right else target.columns)
            # A sum of k > 0 products needs k - 1 additions.
            return {"add": max(0, products - size), "mul": products}
        case Combination(terms=terms):
            sizes = [term.matrix.size for term in terms]
            scaled = [n for n, t in zip(sizes, terms, strict=True) if not _is_unit(t.coefficient)]
            # The first term is only copied, and a coefficient 1 or -1 needs no multiplication.
            return {"add": sum(sizes[1:]), "mul": sum(scaled)}


def _is_unit(c: Expr) -> bool:
    return c.op == "const" and bool(c.payload.is_one or c.payload.is_minus_one)
