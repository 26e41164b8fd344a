"""Build the loops for assignments of whole matrices (:mod:`codegen.ir.array_program`).

The length of the emitted code does not depend on the size of the matrices. A product of matrices is computed
in blocks with two rows and four columns. The eight sums for the entries of a block do not depend on each
other, so a processor can compute them at the same time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from codegen.ir.array_program import (
    COLUMN,
    ROW,
    Apply,
    ArrayStatement,
    Combination,
    ConstantMatrix,
    Diagonal,
    Entry,
    Matrix,
    Multiplication,
)
from codegen.ir.array_program import Term as Summand
from codegen.ir.array_step import AddUnit
from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.precision import Precision
from codegen.run.language import Assign, For, Statement, Table
from codegen.run.terms import Term, count, narrow, number, own, real, value, whole, wide

GROUP = 4
"""The number of columns in a group. Matrix products are computed group by group."""

_ROW, _COLUMN, _TERM = count("i"), count("j"), count("k")
_FIRST, _SECOND = count("first_row"), count("second_row")
_ENTRY = real("entry")
"""The variable that contains the current entry of a constant matrix."""

Index = Term | int
Group = Callable[[Term | None, int], Iterator[Statement]]
"""A function that yields the statements for a group of columns.

The arguments are the first column of the group (None for column 0) and the number of columns.
"""


@dataclass(frozen=True)
class ArrayLoops:
    """Translates assignments of matrices into loops.

    ``arrays`` maps names of matrices to arrays. For other matrices, the array has the name of the matrix.
    """

    arrays: dict[str, Term]

    def array(self, matrix: Matrix, size: int = 0) -> Term:
        """Return the array that contains a matrix.

        If ``arrays`` contains an array for ``matrix.name``, this array is returned. Otherwise, a new array
        with the name of the matrix is returned. The new array has ``size`` entries. If ``size`` is 0, the
        new array has as many entries as the matrix.
        """
        known = self.arrays.get(matrix.name)
        return own(matrix.name, size or matrix.size) if known is None else known

    def entry(self, matrix: Matrix, row: Index, column: Index) -> Term:
        """Return an entry of a matrix."""
        return self.array(matrix)[_place(matrix, row, column)]

    def statements(self, statement: ArrayStatement | AddUnit) -> Iterator[Statement]:
        """Yield the loops for ``statement``, which assigns a value to a whole matrix."""
        match statement:
            case Multiplication():
                yield from self.product(statement)
            case Apply(from_right=True):
                yield from self.applied_from_right(statement)
            case Apply():
                yield from self.applied(statement)
            case Combination():
                yield from self.combination(statement)
            case AddUnit(target=target, value=unit):
                entry = self.entry(target, _ROW, _ROW)
                yield For(_ROW, whole(target.rows), (Assign(entry, entry + number(float(unit))),))

    def product(self, p: Multiplication) -> Iterator[Statement]:
        """Yield the loops of a product of two matrices."""

        def factor(row: Index, k: Term) -> Term:
            return self.entry(p.left, k, row) if p.left_transposed else self.entry(p.left, row, k)

        def other(k: Term, column: Index) -> Term:
            return self.entry(p.right, column, k) if p.right_transposed else self.entry(p.right, k, column)

        def lines(*rows: Index) -> tuple[Statement, ...]:
            def group(first: Term | None, columns: int) -> Iterator[Statement]:
                places = [_shifted(first, c) for c in range(columns)]
                yield from self.sums(p.target, rows, places, p.inner, factor, other, added=p.added)

            return tuple(_in_groups(p.target.columns, group))

        # Both rows of a pair are multiplied by the same entries of the right factor, so each of these entries
        # is loaded only once.
        pairs, rest = divmod(p.target.rows, 2)
        if pairs:
            first = (Assign(_FIRST, 2 * _ROW), Assign(_SECOND, _FIRST + 1))
            yield For(_ROW, whole(pairs), (*first, *lines(_FIRST, _SECOND)))
        if rest:
            # If the number of rows is odd, the last row is computed alone.
            yield from lines(2 * pairs)

    def sums(
        self,
        target: Matrix,
        rows: Sequence[Index],
        columns: Sequence[Index],
        inner: int,
        factor: Callable[[Index, Term], Term],
        other: Callable[[Term, Index], Term],
        *,
        added: bool = False,
        before: Sequence[Statement] = (),
    ) -> Iterator[Statement]:
        """Yield the statements that compute the entries of the target in the given rows and columns.

        Each entry is the sum of ``factor(row, k) * other(k, column)`` over k = 0, ..., ``inner`` - 1. If
        ``added`` is True, the sum is added to the old entry. Each iteration of the loop over k begins with
        the statements ``before``.
        """
        # The sums are scalar variables, so a compiler can keep them in registers.
        totals: list[tuple[Term, Index, Index]] = []
        terms = [*before]
        for r, row in enumerate(rows):
            # The left factor does not depend on the column, so it is loaded once for each row.
            left = real(f"factor_{r}")
            terms.append(Assign(left, factor(row, _TERM)))
            for c, column in enumerate(columns):
                total = real(f"total_{r}_{c}")
                totals.append((total, row, column))
                terms.append(Assign(total, total + left * other(_TERM, column)))
        for total, row, column in totals:
            yield Assign(total, self.entry(target, row, column) if added else number(0.0))
        yield For(_TERM, whole(inner), tuple(terms))
        for total, row, column in totals:
            yield Assign(self.entry(target, row, column), total)

    def combination(self, c: Combination) -> Iterator[Statement]:
        """Yield the loops of a linear combination of matrices."""
        target = c.target
        # All terms with the shape of the target are added in one loop. A term with fewer rows or columns
        # is added by a separate loop over the upper left part of the target.
        full = [t for t in c.terms if t.shape == (target.rows, target.columns)]
        weights: dict[int, Term | None] = {}
        for n, term in enumerate(c.terms):
            weights[id(term)], statements = self.weight(f"{target.name} weight {n}", term.coefficient)
            yield from statements
        # Without gaps between rows and without transposed matrices, one loop over all entries is enough.
        flat = _is_whole(target) and all(_is_whole(t.matrix) and not t.transposed for t in full)
        yield self.over(target, lambda place: self.total(full, weights, place), flat=flat)
        for term in c.terms:
            if any(term is t for t in full):
                continue
            part = target.part(0, 0, *term.shape)

            # The loop adds the entries of ``term`` to the old entries of the target.
            def more(place: _Place, term: Summand = term, part: Matrix = part) -> Term:
                return _plus(self.at(part, place), term, weights[id(term)], self.summand(term, place))

            yield self.over(part, more, flat=False)

    def total(self, terms: Sequence[Summand], weights: dict[int, Term | None], place: _Place) -> Term:
        """Return one entry of the matrix that is the sum of ``terms``. ``place`` is the position of the
        entry.

        ``weights`` maps the id of a term to the emitted value of its coefficient (see :meth:`weight`).
        """
        # If no term has the shape of the target, ``terms`` is empty, and the entry is zero.
        result: Term | None = None
        for term in terms:
            result = _plus(result, term, weights[id(term)], self.summand(term, place))
        return number(0.0) if result is None else result

    def summand(self, term: Summand, place: _Place) -> Term:
        """Return the entry of ``term`` at ``place``. The term is a matrix or the transpose of a matrix."""
        turned = _Place(place.column, place.row) if term.transposed and place.column is not None else place
        return self.at(term.matrix, turned)

    def at(self, matrix: Matrix, place: _Place) -> Term:
        """Return the entry of a matrix at the position ``place``."""
        if place.column is None:
            # The first entry of the matrix has the index ``matrix.start`` in the array.
            return self.array(matrix)[place.row if not matrix.start else place.row + matrix.start]
        return self.entry(matrix, place.row, place.column)

    def over(self, target: Matrix, entry: Callable[[_Place], Term], *, flat: bool) -> Statement:
        """Return the loops that assign ``entry(place)`` to each entry of a matrix.

        If ``flat`` is True, there is a single loop over all entries instead of two nested loops.
        """
        if flat:
            place = _Place(_ROW, None)
            return For(_ROW, whole(target.size), (Assign(self.at(target, place), entry(place)),))
        place = _Place(_ROW, _COLUMN)
        inner = For(_COLUMN, whole(target.columns), (Assign(self.at(target, place), entry(place)),))
        return For(_ROW, whole(target.rows), (inner,))

    def weight(self, name: str, c: Expr) -> tuple[Term | None, list[Statement]]:
        """Return the emitted value of the coefficient ``c``, and the statements that compute this value.

        If ``c`` is 1 or -1, the value is None. Then :func:`_plus` adds or subtracts without a multiplication.
        """
        if _sign(c):
            return None, []
        if c.op in ("const", "sym"):
            return value(c), []
        # The coefficient is computed once, before the loop over the matrix entries.
        return own(name), [Assign(own(name), value(c))]

    def applied(self, a: Apply) -> Iterator[Statement]:
        """Yield the loops for the product C M of a constant matrix C and a variable matrix M."""
        c, target = a.constant, a.target
        if not c.diagonals:
            yield from self.applied_full(a)
            return
        # The loops after the first one add values to rows of the target. If the first loop does not assign
        # all rows, the target is first set to zero.
        if not _covers(c):
            yield self.over(target, lambda place: number(0.0), flat=_is_whole(target))
        for n, diagonal in enumerate(c.diagonals):
            i, j = along(diagonal, _ROW)
            before, entry = constant_entry(diagonal.entry, table_name(c, n), i, j, _ROW)
            # The entry in row i and column j of a matrix is in row j and column i of its transpose.
            row, column = (j, i) if a.transposed else (i, j)
            columns = _in_groups(target.columns, self.scaled_row(a, row, column, added=n > 0))
            # The entry of the constant matrix is assigned to a variable, so its formula is evaluated only
            # once.
            body = (*before, Assign(_ENTRY, entry), *columns)
            yield For(_ROW, whole(c.length(diagonal)), body)

    def scaled_row(self, a: Apply, row: Term, column: Term, *, added: bool) -> Group:
        """Return a function that yields the statements for a group of adjacent columns of ``a.target``.

        The target is the product C M of a constant matrix C and the matrix M = ``a.matrix``. The variable
        :data:`_ENTRY` contains the entry C_ij with i = ``row`` and j = ``column``. The statements multiply
        C_ij by row j of M. If ``added`` is True, the product is added to row i of ``a.target``. Otherwise,
        the product overwrites this row. Only the columns of the group are computed.
        """

        def set_columns(first: Term | None, columns: int) -> Iterator[Statement]:
            for place in (_shifted(first, b) for b in range(columns)):
                goal = self.entry(a.target, row, place)
                one = _ENTRY * self.entry(a.matrix, column, place)
                yield Assign(goal, goal + one if added else one)

        return set_columns

    def applied_full(self, a: Apply) -> Iterator[Statement]:
        """Yield the loops for the product C M of a full constant matrix C and a variable matrix M."""
        c = a.constant
        # i and j are the row and the column of an entry of ``c``. If ``a.transposed`` is True, the transpose
        # of ``c`` is multiplied by M, so i and j are exchanged.
        i, j = (_TERM, _ROW) if a.transposed else (_ROW, _TERM)
        before, entry = constant_entry(c.full, c.name, i, j, c.columns * i + j)

        def group(first: Term | None, columns: int) -> Iterator[Statement]:
            yield from self.sums(
                *(a.target, [_ROW], [_shifted(first, n) for n in range(columns)], a.matrix.rows),
                lambda row, k: entry,
                lambda k, column: self.entry(a.matrix, k, column),
                # The statements ``before`` can depend on _TERM, so the loop over _TERM contains them.
                before=before,
            )

        yield For(_ROW, whole(a.target.rows), tuple(_in_groups(a.target.columns, group)))

    def applied_from_right(self, a: Apply) -> Iterator[Statement]:
        """Yield the loops for the product M C of a variable matrix M and a constant matrix C."""
        c, target = a.constant, a.target
        # The target is set to zero, because the loops below only add numbers to it.
        yield self.over(target, lambda place: number(0.0), flat=_is_whole(target))

        def inner(i: Term, j: Term, before: Sequence[Statement], entry: Term) -> tuple[Statement, ...]:
            # Entry (k, column) of M C is the sum of M[k, row] C[row, column] over ``row``.
            row, column = (j, i) if a.transposed else (i, j)
            goal, line = self.entry(target, _TERM, column), self.entry(a.matrix, _TERM, row)
            rows = For(_TERM, whole(target.rows), (Assign(goal, goal + line * _ENTRY),))
            return (*before, Assign(_ENTRY, entry), rows)

        if not c.diagonals:
            before, entry = constant_entry(c.full, c.name, _ROW, _COLUMN, c.columns * _ROW + _COLUMN)
            body = For(_COLUMN, whole(c.columns), inner(_ROW, _COLUMN, before, entry))
            yield For(_ROW, whole(c.rows), (body,))
        for n, diagonal in enumerate(c.diagonals):
            i, j = along(diagonal, _ROW)
            before, entry = constant_entry(diagonal.entry, table_name(c, n), i, j, _ROW)
            yield For(_ROW, whole(c.length(diagonal)), inner(i, j, before, entry))


@dataclass(frozen=True)
class _Place:
    """The position of an entry in a matrix: a row and a column.

    If ``column`` is None, the entries are numbered row by row from 0, and ``row`` contains the number of the
    entry.
    """

    row: Term
    column: Term | None


def constant_entry(
    given: Entry, table: str, row: Term, column: Term, place: Term
) -> tuple[list[Statement], Term]:
    """Return the statements that prepare an entry of a constant matrix, and the entry.

    If ``given`` is a tuple of numbers, the entry is read from the table ``table`` at the index ``place``. If
    ``given`` is a formula, the statements convert its row and column indices to reals.
    """
    if isinstance(given, tuple):
        return [], real(table, len(given))[place]
    read = {node.payload for node in walk([given]) if node.op == "sym"}
    indices = ((ROW, row), (COLUMN, column))
    # C compilers report unused variables, so unused indices are skipped.
    before: list[Statement] = [Assign(own(s), narrow(wide(at))) for s, at in indices if s in read]
    return before, value(given)


def table_name(matrix: ConstantMatrix, number: int) -> str:
    """Return the name of the table with the entries of diagonal ``number``, counted from 0."""
    return f"{matrix.name}_diagonal_{number + 1}"


def tables(constants: Sequence[ConstantMatrix], precision: Precision) -> Iterator[Table]:
    """Yield the tables of all constant matrices whose entries are numbers and not formulas."""
    # Matrices with the same name have the same numeric entries, so each name needs only one table.
    for c in {c.name: c for c in constants}.values():
        listed: list[tuple[str, Entry, str]] = [
            (
                table_name(c, n),
                d.entry,
                f"The entries a[i][{_sum(d.offset)}] of a {c.rows} x {c.columns} matrix a.",
            )
            for n, d in enumerate(c.diagonals)
        ]
        listed.append((c.name, c.full, f"The entries of a {c.rows} x {c.columns} matrix, row by row."))
        for name, entry, about in listed:
            # If the matrix is stored by diagonals, ``c.full`` is empty and needs no table.
            if isinstance(entry, tuple) and entry:
                yield Table(real(name, len(entry)), (_rounded(entry, precision),), about)


def _sum(offset: int) -> str:
    """Return the sum i + ``offset`` as text."""
    return f"i {'-' if offset < 0 else '+'} {abs(offset)}" if offset else "i"


def _rounded(entries: Sequence[Number], precision: Precision) -> tuple[float, ...]:
    # The exact numbers are rounded only here, because two roundings could change the last digit.
    return tuple(map(precision.round, entries))


def _in_groups(columns: int, group: Callable[[Term | None, int], Iterator[Statement]]) -> Iterator[Statement]:
    """Yield the statements that compute a matrix in groups of adjacent columns.

    The matrix has ``columns`` columns. The function ``group`` yields the statements for one group. Only the
    last group may have fewer than :data:`GROUP` columns.
    """
    groups, rest = divmod(columns, GROUP)
    # A single group begins at column 0, so the column indices are constants.
    if groups == 1:
        yield from group(None, GROUP)
    elif groups > 1:
        first, number_of = count("first_column"), count("group")
        yield For(number_of, whole(groups), (Assign(first, GROUP * number_of), *group(first, GROUP)))
    if rest:
        # If the number of columns is not a multiple of GROUP, the remaining columns form a smaller group.
        yield from group(whole(GROUP * groups) if groups else None, rest)


def _shifted(first: Term | None, column: int) -> Index:
    # If the column does not depend on a loop index, the emitted column index is a constant.
    if first is None:
        return column
    if first.op == "number":
        return int(first.number) + column
    return first + column if column else first


def along(diagonal: Diagonal, place: Term) -> tuple[Term, Term]:
    """Return the row and the column of entry number ``place`` of a diagonal."""
    offset = diagonal.offset
    # The offset is the column minus the row.
    if not offset:
        return place, place
    return (place + -offset, place) if offset < 0 else (place, place + offset)


def _place(matrix: Matrix, row: Index, column: Index) -> Index:
    """Return the index of a matrix entry in the array that contains the matrix."""
    if isinstance(row, int) and isinstance(column, int):
        return matrix.place(row, column)
    # The constant parts of the index are added here, so the emitted index contains at most one constant.
    constant = matrix.start + sum(n * x for n, x in ((matrix.step, row), (1, column)) if isinstance(x, int))
    place: Term | None = None
    for n, x in ((matrix.step, row), (1, column)):
        if isinstance(x, Term):
            scaled = x if n == 1 else n * x
            place = scaled if place is None else place + scaled
    assert place is not None
    return place + constant if constant else place


def _is_whole(matrix: Matrix) -> bool:
    """Return True if the rows of a matrix are stored one after another, without gaps."""
    return matrix.step == matrix.columns


def _covers(c: ConstantMatrix) -> bool:
    """Return True if the matrix is square and its first stored diagonal is the main diagonal."""
    return c.rows == c.columns and c.diagonals[0].offset == 0


def _sign(c: Expr) -> int:
    if c.op != "const":
        return 0
    return 1 if c.payload.is_one else -1 if c.payload.is_minus_one else 0


def _plus(total: Term | None, term: Summand, weight: Term | None, entry: Term) -> Term:
    """Return ``total`` + c * ``entry``, where c is the coefficient of ``term``.

    If ``total`` is None, return c * ``entry``. If c is 1 or -1, ``weight`` is None. Otherwise ``weight`` is
    an expression for c.
    """
    sign = _sign(term.coefficient)
    scaled = entry if weight is None else weight * entry
    if total is None:
        return -scaled if sign < 0 else scaled
    return total - scaled if sign < 0 else total + scaled
