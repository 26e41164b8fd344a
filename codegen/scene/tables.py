"""Tables in formulas of scenes: functions of one variable that interpolate given numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import NoReturn

import sympy

from codegen.errors import SceneError
from codegen.ir.decimals import exact
from codegen.ir.table import PiecewisePolynomial

LINEAR, CUBIC = "linear", "cubic"
SMOOTHNESS = (LINEAR, CUBIC)
HOLD, EXTRAPOLATE = "hold", "extrapolate"
OUTSIDE = (HOLD, EXTRAPOLATE)

LARGEST = 512
"""The largest number of points of a table."""


class TableData(sympy.Atom):  # type: ignore[misc]
    """The data of a table as an argument of a sympy expression."""

    __slots__ = ("function",)

    def __new__(cls, polynomial: PiecewisePolynomial) -> TableData:
        """Return the data of a table with the given piecewise polynomial."""
        data: TableData = sympy.Atom.__new__(cls)
        data.function = polynomial
        return data

    def __getnewargs__(self) -> tuple[object, ...]:
        return (self.function,)

    def _hashable_content(self) -> tuple[object, ...]:
        return (str(self.function),)

    def _sympystr(self, printer: object) -> str:
        return str(self.function)


class TableValue(sympy.Expr):  # type: ignore[misc]
    """The value of a table at an expression; sympy can differentiate this value."""

    is_commutative = True
    is_real = True

    @property
    def polynomial(self) -> PiecewisePolynomial:
        """The piecewise polynomial that interpolates the table."""
        polynomial: PiecewisePolynomial = self.args[0].function
        return polynomial

    def _eval_derivative(self, symbol: sympy.Symbol) -> sympy.Expr:
        inner = self.args[1].diff(symbol)
        return TableValue(TableData(self.polynomial.derivative()), self.args[1]) * inner


def table(
    xs: Iterable[object],
    ys: Iterable[object],
    x: sympy.Expr,
    smoothness: str = CUBIC,
    outside: str = HOLD,
) -> sympy.Expr:
    """Return a formula in ``x`` that has the value ys[k] at x = xs[k].

    A float denotes the decimal number that Python prints: 0.1 is 1/10.

    - ``smoothness``: ``cubic`` for the natural cubic spline, whose second derivative is zero at both ends, or
      ``linear``.
    - ``outside``: the values beyond the table. ``hold`` is the value at the nearest point. ``extrapolate`` is
      the polynomial of the nearest interval.

    :class:`SceneError` is raised for lists of different lengths, for fewer than 2 or more than LARGEST
    points, for numbers in ``xs`` that do not increase, and for an unknown ``smoothness`` or ``outside``.

    At the inner points of ``xs``, ``linear`` has a discontinuous first derivative, and ``cubic`` has a
    discontinuous third derivative. With ``hold``, the first derivative is also discontinuous at the first and
    the last point.

    >>> from codegen.ir.domain import FloatDomain
    >>> thrust = table([0, 1, 2], [0.0, 0.5, 0.2], sympy.Symbol("t"), "linear")
    >>> [FloatDomain(0.0).call(thrust.polynomial, t) for t in (0.5, 1.5, 9.0)]
    [0.25, 0.35, 0.2]
    """
    if smoothness not in SMOOTHNESS:
        _refuse(f"the smoothness {smoothness!r}", " or ".join(SMOOTHNESS))
    if outside not in OUTSIDE:
        _refuse(f"outside = {outside!r}", " or ".join(OUTSIDE))
    places, values = _numbers("xs", xs), _numbers("ys", ys)
    if len(places) != len(values):
        _refuse(
            f"{len(places)} numbers in xs and {len(values)} in ys", "one number in ys for each number in xs"
        )
    if not 2 <= len(places) <= LARGEST:
        _refuse(f"{len(places)} points", f"2 to {LARGEST} points")
    for k, (a, b) in enumerate(pairwise(places)):
        if not a < b:
            _refuse(f"xs[{k}] = {_shown(a)} and xs[{k + 1}] = {_shown(b)}", "increasing numbers in xs")
    rows = linear_rows(places, values) if smoothness == LINEAR else spline_rows(places, values)
    return TableValue(TableData(_joined(places, values, rows, outside)), sympy.sympify(x))


def linear_rows(xs: Sequence[Fraction], ys: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
    """Return the linear interpolant on each interval, as the pair (value at the left end, slope)."""
    return [(c, (d - c) / (b - a)) for (a, b), (c, d) in zip(pairwise(xs), pairwise(ys), strict=True)]


def spline_rows(xs: Sequence[Fraction], ys: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
    """Return the coefficients of the natural cubic spline, one row for each interval.

    If an interval begins at a, its row contains the coefficients of 1, x - a, (x - a)^2 and (x - a)^3.

    >>> xs, ys = ([Fraction(k) for k in numbers] for numbers in ((0, 1, 2), (0, 1, 0)))
    >>> [[str(c) for c in row] for row in spline_rows(xs, ys)]
    [['0', '3/2', '0', '-1/2'], ['1', '0', '-3/2', '1/2']]
    """
    widths = [b - a for a, b in pairwise(xs)]
    slopes = [(b - a) / w for (a, b), w in zip(pairwise(ys), widths, strict=True)]
    bends = _bends(widths, slopes)
    return [
        (y, slope - w * (2 * a + b) / 6, a / 2, (b - a) / (6 * w))
        for y, slope, w, (a, b) in zip(ys, slopes, widths, pairwise(bends), strict=False)
    ]


def _bends(widths: Sequence[Fraction], slopes: Sequence[Fraction]) -> list[Fraction]:
    """Return the second derivatives m_k of the spline at the points.

    Interval k begins at point k and ends at point k + 1. The interval has the width w_k, and the straight
    line through these two points has the slope s_k. There are n intervals, and k begins at 0. The equations
    are m_0 = 0, m_n = 0 and, for 0 < k < n,

    w_{k-1} m_{k-1} + 2 (w_{k-1} + w_k) m_k + w_k m_{k+1} = 6 (s_k - s_{k-1}).
    """
    pivots: list[tuple[Fraction, Fraction]] = []
    ratio, right = Fraction(0), Fraction(0)
    for (u, w), (s, t) in zip(pairwise(widths), pairwise(slopes), strict=True):
        pivot = 2 * (u + w) - u * ratio
        right = (6 * (t - s) - u * right) / pivot
        ratio = w / pivot
        pivots.append((ratio, right))
    bends = [Fraction(0)]
    for ratio, right in reversed(pivots):
        bends.append(right - ratio * bends[-1])
    return [Fraction(0), *reversed(bends)]


def _joined(
    xs: Sequence[Fraction], ys: Sequence[Fraction], rows: list[tuple[Fraction, ...]], outside: str
) -> PiecewisePolynomial:
    """Return the piecewise polynomial with the given rows of coefficients."""
    if outside == HOLD:
        return PiecewisePolynomial(tuple(xs), (xs[0], *xs), ((ys[0],), *rows, (ys[-1],)))
    # The knots are the inner points. For a table with two points, the first point is the only knot, and
    # the polynomials on both sides are equal.
    knots, starts = (xs[1:-1], xs[:-1]) if len(xs) > 2 else (xs[:1], (xs[0], xs[0]))
    return PiecewisePolynomial(tuple(knots), tuple(starts), tuple(rows if len(xs) > 2 else rows * 2))


def _numbers(name: str, given: Iterable[object]) -> list[Fraction]:
    """Return the numbers of the list ``name`` as exact fractions."""
    try:
        entries = list(given)
    except TypeError:
        _refuse(f"{name} = {given!r}", "a list of numbers")
    numbers = []
    for k, entry in enumerate(entries):
        value = None if isinstance(entry, str) else exact(entry)
        if value is None:
            _refuse(f"{name}[{k}] = {entry!r}", "a rational number or a float")
        numbers.append(value)
    return numbers


def _shown(x: Fraction) -> str:
    return f"{float(x):.12g}"


def _refuse(given: str, expected: str) -> NoReturn:
    raise SceneError(given, where="table", expected=expected)
