"""Large linear scenes: y' = A(t) y with a large banded or full matrix A(t)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import Action, Columns, Linear
from codegen.groups.base import LieGroup
from codegen.groups.gl import GL
from codegen.groups.large_group import LargeLinearGroup
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.linear_array_step import TimeMatrix
from codegen.ir.values import Kind
from codegen.scene.arguments import read_span
from codegen.scene.consistency import check_action
from codegen.scene.formulas import Reader
from codegen.scene.linear_field import LinearField, linear_field
from codegen.scene.matrix_formula import MatrixFormula
from codegen.scene.matrix_reader import matrix_terms
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import TIME, Problem, StateField

if TYPE_CHECKING:
    import sympy

    Start = Sequence[sympy.Expr] | Callable[..., sympy.Expr]
    """An initial state: all entries row by row, or a function of the row index. For several columns, the
    column index is the second argument of the function."""

MOST_ROWS = 8
"""If A(t) has at most this number of rows, the problem contains a formula for each entry of A(t).

Commands such as ``stability``, ``localerror`` and ``bench`` need these formulas.
"""


def LargeLinearScene(
    *,
    A: MatrixFormula,
    span: tuple[sympy.Expr, sympy.Expr],
    y0: Start | None = None,
    columns: int = 1,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene y' = A(t) y for vectors y, or for n x k matrices y with k = ``columns``.

    - ``A``: the result of :func:`codegen.scene.banded` or :func:`codegen.scene.full`, or a sum of multiples
      of such matrices. Entries are formulas in the indices, in ``t`` and in parameters.
    - ``y0``: the entries of the initial state row by row, or a function of the indices. Indices are counted
      from 0. By default, the columns of the initial state are the first k unit vectors.
    - ``span``: the rational time interval.

    The scene permits methods of the families magnus, cf_magnus, fer, rkmk, cf and cg.

    :class:`SceneError` is raised if ``A`` is not square, if ``A`` contains :func:`codegen.scene.unknown`, or
    if ``y0`` has a wrong size.
    """
    if not isinstance(A, MatrixFormula):
        raise SceneError(
            f"A is of type {type(A).__name__}",
            where=name,
            expected="a matrix banded(n, {...}) or full(n, n, entries)",
            hint="use LinearScene for a sympy matrix",
        )
    if A.rows != A.columns or A.rows < 2:
        raise SceneError(
            f"A is a {A.rows} x {A.columns} matrix",
            where=name,
            expected="a square matrix of two rows or more",
        )
    n = A.rows
    if not isinstance(columns, int) or isinstance(columns, bool) or not 1 <= columns <= n:
        raise SceneError(f"columns = {columns!r}", where=name, expected=f"an integer from 1 to {n}")
    reader = Reader(name, [])
    field = linear_field(TimeMatrix(matrix_terms(reader, A)), columns)
    if reader.signals:
        raise SceneError("a signal in A", where=name, expected="formulas in t and parameters")
    start = _start(reader, n, columns, y0)
    parameters = reader.parameters()
    group: LieGroup = LargeLinearGroup(n)
    roots: tuple[Expr, ...] = ()
    if n <= MOST_ROWS:
        group, roots = GL(n), _roots(reader, field, tuple(parameters))
    action: Action = Linear() if columns == 1 else Columns(columns)
    state = (StateField("y", Kind.POINT, _symbols(n, columns), start),)
    problem = Problem(
        *(name, title or name, group, action, state, roots, None, {}, read_span(name, span)),
        parameters,
        matrices=field,
    )
    if roots:
        check_action(orbit_of(problem))
    return problem


def _symbols(n: int, columns: int) -> tuple[str, ...]:
    if columns == 1:
        return tuple(f"y{i}" for i in range(n))
    return tuple(f"y{i}_{j}" for i in range(n) for j in range(columns))


def _start(reader: Reader, n: int, columns: int, y0: Start | None) -> tuple[Expr, ...]:
    places = [(i, j) for i in range(n) for j in range(columns)]
    if y0 is None:
        one, zero = reader.space.one, reader.space.zero
        return tuple(one if i == j else zero for i, j in places)
    given = [y0(*place[: 1 + (columns > 1)]) for place in places] if callable(y0) else y0
    return reader.column(given, n * columns, "y0", constant=True)


def _roots(reader: Reader, field: LinearField, parameters: tuple[str, ...]) -> tuple[Expr, ...]:
    """Return the coordinates of A(t) in gl(n): the entries of A(t) row by row."""
    scalars = {s: reader.space.sym(s) for s in (TIME, *parameters)}
    return field.generator(ExprDomain(reader.space), (), scalars)
