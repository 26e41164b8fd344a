"""Formulas whose operands are matrices.

The operators are ``@`` (product), ``+``, ``-``, ``*`` (by a scalar) and ``.T`` (transpose). Scalars are
numbers and sympy formulas in ``t`` and in parameters. Products are computed in the order that needs the
fewest multiplications.

>>> X = unknown(800, 4)
>>> A = banded(800, {-1: -1, 0: 2, 1: -1})
>>> velocity = A @ X - X @ X.T @ A @ X
>>> velocity.rows, velocity.columns
(800, 4)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Union

from codegen.errors import SceneError

if TYPE_CHECKING:
    import sympy

Coefficient = Union["sympy.Expr", int, float]
"""A scalar factor in a formula."""

EntryFormula = Union[Callable[..., "Coefficient"], Sequence["Coefficient"], "Coefficient"]
"""The entries of a matrix or a diagonal: a function of the indices, a list, or one scalar for all entries.
"""


class MatrixFormula:
    """A formula whose value is a matrix."""

    rows: int
    columns: int
    __array_ufunc__: ClassVar[None] = None
    """The value None makes NumPy use the operators of MatrixFormula, for example in ``array * formula``."""

    @property
    def T(self) -> MatrixFormula:
        """The transpose."""
        return Transposed(self)

    def __matmul__(self, other: object) -> MatrixFormula:
        return Times(self, _matrix(other))

    def __rmatmul__(self, other: object) -> MatrixFormula:
        return Times(_matrix(other), self)

    def __add__(self, other: object) -> MatrixFormula:
        return Sum(self, _matrix(other))

    def __sub__(self, other: object) -> MatrixFormula:
        return Sum(self, -_matrix(other))

    def __neg__(self) -> MatrixFormula:
        return Scaled(-1, self)

    def __mul__(self, factor: Coefficient) -> MatrixFormula:
        return Scaled(_scalar(factor), self)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Coefficient) -> MatrixFormula:
        import sympy

        return Scaled(sympy.Integer(1) / sympy.sympify(_scalar(divisor)), self)


@dataclass(frozen=True, eq=False)
class Unknown(MatrixFormula):
    """The unknown matrix X: the state of the scene."""

    rows: int
    columns: int


@dataclass(frozen=True, eq=False)
class Constant(MatrixFormula):
    """A constant matrix.

    A banded matrix has ``diagonals``, a mapping from the offset of each diagonal to the entries of the
    diagonal. If ``diagonals`` is None, ``entries`` contains all entries of the matrix.
    """

    rows: int
    columns: int
    diagonals: Mapping[int, EntryFormula] | None
    entries: EntryFormula | None


@dataclass(frozen=True, eq=False)
class Transposed(MatrixFormula):
    """The transpose of a matrix."""

    matrix: MatrixFormula

    def __post_init__(self) -> None:
        _sized(self, self.matrix.columns, self.matrix.rows)


@dataclass(frozen=True, eq=False)
class Scaled(MatrixFormula):
    """A scalar times a matrix."""

    factor: Coefficient
    matrix: MatrixFormula

    def __post_init__(self) -> None:
        _sized(self, self.matrix.rows, self.matrix.columns)


@dataclass(frozen=True, eq=False)
class Sum(MatrixFormula):
    """The sum of two matrices."""

    left: MatrixFormula
    right: MatrixFormula

    def __post_init__(self) -> None:
        _match(self, (self.left.rows, self.left.columns), (self.right.rows, self.right.columns), "sum")
        _sized(self, self.left.rows, self.left.columns)


@dataclass(frozen=True, eq=False)
class Times(MatrixFormula):
    """The product of two matrices."""

    left: MatrixFormula
    right: MatrixFormula

    def __post_init__(self) -> None:
        _match(self, (self.left.columns,), (self.right.rows,), "product")
        _sized(self, self.left.rows, self.right.columns)


def unknown(rows: int, columns: int) -> Unknown:
    """Return the symbol for the unknown matrix X: the state of a :class:`codegen.scene.StiefelScene`."""
    _size(rows, "rows")
    _size(columns, "columns")
    return Unknown(rows, columns)


def banded(rows: int, diagonals: Mapping[int, EntryFormula], columns: int | None = None) -> Constant:
    """Return a matrix that is zero outside the given diagonals. By default, the matrix is square.

    ``diagonals`` maps the offset j - i of a diagonal to the entries a_ij of this diagonal. Give one scalar
    for the whole diagonal, a function of the row i, or a list of all entries. Rows and columns are counted
    from 0.

    :class:`SceneError` is raised for an offset outside the matrix.
    """
    _size(rows, "rows")
    width = rows if columns is None else columns
    _size(width, "columns")
    if not diagonals:
        raise SceneError("a matrix without diagonals", where="banded", expected="at least one offset")
    for offset in diagonals:
        if not isinstance(offset, int) or not -rows < offset < width:
            raise SceneError(
                f"the diagonal {offset!r}",
                where="banded",
                expected=f"an integer from {1 - rows} to {width - 1}",
            )
    return Constant(rows, width, dict(diagonals), None)


def full(rows: int, columns: int, entries: EntryFormula) -> Constant:
    """Return a full matrix. ``entries`` is a function of the row and the column, or a list of rows.

    Rows and columns are counted from 0.
    """
    _size(rows, "rows")
    _size(columns, "columns")
    return Constant(rows, columns, None, entries)


def _sized(formula: MatrixFormula, rows: int, columns: int) -> None:
    # A frozen dataclass does not permit the assignment ``formula.rows = rows``.
    object.__setattr__(formula, "rows", rows)
    object.__setattr__(formula, "columns", columns)


def _size(value: object, what: str) -> None:
    if not isinstance(value, int) or isinstance(value, bool) or value < 1:
        raise SceneError(f"{what} = {value!r}", where="matrix", expected="a positive integer")


def _matrix(value: object) -> MatrixFormula:
    if isinstance(value, MatrixFormula):
        return value
    raise SceneError(
        f"{str(value)[:40]} of type {type(value).__name__} in a matrix formula",
        expected="a matrix",
        hint="write constant matrices as banded(n, {...}) or full(n, m, rows)",
    )


def _scalar(value: Coefficient) -> Coefficient:
    if isinstance(value, MatrixFormula):
        raise SceneError(
            "a product of two matrices with *", expected="a scalar factor", hint="write the product as A @ B"
        )
    return value


def _match(formula: MatrixFormula, left: tuple[int, ...], right: tuple[int, ...], what: str) -> None:
    if left == right:
        return
    sizes = " and ".join(" x ".join(map(str, size)) for size in (left, right))
    kind = "matrices" if len(left) > 1 else "two matrices with the inner dimensions"
    raise SceneError(f"the {what} of {kind} {sizes}", expected="equal sizes")
