"""Continuous extensions (dense output) of Runge-Kutta methods, from linear equations.

The extension approximates the solution at the time t_0 + theta h within a step from t_0 to t_0 + h. The
weights of the extension are polynomials in theta: b_i(theta) = sum_p beta_{p,i} theta^p for stage i. A tree t
has |t| nodes and the density gamma(t). The elementary weight of t is sum_i b_i Phi_i(t), where Phi_i(t)
depends only on the matrix A. The extension has order q if the following equations hold for all trees t with
at most q nodes:

- sum_i beta_{p,i} Phi_i(t) = 1/gamma(t) for p = |t|
- sum_i beta_{p,i} Phi_i(t) = 0 for all other p

For each p, the solution of least norm is used, with one exception. If the first stage is the initial value,
the solution for p = 1 is beta_{1,1} = 1 and beta_{1,i} = 0 for i > 1. Then the derivative of the extension at
theta = 0 is exact.

Finally, some of the coefficients beta_{p,i} are changed to obtain b_i(1) = b_i for each stage i. There are
two cases. In the first case, three conditions hold: q > 1, the first stage is the initial value, and the last
stage is the final value. In this case, the coefficients of two powers of theta are changed such that the
derivative of the extension at theta = 1 is exact, too. The two powers are theta^2 and theta^3 if q = 2, and
theta^(q-1) and theta^q if q > 2. In the second case, at least one of the three conditions does not hold, and
only the coefficients of theta^q are changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from operator import add, sub

from orderconds import families
from orderconds.checking import check
from orderconds.checking.refuted import refuted_claims
from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau import RungeKutta, Tableau
from orderconds.tableau.methods import Row
from orderconds.tableau.record import from_data
from orderconds.tableau.write import as_data

Rows = list[list[Element]]


def extended(tableau: Tableau, order: int | None = None) -> Tableau:
    """Return the tableau with a continuous extension (dense output) of the given order. If ``order`` is None,
    the extension has the highest order for which an extension exists.

    Raises :class:`~orderconds.errors.TableauError` if there is no extension of the given order, or if a claim
    of the tableau is wrong. The tableau must be a Runge-Kutta method with exact coefficients.

    >>> extension = extended(Tableau.load("rk4")).extension
    >>> extension.order, [str(x) for x in extension.rows[1]]
    (3, ['0', '1', '-2/3'])
    """
    method, ring, where = tableau.method, tableau.ring, tableau.path or tableau.name
    if not isinstance(method, RungeKutta):
        raise TableauError(
            f"a tableau of format {tableau.family}", where=where, expected="a Runge-Kutta method, format rk"
        )
    if any(ring.is_zero(x - x) is not True for row in (*method.A, method.b) for x in row):
        raise TableauError("rounded coefficients", where=where, expected="exact coefficients")
    (own,) = check(tableau, family="rk").orders
    wanted = range(own.order, 0, -1) if order is None else [order]
    for q in wanted:
        rows = None if q > own.order else _extension(method, ring, q)
        if rows is not None:
            break
    else:
        of_order = "" if order is None else f" of order {order}"
        raise TableauError(
            f"the stages of {tableau.name} give no continuous extension{of_order}",
            where=where,
            expected="a lower order, or a method with more stages",
        )
    texts = [_trimmed([ring.text(x) for x in row]) for row in zip(*rows, strict=True)]
    data = as_data(tableau) | {"dense": {"order": q, "b": texts}}
    result = from_data(data, where, tableau.path)
    computed = check(result).dense
    assert computed is not None
    assert computed.order >= q
    if computed.order != q:
        data["dense"]["order"] = computed.order
        result = from_data(data, where, tableau.path)
    # The result contains the claims of the tableau.
    if refuted := refuted_claims(result):
        raise TableauError(
            f"a claim is wrong: {'; '.join(refuted)}", where=where, expected="claims that the method fulfils"
        )
    return result


def _extension(method: RungeKutta, ring: Ring, q: int) -> list[Row] | None:
    """Return the coefficients of a continuous extension of order q, or None if there is none. The p-th row
    contains the coefficients of theta^p in the weights b_i(theta)."""
    s, zero = len(method.b), (ring.zero,) * len(method.b)
    units = [tuple(ring.one if i == k else ring.zero for i in range(s)) for k in range(s)]
    conditions = [c for n in range(1, q + 1) for c in families.get("rk").conditions(n)]
    family = families.get("rk")
    columns = [family.evaluate(RungeKutta(method.A, unit), ring, conditions) for unit in units]
    matrix = [list(row) for row in zip(*columns, strict=True)]
    starts = _equal(ring, method.A[0], zero)
    ends = _equal(ring, method.A[-1], method.b)
    powers: list[Row] = []
    for p in range(1, q + 1):
        if p == 1 and starts:
            powers.append(units[0])
            continue
        sides = [_value(ring, c.rhs if c.order == p else Fraction(0)) for c in conditions]
        solution = _least(matrix, sides, ring)
        if solution is None:
            return None
        powers.append(tuple(solution))
    if starts and ends and q == 2:
        powers.append(zero)
    gap = _minus(method.b, _sum(powers, zero))
    if starts and ends and q > 1:
        top = len(powers)
        slope = _sum([_times(ring.rational(p), row) for p, row in enumerate(powers, 1)], zero)
        rest = _minus(_minus(units[-1], slope), _times(ring.rational(top - 1), gap))
        powers[-1] = _plus(powers[-1], rest)
        powers[-2] = _plus(powers[-2], _minus(gap, rest))
    else:
        powers[-1] = _plus(powers[-1], gap)
    return powers


def _least(matrix: Rows, sides: Sequence[Element], ring: Ring) -> list[Element] | None:
    """Return the least-norm solution x of ``matrix`` x = ``sides``, or None if there is no solution."""
    rows = _reduced([[*row, side] for row, side in zip(matrix, sides, strict=True)], ring)
    width = len(matrix[0])
    if any(all(ring.is_zero(x) for x in row[:width]) for row in rows):
        return None
    products = [[_dot(one[:width], two[:width], ring) for two in rows] for one in rows]
    system = [[*line, row[width]] for line, row in zip(products, rows, strict=True)]
    factors = [row[-1] for row in _reduced(system, ring)]
    columns = zip(*(row[:width] for row in rows), strict=True)
    return [_dot(column, factors, ring) for column in columns]


def _reduced(rows: Rows, ring: Ring) -> Rows:
    """Return the reduced row echelon form of the matrix ``rows``, without zero rows."""
    rows, kept = [list(row) for row in rows], 0
    for column in range(len(rows[0])):
        pivot = next((k for k in range(kept, len(rows)) if not ring.is_zero(rows[k][column])), None)
        if pivot is None:
            continue
        rows[kept], rows[pivot] = rows[pivot], rows[kept]
        scale = rows[kept][column]
        rows[kept] = [x / scale for x in rows[kept]]
        for k, row in enumerate(rows):
            factor = row[column]
            if k != kept and not ring.is_zero(factor):
                rows[k] = [x - factor * y for x, y in zip(row, rows[kept], strict=True)]
        kept += 1
        if kept == len(rows):
            break
    return rows[:kept]


def _dot(x: Sequence[Element], y: Sequence[Element], ring: Ring) -> Element:
    return sum((a * b for a, b in zip(x, y, strict=True)), ring.zero)


def _value(ring: Ring, x: Fraction) -> Element:
    return ring.rational(x.numerator, x.denominator)


def _plus(x: Row, y: Row) -> Row:
    return tuple(map(add, x, y))


def _minus(x: Row, y: Row) -> Row:
    return tuple(map(sub, x, y))


def _times(factor: Element, x: Row) -> Row:
    return tuple(factor * a for a in x)


def _sum(rows: Sequence[Row], zero: Row) -> Row:
    total = zero
    for row in rows:
        total = _plus(total, row)
    return total


def _equal(ring: Ring, x: Row, y: Row) -> bool:
    return all(ring.is_zero(a - b) for a, b in zip(x, y, strict=True))


def _trimmed(texts: list[str]) -> list[str]:
    """Return the texts of a row without the zeros at its end."""
    while texts and texts[-1] == "0":
        texts.pop()
    return texts
