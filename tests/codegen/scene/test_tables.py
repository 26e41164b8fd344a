"""Tables: interpolation, derivatives, values outside, and what is refused."""

from __future__ import annotations

from fractions import Fraction

import numpy
import pytest
import scipy.interpolate
import sympy

from codegen.errors import SceneError
from codegen.ir.domain import FloatDomain
from codegen.scene import table

XS, YS = [0.0, 0.5, 1.1, 2.0, 3.0, 3.25], [1.0, 0.3, -0.2, 0.7, 0.6, 2.5]
PLACES = numpy.linspace(0, 3.25, 41)
x = sympy.Symbol("x", real=True)


def values(formula: sympy.Expr, places: numpy.ndarray = PLACES) -> list[float]:
    return [FloatDomain(0.0).call(formula.polynomial, float(place)) for place in places]


def test_a_cubic_table_is_the_natural_spline() -> None:
    expected = scipy.interpolate.CubicSpline(XS, YS, bc_type="natural")
    spline = table(XS, YS, x)
    assert numpy.allclose(values(spline), expected(PLACES), rtol=0, atol=1e-14)
    inside = PLACES[1:-1]
    assert numpy.allclose(values(spline.diff(x), inside), expected(inside, 1), rtol=0, atol=1e-13)
    assert numpy.allclose(values(spline.diff(x, 2), inside), expected(inside, 2), rtol=0, atol=1e-13)


def test_the_spline_has_two_continuous_derivatives_exactly() -> None:
    f = table(XS, YS, x).polynomial
    for derivative in (f, f.derivative(), f.derivative().derivative()):
        for k, knot in enumerate(f.knots[1:-1], start=1):
            below, above = (
                sum(c * (knot - f.bases[j]) ** p for p, c in enumerate(derivative.rows[j]))
                for j in (k, k + 1)
            )
            assert below == above


def test_a_linear_table_is_that_of_numpy() -> None:
    line = table(XS, YS, x, "linear")
    wide = numpy.linspace(-1, 4, 51)
    assert numpy.allclose(values(line, wide), numpy.interp(wide, XS, YS), rtol=0, atol=1e-15)


@pytest.mark.parametrize("smoothness", ["linear", "cubic"])
@pytest.mark.parametrize("count", [2, 3, 6])
def test_outside_the_value_is_held_or_extrapolated(smoothness: str, count: int) -> None:
    xs, ys = XS[:count], YS[:count]
    held, beyond = (table(xs, ys, x, smoothness, outside) for outside in ("hold", "extrapolate"))
    ends = numpy.array([xs[0] - 1, xs[-1] + 1])
    assert values(held, ends) == [ys[0], ys[-1]]
    f = beyond.polynomial
    slope = (ys[1] - ys[0]) / (xs[1] - xs[0])
    if smoothness == "linear" or count == 2:
        assert values(beyond, ends)[0] == pytest.approx(ys[0] - slope)
    else:
        expected = scipy.interpolate.CubicSpline(xs, ys, bc_type="natural")
        assert values(beyond, ends) == pytest.approx(list(expected(ends)))
    assert f.degree == (1 if smoothness == "linear" or count == 2 else 3)


def test_decimals_are_exact() -> None:
    f = table([0, 0.1], [0, 0.3], x, "linear").polynomial
    assert f.rows[1] == (Fraction(0), Fraction(3))
    assert f.knots[1] == Fraction(1, 10)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0, 1], [0], x), "2 numbers in xs and 1 in ys"),
        (([0, 0], [0, 1], x), r"xs\[0\] = 0 and xs\[1\] = 0; expected increasing"),
        (([0], [0], x), "1 points; expected 2 to 512"),
        (([0, sympy.pi], [0, 1], x), r"xs\[1\] = pi; expected a rational"),
        (([0, "1"], [0, 1], x), r"xs\[1\] = '1'"),
        ((3, [0, 1], x), "xs = 3; expected a list"),
        (([0, 1], [0, float("nan")], x), r"ys\[1\] = nan"),
        (([0, 1], [0, 1], x, "quintic"), "the smoothness 'quintic'; expected linear or cubic"),
        (([0, 1], [0, 1], x, "cubic", "status"), "outside = 'status'; expected hold or extrapolate"),
    ],
)
def test_other_tables_are_refused(arguments: tuple[object, ...], message: str) -> None:
    with pytest.raises(SceneError, match=f"^table: {message}" if "xs =" not in message else message):
        table(*arguments)


def test_formulas_with_tables_are_sorted_by_their_data() -> None:
    a, b = table([0, 1], [0, 1], x), table([0, 1], [1, 0], x)
    assert a != b
    assert (a + b).args == (b + a).args
    assert len({sympy.default_sort_key(a), sympy.default_sort_key(b)}) == 2
