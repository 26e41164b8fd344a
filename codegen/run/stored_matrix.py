"""Emitted functions for large matrices A(t): evaluation, linear combinations, products with vectors, and
norms.

A banded n x n matrix is stored diagonal by diagonal. Each diagonal has n places, and the entry in row i is at
place i of its diagonal. If the diagonal has no entry in row i, the place contains zero.

The entries of a full matrix are formulas in the row i and the column j. Subexpressions without i and j are
evaluated once for each t, and their values are stored. Each entry is computed from these values when it is
needed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field

from codegen.ir.array_program import COLUMN, ROW, Diagonal, Entry
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.linear_array_step import Letter, TimeMatrix
from codegen.ir.number import Number
from codegen.run.array_loops import along, constant_entry, table_name
from codegen.run.language import Assign, For, Function, If, Return, Statement
from codegen.run.plan import STEP
from codegen.run.terms import Kind, Term, count, number, own, real, select, size, value, whole

VALUE, ROW_SUM, PRODUCT = "matrix_value", "row_sum", "product"
"""The names of emitted functions: the matrix A(t), the infinity norm of a matrix, and a matrix product."""

_PRODUCT = "result = a x."

_ROW, _COLUMN, _TERM, _NODE = count("i"), count("j"), count("k"), count("node")
_ENTRY, _TOTAL, _NORM = real("entry"), real("total"), real("norm")


@dataclass
class Hoisted:
    """Replaces subexpressions of formulas by names.

    A subexpression gets a name if it is independent of the row i and the column j of an entry. The emitted
    code computes the values of the names once, before the loops over i and j.
    """

    names: dict[Expr, str] = field(default_factory=dict)

    def formula(self, root: Expr) -> Expr:
        """Return the expression ``root`` with names in place of some subexpressions.

        A subexpression is replaced by a name if it is independent of the row i and the column j of a matrix
        entry.
        """
        space, known = root.space, dict[Expr, Expr]()
        indexed: dict[Expr, bool] = {}
        for node in walk([root]):
            # ``walk`` yields arguments first, so ``indexed`` already contains the arguments of ``node``.
            own_index = node.op == "sym" and node.payload in (ROW, COLUMN)
            indexed[node] = own_index or any(indexed[a] for a in node.args)
        # If a subexpression is independent of i and j, the loop does not visit its arguments. Only the whole
        # subexpression gets a name.
        for node in walk([root], lambda x: not indexed[x]):
            if not indexed[node]:
                known[node] = self._named(node)
            elif node.op == "sym":
                known[node] = node
            else:
                known[node] = _rebuilt(space, node, [known[a] for a in node.args])
        return known[root]

    def _named(self, node: Expr) -> Expr:
        if node.op == "const":
            # A constant is printed as a number wherever it is used, so it needs no name.
            return node
        # All occurrences of a subexpression get the same name.
        name = self.names.setdefault(node, f"value {len(self.names) + 1}")
        return node.space.sym(name)


def _rebuilt(space: Space, node: Expr, args: Sequence[Expr]) -> Expr:
    """Return the expression with the operation of ``node`` and the arguments ``args``."""
    if node.op == "pow":
        return space.pow(args[0], int(node.payload))
    if node.op == "call":
        return space.call(str(node.payload), *args)
    # For each operation except ``pow`` and ``call``, ``space`` has a method with the name of the operation.
    result: Expr = getattr(space, node.op)(*args)
    return result


class StoredMatrix(ABC):
    """The layout of matrices in arrays, and the emitted functions that evaluate and multiply matrices.

    A step evaluates the matrix A at the times t_i.
    """

    def __init__(self, matrix: TimeMatrix, columns: int, nodes: int) -> None:
        self.matrix, self.columns, self.nodes, self.n = matrix, columns, nodes, matrix.rows
        self.hoisted = Hoisted()
        # The emitted code evaluates each coefficient once, before the loops over i and j.
        self.coefficients = [self.hoisted.formula(c) for c, _ in matrix.terms]

    @property
    @abstractmethod
    def node_size(self) -> int:
        """The length of the array for the matrix A(t_i) at one time t_i."""

    @property
    @abstractmethod
    def letter_size(self) -> int:
        """The length of the array for a letter. A letter is a linear combination of the matrices h A(t_i)."""

    @abstractmethod
    def letter(self, target: Term, nodes: Sequence[Term], letter: Letter) -> list[Statement]:
        """Return the statements that store the linear combination ``letter`` in the array ``target``.

        For each time t_i, ``nodes`` contains the array of the matrix at this time.
        """

    @abstractmethod
    def functions(self, moment: tuple[Term, ...], parameters: tuple[Term, ...]) -> list[Function]:
        """Return the functions :data:`VALUE`, :data:`ROW_SUM` and :data:`PRODUCT`."""

    def vector(self, name: str) -> Term:
        """Return an array called ``name`` for a state with n rows and k columns."""
        return real(name, self.n * self.columns)

    def entry(self, entries: Sequence[tuple[int, Entry, str]], row: Term, column: Term, place: Term) -> Term:
        """Return an entry of a linear combination of constant matrices.

        ``entries`` contains one triple for each constant matrix M. The first part of the triple is the index
        of the coefficient of M in the linear combination. The second part is a formula for the entries of M,
        or a tuple of numbers. The third part is the name of the table that contains the numbers. If the
        second part is a tuple of numbers, the entry of M is read from the table at the index ``place``.
        """
        total: Term | None = None
        for term, given, table in entries:
            _, one = constant_entry(self.hoist(given), table, row, column, place)
            coefficient = self.coefficients[term]
            # No multiplication is emitted for the coefficient 1.
            if not (coefficient.op == "const" and coefficient.payload.is_one):
                one = value(coefficient) * one
            total = one if total is None else total + one
        assert total is not None
        return total

    def before(self, entries: Sequence[tuple[int, Entry, str]], row: Term, column: Term) -> list[Statement]:
        """Return the statements that convert the integers ``row`` and ``column`` to floating-point numbers.

        The formulas in ``entries`` need these floating-point numbers. An index that occurs in no formula is
        not converted.
        """
        indices: dict[str, Statement] = {}
        for _, given, table in entries:
            for statement in constant_entry(self.hoist(given), table, row, column, row)[0]:
                assert isinstance(statement, Assign)
                # Each index is converted to a real only once, even if several formulas contain it.
                indices.setdefault(statement.target.text, statement)
        return list(indices.values())

    def hoist(self, given: Entry) -> Entry:
        """Return ``given`` with names in place of the subexpressions that are independent of i and j.

        If ``given`` is a tuple of numbers, it is returned unchanged.
        """
        return given if isinstance(given, tuple) else self.hoisted.formula(given)


class BandedMatrix(StoredMatrix):
    """A banded matrix. The array for the time t_i contains the diagonals of h A(t_i)."""

    @property
    def node_size(self) -> int:
        """The length of the array for the matrix h A(t_i) at one time t_i."""
        return self.n * len(self.matrix.offsets)

    # The nonzero entries of all matrices h A(t_i) are on the same diagonals. Therefore a linear combination
    # of these matrices needs an array of the same length as one matrix h A(t_i).
    letter_size = node_size

    def letter(self, target: Term, nodes: Sequence[Term], letter: Letter) -> list[Statement]:
        """Return the loop that stores a linear combination of the matrices h A(t_i) in the array ``target``.

        ``nodes`` contains the array of each matrix h A(t_i), and ``letter`` contains the coefficients.
        """
        return [For(_ROW, whole(self.letter_size), (Assign(target[_ROW], _combined(nodes, letter)),))]

    def functions(self, moment: tuple[Term, ...], parameters: tuple[Term, ...]) -> list[Function]:
        """Return the functions :data:`VALUE`, :data:`ROW_SUM` and :data:`PRODUCT`."""
        a, x, y = real("a", self.letter_size), self.vector("x"), self.vector("result")
        result = real("result", self.node_size)
        loops = [self._diagonal(number, result) for number in range(len(self.matrix.offsets))]
        # Some subexpressions of matrix entries depend neither on the row nor on the column. The values of
        # these subexpressions are computed once, before the loops.
        named = [Assign(own(name), value(node)) for node, name in self.hoisted.names.items()]
        about = (
            "The diagonals of h A(t), one after the other; entry i of a diagonal is in row i of the matrix."
        )
        evaluated = Function(VALUE, about, (*moment, *parameters, result), (*named, *loops))
        return [evaluated, self._row_sum(a), self._product(a, x, y)]

    def _diagonal(self, number: int, result: Term) -> For:
        offset = self.matrix.offsets[number]
        i, j = along(Diagonal(offset, ()), _ROW)
        entries: list[tuple[int, Entry, str]] = []
        for term, (_, matrix) in enumerate(self.matrix.terms):
            for place, d in enumerate(matrix.diagonals):
                if d.offset == offset:
                    entries.append((term, d.entry, table_name(matrix, place)))
        # ``result`` contains one diagonal after the other. Each diagonal has n places, one for each row i.
        target = result[_at(number * self.n, i)]
        body = (
            *self.before(entries, i, j),
            Assign(target, STEP * self.entry(entries, i, j, _ROW)),
        )
        return For(_ROW, whole(self.n - abs(offset)), body)

    def _row_sum(self, a: Term) -> Function:
        # If a diagonal has no entry in row i, the array contains a zero instead. Therefore all diagonals can
        # be added without a test.
        places = [_at(number * self.n, _ROW) for number in range(len(self.matrix.offsets))]
        total = size(a[places[0]])
        for place in places[1:]:
            total = total + size(a[place])
        return _largest_sum(a, self.n, [Assign(_TOTAL, total)])

    def _product(self, a: Term, x: Term, y: Term) -> Function:
        # If the main diagonal is stored, its loop comes first and assigns a value to each entry of ``y``.
        # Otherwise, all entries of ``y`` are set to zero first.
        k, covered = self.columns, self.matrix.offsets[0] == 0
        zero = For(_ROW, whole(self.n * k), (Assign(y[_ROW], number(0.0)),))
        body: list[Statement] = [] if covered else [zero]
        for place, offset in enumerate(self.matrix.offsets):
            i, j = along(Diagonal(offset, ()), _ROW)
            body.append(
                For(
                    _ROW,
                    whole(self.n - abs(offset)),
                    tuple(_row(a[_at(place * self.n, i)], x, y, i, j, k, first=covered and place == 0)),
                )
            )
        return Function(PRODUCT, _PRODUCT, (a, x, y), tuple(body))


class FullMatrix(StoredMatrix):
    """A full matrix A(t). The entries of A(t) are not stored.

    The formulas of the entries have subexpressions that depend on neither the row i nor the column j. The
    array for a time t contains the values of these subexpressions. Each entry is computed from i, j and these
    values when the entry is needed.
    """

    def __init__(self, matrix: TimeMatrix, columns: int, nodes: int) -> None:
        super().__init__(matrix, columns, nodes)
        # The calls of ``hoist`` below determine ``node_size``.
        self.entries: list[tuple[int, Entry, str]] = []
        self.banded: list[tuple[int, int, Entry, str]] = []
        for term, (_, own_matrix) in enumerate(matrix.terms):
            for place, d in enumerate(own_matrix.diagonals):
                self.banded.append((d.offset, term, d.entry, table_name(own_matrix, place)))
            # If a matrix has no list of diagonals, one formula or one table gives all entries.
            if not own_matrix.diagonals:
                self.entries.append((term, own_matrix.full, own_matrix.name))
        for given in (*(e for _, e, _ in self.entries), *(e for _, _, e, _ in self.banded)):
            self.hoist(given)

    @property
    def node_size(self) -> int:
        """The length of the array for the matrix A(t_i) at one time t_i."""
        return max(1, len(self.hoisted.names))

    @property
    def letter_size(self) -> int:
        """The length of the array for a letter. A letter is a linear combination of the matrices h A(t_i)."""
        return self.nodes * (1 + self.node_size)

    def letter(self, target: Term, nodes: Sequence[Term], letter: Letter) -> list[Statement]:
        """Return the statements that fill the array ``target``.

        The parameter ``letter`` contains the coefficients c_i of a linear combination of the matrices
        h A(t_i). The first entries of ``target`` are the numbers h c_i, one for each time t_i. Copies of the
        arrays in ``nodes`` follow. The entries of the linear combination are computed from ``target`` when
        they are needed.
        """
        weights = dict(letter)
        # If the linear combination does not contain the matrix A(t_i), the coefficient c_i is zero.
        body: list[Statement] = [
            Assign(target[k], STEP * _constant(weights[k]) if k in weights else number(0.0))
            for k in range(self.nodes)
        ]
        for k, node in enumerate(nodes):
            # ``first`` is the place in ``target`` at which the copy of the array ``node`` begins.
            first = self.nodes + k * self.node_size
            copied = Assign(target[_at(first, _ROW)], node[_ROW])
            body.append(For(_ROW, whole(self.node_size), (copied,)))
        return body

    def functions(self, moment: tuple[Term, ...], parameters: tuple[Term, ...]) -> list[Function]:
        """Return the functions :data:`VALUE`, :data:`ROW_SUM` and :data:`PRODUCT`."""
        a, x, y = real("a", self.letter_size), self.vector("x"), self.vector("result")
        result = real("result", self.node_size)
        named = [Assign(result[k], value(node)) for k, node in enumerate(self.hoisted.names)]
        # C has no arrays of length zero, so ``result`` has at least one entry.
        named = named or [Assign(result[0], number(0.0))]
        about = (
            "The entries of A(t) are formulas in the row i and the column j. Compute the subexpressions of "
            "these formulas that contain neither i nor j."
        )
        # The emitted function does not need the step size h.
        time = tuple(t for t in moment if t.text != STEP.text)
        evaluated = Function(VALUE, about, (*time, *parameters, result), tuple(named))
        return [evaluated, self._row_sum(a), self._product(a, x, y)]

    def _row_sum(self, a: Term) -> Function:
        added = (*self._entry(a), Assign(_TOTAL, _TOTAL + size(_ENTRY)))
        return _largest_sum(a, self.n, [Assign(_TOTAL, number(0.0)), For(_COLUMN, whole(self.n), added)])

    def _product(self, a: Term, x: Term, y: Term) -> Function:
        k = self.columns
        zero = For(_ROW, whole(self.n * k), (Assign(y[_ROW], number(0.0)),))
        added = (*self._entry(a), *_row(_ENTRY, x, y, _ROW, _COLUMN, k, first=False))
        body = (zero, For(_ROW, whole(self.n), (For(_COLUMN, whole(self.n), added),)))
        return Function(PRODUCT, _PRODUCT, (a, x, y), body)

    def _entry(self, a: Term) -> list[Statement]:
        """Return the statements that compute one entry of a linear combination of the matrices h A(t_i)."""
        # If there is a single time t_i, no loop over the times is needed.
        node = 0 if self.nodes == 1 else _NODE
        values: list[Statement] = []
        for place, name in enumerate(self.hoisted.names.values()):
            at = whole(self.nodes + place) if self.nodes == 1 else self._place(place)
            values.append(Assign(own(name), a[at]))
        row, column = _ROW, _COLUMN
        one = self.entry(self.entries, row, column, self.n * row + column)
        # The coefficient ``a[node]`` of A(t_i) contains the factor h.
        added = (*values, Assign(_ENTRY, _ENTRY + a[node] * one))
        added = (*added, *(self._on_diagonal(a[node], *given) for given in self.banded))
        total = added if self.nodes == 1 else (For(_NODE, whole(self.nodes), added),)
        return [*self.before(self.entries, row, column), Assign(_ENTRY, number(0.0)), *total]

    def _on_diagonal(self, weight: Term, offset: int, term: int, given: Entry, table: str) -> If:
        """Return the statement that adds a multiple of an entry of a constant matrix M to ``_ENTRY``.

        Let M_ij be the entry of M in row i and column j, and let c = ``self.coefficients[term]``. If
        j = i + ``offset``, the statement adds the product of ``weight``, c and M_ij. For all other i and j,
        the statement does nothing. ``given`` contains the entries of M with j = i + ``offset``.
        """
        # The indices i and j are unsigned, so a negative difference j - i would wrap around. Therefore the
        # emitted code tests j == i + offset if offset >= 0, and i == j + |offset| if offset < 0.
        place = _ROW if offset >= 0 else _COLUMN
        reached = _COLUMN.equals(_at(offset, _ROW)) if offset >= 0 else _ROW.equals(_at(-offset, _COLUMN))
        entries = [(term, given, table)]
        one = self.entry(entries, _ROW, _COLUMN, place)
        body = (*self.before(entries, _ROW, _COLUMN), Assign(_ENTRY, _ENTRY + weight * one))
        return If(reached, body)

    def _place(self, place: int) -> Term:
        # The array begins with one coefficient for each time. The values of the named subexpressions
        # (:class:`Hoisted`) follow: ``node_size`` values for the first time, then ``node_size`` values for
        # the second time, and so on.
        first = self.node_size * _NODE
        return first + (self.nodes + place)


def stored_matrix(matrix: TimeMatrix, columns: int, nodes: int) -> StoredMatrix:
    """Return the layout and the functions for a banded or full matrix.

    ``columns`` is the number of columns of the state. ``nodes`` is the number of times t_i at which a step
    evaluates the matrix.
    """
    kind = BandedMatrix if matrix.is_banded else FullMatrix
    return kind(matrix, columns, nodes)


def _at(first: int, place: Term) -> Term:
    return place + first if first else place


def _constant(c: Number) -> Term:
    return value(Space().const(c))


def _combined(nodes: Sequence[Term], letter: Letter) -> Term:
    total: Term | None = None
    for node, c in letter:
        one = nodes[node][_ROW] if c.is_one else _constant(c) * nodes[node][_ROW]
        total = one if total is None else total + one
    assert total is not None
    return total


def _row(entry: Term, x: Term, y: Term, i: Term, j: Term, k: int, *, first: bool) -> list[Statement]:
    """Return the statements that multiply row j of x by ``entry`` and add the product to row i of y.

    If ``first`` is True, the product overwrites row i of y. The arrays x and y have ``k`` columns.
    """
    if k == 1:
        one = entry * x[j]
        return [Assign(y[i], one if first else y[i] + one)]
    # If x has several columns, the entry is used several times, so it is first assigned to a variable.
    target, one = y[k * i + _TERM], _ENTRY * x[k * j + _TERM]
    before: list[Statement] = [] if entry is _ENTRY else [Assign(_ENTRY, entry)]
    return [*before, For(_TERM, whole(k), (Assign(target, one if first else target + one),))]


def _largest_sum(a: Term, n: int, row: Sequence[Statement]) -> Function:
    larger = Assign(_NORM, select(_TOTAL > _NORM, _TOTAL, _NORM))
    body = (Assign(_NORM, number(0.0)), For(_ROW, whole(n), (*row, larger)), Return(_NORM))
    return Function(ROW_SUM, "The largest sum of absolute values in a row.", (a,), body, Kind.REAL)
