from __future__ import annotations

import pytest
import sympy

from codegen.errors import SceneError
from codegen.ir.domain import PreciseDomain
from codegen.ir.expr import Space, evaluate, text
from codegen.ir.from_sympy import read

x, y = sympy.symbols("x y", real=True)


@pytest.mark.parametrize(
    "formula",
    [
        x + 2 * y - sympy.Rational(1, 3),
        x / y**2 - y / (x * (1 + x)),
        sympy.sqrt(x) ** 5 / sympy.sqrt(y) ** 3,
        x ** sympy.Rational(-1, 2),
        -x * -y,
        sympy.sin(x) * sympy.log(y) - sympy.exp(-x),
        (x + y) ** 7,
        sympy.sqrt(2) * x,
    ],
    ids=str,
)
def test_the_value_is_that_of_sympy(formula):
    d = PreciseDomain(0, 40)
    (found,) = evaluate([read(Space(), formula)], d, {"x": d.rational(3, 7), "y": d.rational(11, 5)})
    exact = formula.subs({x: sympy.Rational(3, 7), y: sympy.Rational(11, 5)}).evalf(45)
    assert abs(found - d.context.mpf(str(exact))) < 1e-36


@pytest.mark.parametrize(
    ("formula", "message"),
    [
        (x ** sympy.Rational(1, 3), "the exponent in"),
        (sympy.floor(x), "floor\\(x\\) has infinitely many jumps"),
        (x % 3, "Mod.* has infinitely many jumps"),
        (sympy.gamma(x), "gamma in the formula"),
        (sympy.I * x, "ImaginaryUnit"),
        (sympy.zoo, "ComplexInfinity"),
        (sympy.nan, "NaN"),
        (sympy.oo, "Infinity"),
        (x**y, "the exponent in"),
        (sympy.Piecewise((x, x > 0)), "has no default branch"),
        (sympy.Piecewise((x, sympy.Contains(x, sympy.Interval(0, 1))), (0, True)), "is not a condition"),
        (sympy.Function("u")(x), "u in the formula"),
    ],
    ids=str,
)
def test_what_cannot_be_read_is_named(formula, message):
    with pytest.raises(SceneError, match=message) as caught:
        read(Space(), formula, "here")
    assert caught.value.where == "here"
    assert caught.value.expected


def test_the_order_of_terms_does_not_depend_on_hashing():
    names = [f"v{k}" for k in range(12)]
    formula = sum(k * sympy.Symbol(n) for k, n in enumerate(names))
    backwards = sum(k * sympy.Symbol(n) for k, n in reversed(list(enumerate(names))))
    assert text(read(Space(), formula)) == text(read(Space(), backwards))
