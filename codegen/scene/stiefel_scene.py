"""Stiefel scenes: equations X' = V(X) for n x k matrices X with orthonormal columns. n may be large."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import Action
from codegen.groups.actions.stiefel import Stiefel
from codegen.groups.base import LieGroup
from codegen.groups.large_group import LargeRotations
from codegen.groups.so import SO
from codegen.ir.domain import ExprDomain, FloatDomain
from codegen.ir.expr import Expr
from codegen.ir.values import Kind
from codegen.scene.arguments import read_span
from codegen.scene.consistency import check_action
from codegen.scene.formulas import Reader
from codegen.scene.matrix_field import MatrixField
from codegen.scene.matrix_formula import MatrixFormula, Unknown
from codegen.scene.matrix_reader import array_program
from codegen.scene.orbit import orbit_of, variants
from codegen.scene.problem import TIME, Problem, StateField

if TYPE_CHECKING:
    import sympy

MOST_ROWS = 8
"""The largest number of rows of a state for which :func:`StiefelScene` writes the generator as formulas in
the coordinates. For n rows, the length of these formulas grows as n^3.
"""

TOLERANCE = 1e-10
"""The largest permitted absolute value of an entry of y0^T y0 - I.

The limit for entries of X^T V + V^T X is TOLERANCE * n * (1 + max |V_ij|). Here X is a matrix with n rows,
and V is the velocity at X.
"""


def StiefelScene(
    *,
    x: Unknown,
    velocity: MatrixFormula,
    span: tuple[sympy.Expr, sympy.Expr],
    y0: Sequence[sympy.Expr] | None = None,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene X' = V(X) for n x k matrices X with orthonormal columns.

    - ``x``: the unknown (:func:`codegen.scene.matrix_formula.unknown`).
    - ``velocity``: the formula V. V must be tangent: X^T V + V^T X = 0 for all X with orthonormal columns.
    - ``y0``: the initial matrix row by row. By default its columns are the first k unit vectors.
    - ``span``: the ends of the time interval, two rational numbers.

    The equation is X' = A X with the skew-symmetric generator A = W X^T - X W^T, where W = V - X (X^T V)/2.
    The families rkmk, cf and cg need O(n k^2) operations per step, in addition to the evaluations of V.

    :class:`SceneError` is raised for a wrong size, an initial matrix without orthonormal columns, and a
    velocity that is not tangent.
    """
    if not isinstance(x, Unknown):
        raise SceneError(f"x = {x!r}", where=name, expected="unknown(n, k)")
    if x.columns > x.rows or x.rows < 2:
        raise SceneError(
            f"{x.columns} orthonormal columns of {x.rows} rows",
            where=name,
            expected="at least two rows, and at most as many columns as rows",
        )
    reader = Reader(name, [])
    field = MatrixField(array_program(reader, x, velocity))
    if reader.signals:
        raise SceneError("a signal in the velocity", where=name, expected="formulas in t and parameters")
    start = _start(reader, x, y0)
    symbols = tuple(f"x{i}_{j}" for i in range(x.rows) for j in range(x.columns))
    parameters = reader.parameters()
    roots: tuple[Expr, ...] = ()
    group: LieGroup = LargeRotations(x.rows)
    action: Action = Stiefel(x.columns)
    if x.rows <= MOST_ROWS:
        group = SO(x.rows)
        roots = _roots(reader, field, group, symbols, tuple(parameters))
    state = (StateField("y", Kind.POINT, symbols, start),)
    span_read = read_span(name, span)
    problem = Problem(
        *(name, title or name, group, action, state, roots, None, {}, span_read), parameters, matrices=field
    )
    _check(problem, field)
    if roots:
        check_action(orbit_of(problem))
    return problem


def _start(reader: Reader, x: Unknown, y0: Sequence[sympy.Expr] | None) -> tuple[Expr, ...]:
    if y0 is not None:
        return reader.column(y0, x.rows * x.columns, "y0", constant=True)
    one, zero = reader.space.one, reader.space.zero
    return tuple(one if i == j else zero for i in range(x.rows) for j in range(x.columns))


def _roots(
    reader: Reader, field: MatrixField, group: SO, symbols: tuple[str, ...], parameters: tuple[str, ...]
) -> tuple[Expr, ...]:
    """Return formulas for the components of the generator A (:func:`StiefelScene`)."""
    domain = ExprDomain(reader.space)
    point = [reader.space.sym(s) for s in symbols]
    scalars = {s: reader.space.sym(s) for s in (TIME, *parameters)}
    return group.vee(domain, field.generator(domain, point, scalars))


def _check(problem: Problem, field: MatrixField) -> None:
    """Test whether the initial matrix has orthonormal columns, and whether the velocity is tangent.

    :class:`SceneError` is raised if a test fails.
    """
    domain = FloatDomain(0.0)
    start = [float(value) for value in problem.initial(domain)]
    error = _largest(_gram(start, start, field.columns), unit=True)
    if not error <= TOLERANCE:
        raise SceneError(
            f"the columns of y0 are not orthonormal: the largest entry of y0^T y0 - I is {error:.1e}",
            where=problem.name,
            expected="orthonormal columns",
        )
    check_tangent(problem, field)


def check_tangent(problem: Problem, field: MatrixField) -> None:
    """Raise SceneError if the velocity is not tangent at the initial matrix or at :func:`_elsewhere`.

    The velocity is also tested for other values of run-time parameters.
    """
    domain = FloatDomain(0.0)
    start = [float(value) for value in problem.initial(domain)]
    points = start, _elsewhere(start, field.columns)
    for one, point in product((problem, *variants(problem)), points):
        symbols = one.scalars(domain, domain.rational(*problem.span[0].as_integer_ratio()))
        v = [float(value) for value in field.velocity(domain, point, symbols)]
        gram = _gram(point, v, field.columns)
        skew = max(abs(a + b) for a, b in zip(gram, _turned(gram, field.columns), strict=True))
        size = 1 + max(map(abs, v))
        if not skew <= TOLERANCE * size * field.rows:
            raise SceneError(
                f"the velocity is not tangent: the largest entry of X^T V + V^T X is {skew:.1e}",
                where=problem.name,
                expected="V with X^T V + V^T X = 0",
                hint="subtract X (X^T V + V^T X)/2 from V",
            )


def _gram(a: Sequence[float], b: Sequence[float], k: int) -> list[float]:
    return [
        math.fsum(x * y for x, y in zip(a[i::k], b[j::k], strict=True)) for i in range(k) for j in range(k)
    ]


def _turned(gram: Sequence[float], k: int) -> list[float]:
    return [gram[j * k + i] for i in range(k) for j in range(k)]


def _largest(gram: Sequence[float], unit: bool) -> float:
    k = math.isqrt(len(gram))
    return max(abs(value - (unit and place % (k + 1) == 0)) for place, value in enumerate(gram))


def _elsewhere(start: Sequence[float], k: int) -> list[float]:
    """Return a matrix with orthonormal columns, different from the matrix ``start``."""
    columns: list[list[float]] = []
    for j in range(k):
        column = [x + 0.3 * math.sin(7.0 * i + 3.0 * j + 1.0) for i, x in enumerate(start[j::k])]
        # The second pass over the columns removes the rounding errors of the first pass.
        for other in [*columns, *columns]:
            c = math.fsum(map(float.__mul__, column, other))
            column = [x - c * y for x, y in zip(column, other, strict=True)]
        norm = math.sqrt(math.fsum(x * x for x in column))
        columns.append([x / norm for x in column])
    return [columns[j][i] for i in range(len(columns[0])) for j in range(k)]
