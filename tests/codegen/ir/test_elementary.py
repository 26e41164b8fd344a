"""Elementary functions: derivatives, Taylor coefficients, exact series, emitted code."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import mpmath
import pytest
import sympy

from codegen.emitter import compile_method, emit
from codegen.groups import LeftMultiplication, Rn
from codegen.integrator import StepFailed
from codegen.ir.differentiate import gradient, partials
from codegen.ir.domain import ExprDomain, PreciseDomain, SeriesDomain
from codegen.ir.elementary import ELEMENTARY, MATHEMATICAL
from codegen.ir.expr import Space, evaluate
from codegen.ir.from_sympy import read
from codegen.ir.interpret import interpret
from codegen.ir.linearise import FirstOrder
from codegen.ir.taylor_recurrence import Recurrence
from codegen.loader import load
from codegen.scene import FieldScene
from codegen.scene.problem import Problem
from orderconds.ring import QQ

POINT = Fraction(2, 7)
"""An argument at which every function is analytic."""


@pytest.fixture(params=sorted(ELEMENTARY))
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def coefficients(name: str, count: int) -> list[mpmath.mpf]:
    """The Taylor coefficients of f(POINT + sin s) in s, by mpmath."""
    with mpmath.workdps(60):
        at = mpmath.mpf(POINT.numerator) / POINT.denominator
        return list(mpmath.taylor(lambda s: getattr(mpmath, name)(at + mpmath.sin(s)), 0, count))


def test_sympy_formulas_are_read(name: str) -> None:
    x = sympy.Symbol("x")
    root = read(Space(), getattr(sympy, name)(x))
    assert (root.op, root.payload) == ("call", name)


def test_first_and_second_derivatives_agree_with_sympy(name: str) -> None:
    space = Space()
    root = space.call(name, space.sym("x"))
    first = partials(root)[0]
    second = gradient(first, ["x"])[0]
    rule = ELEMENTARY[name].curvature(space.sym("x"), root)
    domain = PreciseDomain(0, 40)
    values = evaluate([first, second, rule], domain, {"x": domain.rational(2, 7)})
    x = sympy.Symbol("x")
    for k, value in zip((1, 2, 2), values, strict=True):
        expected = sympy.diff(getattr(sympy, name)(x), x, k).subs(x, sympy.Rational(2, 7)).evalf(40)
        assert abs(value - domain.context.mpf(str(expected))) < domain.context.mpf(10) ** -35


def test_expansions_in_h_agree_with_differences(name: str) -> None:
    space = Space()
    x, h = space.sym("x"), space.sym("h")
    ((entry,),) = FirstOrder(["x"]).jacobian([space.call(name, x + h * x * x)])
    domain = PreciseDomain(0, 40)
    at, small = domain.rational(2, 7), domain.context.mpf(10) ** -12
    exact = domain.context.diff(lambda y: getattr(domain.context, name)(y + small * y * y), at)
    (value,) = evaluate([entry], domain, {"x": at, "h": small})
    assert abs(value - exact) < mpmath.mpf(10) ** -22


def test_taylor_recurrences_agree_with_mpmath(name: str) -> None:
    # y' = cos t, so y = POINT + sin t; z' = f(y)
    space, domain = Space(), PreciseDomain(0, 40)
    roots = [space.call("cos", space.sym("t")), space.call(name, space.sym("y"))]
    start = [domain.rational(POINT.numerator, POINT.denominator), domain.rational(0)]
    one, zero = domain.rational(1), domain.rational(0)
    series = Recurrence(roots, domain, ["y", "z"], start, {"t": zero}, one).extend(9)
    for k, expected in enumerate(coefficients(name, 8)):
        assert abs((k + 1) * (series[1][k + 1] or zero) - expected) < mpmath.mpf(10) ** -25


@pytest.mark.parametrize("name", [n for n in ELEMENTARY if ELEMENTARY[n].at_zero is not None])
def test_exact_series_agree_with_sympy(name: str) -> None:
    domain = SeriesDomain(QQ, 9)
    value = domain.call(name, domain.h + domain.h * domain.h)
    h = sympy.Symbol("h")
    expected = sympy.series(getattr(sympy, name)(h + h**2), h, 0, 10).removeO()
    for k, coefficient in enumerate(value.coefficients):
        assert sympy.Rational(str(coefficient)) == expected.coeff(h, k)


def test_values_without_an_exact_series_are_refused() -> None:
    domain = SeriesDomain(QQ, 4)
    with pytest.raises(ArithmeticError, match="acos cannot be computed for exact power series"):
        domain.call("acos", domain.h)
    with pytest.raises(ArithmeticError, match="constant term"):
        domain.call("tan", domain.ring.one)


def scene(name: str, y: sympy.Matrix, f: Sequence[sympy.Expr], y0: Sequence[sympy.Expr]) -> Problem:
    """A field on R^n that acts by translations."""
    group = Rn(len(f))
    return FieldScene(group=group, action=LeftMultiplication(), y=y, f=f, y0=y0, span=(0, 1), name=name)


def calling() -> Problem:
    """A field that calls every function."""
    x, y = state = Rn(2).point("z")
    inner = sympy.sin(x * y) / 2
    total = sum(getattr(sympy, name)(inner) for name in MATHEMATICAL if name not in ("sqrt", "log"))
    return scene("calls", state, [-total / 9, x - y], [sympy.Rational(1, 2), sympy.Integer(1)])


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("method", ["ambient:rk4", "taylor(6)", "ambient:gauss2"])
def test_emitted_steps_agree_with_the_interpreter(target: str, method: str) -> None:
    problem = calling()
    emitted = load(emit(problem, method, target=target)).run([0.5, 1.0], h=0.125, steps=1)
    compiled = compile_method(problem, method)
    domain = PreciseDomain(Fraction(1, 8), 30)
    if compiled.method.family == "taylor":
        roots = problem.velocity(
            ExprDomain(space := Space()), (space.sym("z0"), space.sym("z1")), space.sym("t")
        )
        start = problem.initial(domain)
        series = Recurrence(roots, domain, ["z0", "z1"], start, {"t": domain.rational(0)}, domain.rational(1))
        exact = [sum((c or 0) * domain.h**k for k, c in enumerate(x)) for x in series.extend(6)]
    else:
        exact = interpret(
            compiled.program, problem, domain, {"y": problem.initial(domain), "t": domain.rational(0)}
        )["y"]
    assert all(abs(a - b) < 4e-15 for a, b in zip(emitted, exact, strict=True))


@pytest.mark.parametrize("name", ["asin", "sinh"])
def test_an_argument_outside_the_range_of_python_is_the_same_status_in_both_targets(name: str) -> None:
    (x,) = state = Rn(1).point("z")
    problem = scene("outside", state, [getattr(sympy, name)(1000 * x)], [sympy.Rational(1, 1000)])
    statuses = set()
    for target in ("c", "python"):
        with pytest.raises(StepFailed) as failure:
            load(emit(problem, "ambient:rk4", target=target)).run([2.0], h=0.125, steps=3)
        statuses.add(str(failure.value))
    assert len(statuses) == 1
