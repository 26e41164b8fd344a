from __future__ import annotations

import math
import random
from fractions import Fraction

import pytest
import sympy

from codegen.ir.ball_domain import BallDomain
from codegen.ir.differentiate import NotDifferentiable, gradient
from codegen.ir.domain import FloatDomain, PreciseDomain, SeriesDomain
from codegen.ir.expr import Space, evaluate
from codegen.ir.from_sympy import read
from codegen.run.floats import EmittedFloats
from codegen.snippets.graph import needed
from orderconds.ring import QQ

x, y, z = sympy.symbols("x y z", real=True)

FORMULAS = [
    x**3 * y - x * y / z,
    sympy.sin(x * y) * sympy.cos(z) ** 2,
    sympy.exp(x - y) / (1 + z**2),
    sympy.sqrt(x**2 + y**2 + z**2),
    (x**2 + y**2) ** sympy.Rational(-3, 2),
    sympy.log(x + y) - sympy.sqrt(z) ** 3,
    (x - y) * (x - y) * (x + z) ** 5,
    sympy.Integer(7),
    x,
]


@pytest.mark.parametrize("formula", FORMULAS, ids=str)
def test_the_gradient_is_that_of_sympy(formula):
    space, rng = Space(), random.Random(str(formula))
    d = PreciseDomain(0, 30)
    slopes = gradient(read(space, formula), ["x", "y", "z"])
    point = {name: d.rational(rng.randint(1, 40), 17) for name in "xyz"}
    exact = {s: sympy.Rational(int(point[s.name] * 17 + d.rational(1, 2)), 17) for s in (x, y, z)}
    for slope, s in zip(slopes, (x, y, z), strict=True):
        (found,) = evaluate([slope], d, point)
        expected = d.context.mpf(str(sympy.diff(formula, s).subs(exact).evalf(30)))
        assert abs(found - expected) < 1e-26 * max(1, abs(expected))


def test_derivatives_of_an_interned_polynomial_can_be_taken_again():
    space = Space()
    u = space.sym("u")
    e = u**5
    for factor in (5, 20, 60, 120, 120):
        (e,) = gradient(e, ["u"])
        assert evaluate([e], PreciseDomain(0, 20), {"u": 1}) == [factor]
    assert gradient(e, ["u"])[0].is_zero


def test_a_shared_part_is_counted_for_each_use():
    space = Space()
    u = space.sym("u")
    w = u * u + 1
    (slope,) = gradient(w * w + w, ["u"])
    assert evaluate([slope], PreciseDomain(0, 20), {"u": 2}) == [2 * 5 * 4 + 4]


@pytest.mark.parametrize("z", ["0", "1e-9", "0.3", "1", "1.7", "25"])
@pytest.mark.parametrize("name", [*(f"stumpff{k}" for k in range(4)), "slope2", "slope3"])
def test_the_derivatives_of_stumpff_functions_are_limits_of_difference_quotients(name, z):
    space, d = Space(), PreciseDomain(0, 60)
    (slope,) = gradient(space.call(name, space.sym("u")), ["u"])
    u, step = d.context.mpf(z), d.context.mpf("1e-20")
    (found,) = evaluate([slope], d, {"u": u})
    quotient = (d.call(name, u + step) - d.call(name, u)) / step
    assert abs(found - quotient) < 1e-19


@pytest.mark.parametrize("z", ["-40", "-1.7", "-1", "-1e-9", "0", "0.3", "1", "25"])
@pytest.mark.parametrize("name", [f"signed_stumpff{k}" for k in range(4)])
def test_derivatives_for_arguments_of_either_sign_are_limits_of_difference_quotients(name, z):
    space, d = Space(), PreciseDomain(0, 60)
    (slope,) = gradient(space.call(name, space.sym("u")), ["u"])
    u, step = d.context.mpf(z), d.context.mpf("1e-20")
    (found,) = evaluate([slope], d, {"u": u})
    quotient = (d.call(name, u + step) - d.call(name, u)) / step
    assert abs(found - quotient) < 1e-18


@pytest.mark.parametrize("k", [2, 3])
def test_slopes_in_doubles_and_over_power_series_are_those_of_many_digits(k):
    d = PreciseDomain(0, 40)
    for z in (0.0, 1e-12, 0.4, 1.0, 1.0000001, 3.0, 400.0):
        exact = d.call(f"slope{k}", d.context.mpf(z))
        assert abs(FloatDomain(0.0).call(f"slope{k}", z) - exact) <= 64 * 2.0**-53 * abs(d.call("slope2", 0))
    series = SeriesDomain(QQ, 6)
    h = series.h
    direct = series.call(f"slope{k}", h * h)
    by_terms = sum(
        (
            -(j + 1) * series.rational((-1) ** j, math.factorial(2 * j + 2 + k)) * (h * h) ** j
            for j in range(4)
        ),
        series.ring.zero,
    )
    assert all(QQ.is_zero(a - b) for a, b in zip(direct.coefficients, by_terms.coefficients, strict=True))


@pytest.mark.parametrize("k", [2, 3])
def test_second_derivatives_in_doubles_balls_and_power_series_are_those_of_many_digits(k):
    d, balls, name = PreciseDomain(0, 40), BallDomain(Fraction(1), 40), f"curvature{k}"
    emitted = needed("python", [name])
    space = {function: getattr(math, function) for function in emitted.library}
    exec("\n\n".join(emitted.texts), space)
    for z in (0.0, 1e-12, 0.4, 1.0, 1.0000001, 3.0, 400.0):
        exact = d.call(name, d.context.mpf(z))
        allowed = 256 * 2.0**-53 * abs(d.call("slope2", 0))
        assert abs(FloatDomain(0.0).call(name, z) - exact) <= allowed
        assert abs(space[name](z) - exact) <= allowed
        assert EmittedFloats().call(name, z) == space[name](z)
        with balls.precision():
            ball = balls.mpf(balls.call(name, balls.scalar(d.context.mpf(z))), d.context)
        assert abs(ball - exact) < 1e-36
    series = SeriesDomain(QQ, 6)
    h = series.h
    direct = series.call(name, h * h)
    terms = (
        (j + 1) * (j + 2) * series.rational((-1) ** j, math.factorial(2 * j + 4 + k)) * (h * h) ** j
        for j in range(4)
    )
    by_terms = sum(terms, series.ring.zero)
    assert all(QQ.is_zero(a - b) for a, b in zip(direct.coefficients, by_terms.coefficients, strict=True))


def test_a_quotient_is_differentiated_away_from_the_zeros_of_its_divisor():
    space, d = Space(), PreciseDomain(0, 30)
    a, b = space.sym("a"), space.sym("b")
    slopes = gradient(space.call("quotient", a, b), ["a", "b"])
    assert evaluate(slopes, d, {"a": 3, "b": 2}) == [d.rational(1, 2), d.rational(-3, 4)]


@pytest.mark.parametrize(
    "name", ["curvature2", "curvature3", "signed_slope1", "signed_slope2", "signed_slope3"]
)
def test_functions_without_a_derivative_here_are_refused(name):
    space = Space()
    with pytest.raises(NotDifferentiable, match=name):
        gradient(space.call(name, space.sym("u")), ["u"])
