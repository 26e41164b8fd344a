from __future__ import annotations

import random

import pytest
import sympy

from codegen.ir.differentiate import gradient
from codegen.ir.domain import PreciseDomain
from codegen.ir.expr import Space, evaluate
from codegen.ir.from_sympy import read

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


def test_run_time_functions_are_not_differentiated():
    space = Space()
    with pytest.raises(ValueError, match="not differentiated"):
        gradient(space.call("stumpff1", space.sym("u")), ["u"])
