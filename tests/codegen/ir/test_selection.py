"""Selections, angles and tables in formulas: values, derivatives, series, and emitted code."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction

import mpmath
import pytest
import sympy

from codegen.emitter import compile_method, emit
from codegen.errors import SceneError
from codegen.groups import LeftMultiplication, Rn
from codegen.integrator import StepFailed
from codegen.ir.ball_domain import BallDomain
from codegen.ir.differentiate import gradient
from codegen.ir.domain import Domain, ExprDomain, FloatDomain, PreciseDomain, SeriesDomain
from codegen.ir.expr import Expr, Space, evaluate
from codegen.ir.from_sympy import read
from codegen.ir.interpret import interpret
from codegen.ir.linearise import FirstOrder
from codegen.ir.selection import Kink
from codegen.ir.smoothness import features, on_sides, selections
from codegen.ir.table import PiecewisePolynomial
from codegen.ir.taylor_recurrence import Recurrence
from codegen.loader import load
from codegen.scene import FieldScene
from codegen.scene.problem import Problem
from orderconds.ring import QQ
from tests.codegen.ir.selections import FORMULAS, x, y

POINTS = [(Fraction(2, 5), Fraction(1)), (Fraction(7, 3), Fraction(1, 8)), (Fraction(-3, 4), Fraction(5, 2))]


@pytest.fixture(params=sorted(FORMULAS))
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def numeric(name: str, at: tuple[Fraction, Fraction]) -> mpmath.mpf:
    """The value by sympy; a table by the polynomial of its interval."""
    places = {x: sympy.Rational(at[0]), y: sympy.Rational(at[1])}
    formula = FORMULAS[name]
    tables = {e: _of_table(e, places) for e in sympy.preorder_traversal(formula) if hasattr(e, "polynomial")}
    return mpmath.mpf(str(formula.xreplace(tables).subs(places).evalf(45)))


def _of_table(e: sympy.Expr, places: dict[sympy.Symbol, sympy.Rational]) -> sympy.Rational:
    f, at = e.polynomial, e.args[1].subs(places)
    k = sum(bool(at >= sympy.Rational(knot)) for knot in f.knots)
    return sum(sympy.Rational(c) * (at - sympy.Rational(f.bases[k])) ** j for j, c in enumerate(f.rows[k]))


def evaluated(roots: list[Expr], domain: Domain, at: tuple[Fraction, Fraction]) -> list[mpmath.mpf]:
    return evaluate(
        roots, domain, {n: domain.rational(*v.as_integer_ratio()) for n, v in zip("xy", at, strict=True)}
    )


@pytest.mark.parametrize("at", POINTS, ids=str)
def test_values_agree_with_sympy(name: str, at: tuple[Fraction, Fraction]) -> None:
    root = read(Space(), FORMULAS[name])
    with mpmath.workdps(45):
        expected = numeric(name, at)
        (precise,) = evaluated([root], PreciseDomain(0, 40), at)
        assert abs(precise - expected) < mpmath.mpf(10) ** -37
        balls = BallDomain(0.0, 40)
        with balls.precision():
            (ball,) = evaluated([root], balls, at)
        assert abs(balls.mpf(ball, mpmath.mp) - expected) < mpmath.mpf(10) ** -37
    (double,) = evaluated([root], FloatDomain(0.0), at)
    assert abs(double - float(expected)) <= 4 * math.ulp(max(1.0, abs(float(expected))))


@pytest.mark.parametrize("at", POINTS, ids=str)
def test_gradients_agree_with_differences(name: str, at: tuple[Fraction, Fraction]) -> None:
    root = read(Space(), FORMULAS[name])
    domain = PreciseDomain(0, 50)
    eps = Fraction(1, 10**15)
    for k, slope in enumerate(evaluated(gradient(root, ["x", "y"]), domain, at)):
        ends = [
            evaluated([root], domain, (at[0] + s * eps * (k == 0), at[1] + s * eps * (k == 1)))[0]
            for s in (1, -1)
        ]
        difference = (ends[0] - ends[1]) / (2 * domain.rational(*eps.as_integer_ratio()))
        assert abs(slope - difference) < mpmath.mpf(10) ** -25


@pytest.mark.parametrize("name", sorted(FORMULAS.keys() - {"angle"}))
def test_expansions_in_h_agree_with_differences(name: str) -> None:
    space = Space()
    symbols = {"x": space.sym("x") + space.sym("h") * space.sym("y"), "y": space.sym("y")}
    (root,) = evaluate([read(space, FORMULAS[name])], ExprDomain(space), symbols)
    ((entry,),) = FirstOrder(["x"]).jacobian([root])
    domain = PreciseDomain(0, 50)
    at = {"x": domain.rational(2, 5), "y": domain.rational(1), "h": domain.rational(1, 10**15)}
    (exact,) = evaluate(gradient(root, ["x"]), domain, at)
    (value,) = evaluate([entry], domain, at)
    assert abs(value - exact) < mpmath.mpf(10) ** -25


def test_taylor_coefficients_agree_with_mpmath(name: str) -> None:
    # x' = cos t and y' = -y/3, so x = 2/5 + sin t and y = exp(-t/3); z' = the formula
    space, domain = Space(), PreciseDomain(0, 40)
    roots = [space.call("cos", space.sym("t")), read(space, -y / 3), read(space, FORMULAS[name])]
    start = [domain.rational(2, 5), domain.rational(1), domain.rational(0)]
    series = Recurrence(roots, domain, ["x", "y", "z"], start, {"t": domain.rational(0)}, domain.rational(1))
    found = series.extend(7)[2]
    precise = PreciseDomain(0, 90)
    context = precise.context

    def formula(t: mpmath.mpf) -> mpmath.mpf:
        at = {"x": context.mpf(2) / 5 + context.sin(t), "y": context.exp(-t / 3)}
        return evaluate([roots[2]], precise, at)[0]

    for k, expected in enumerate(context.taylor(formula, 0, 6)):
        assert abs((k + 1) * (found[k + 1] or 0) - expected) < mpmath.mpf(10) ** -9 * math.factorial(k)


@pytest.mark.parametrize("name", [n for n in FORMULAS if n not in ("roots", "angle")])
def test_exact_series_agree_with_differences(name: str) -> None:
    root = read(Space(), FORMULAS[name])
    series = SeriesDomain(QQ, 3)
    at = {"x": series.rational(2, 5) + series.h, "y": series.rational(1) - series.h * series.rational(1, 2)}
    if name == "conditions":
        at["y"] = at["y"] + series.rational(1, 7)
    (value,) = evaluate([root], series, at)
    small = Fraction(1, 10**9)
    precise = PreciseDomain(0, 60)
    shift = Fraction(1, 7) if name == "conditions" else Fraction(0)
    (exact,) = evaluated([root], precise, (Fraction(2, 5) + small, 1 - small / 2 + shift))
    total = sum(Fraction(str(c)) * small**k for k, c in enumerate(value.coefficients))
    assert abs(exact - precise.rational(*total.as_integer_ratio())) < mpmath.mpf(10) ** -34


def test_a_series_at_a_kink_is_refused() -> None:
    domain = SeriesDomain(QQ, 3)
    with pytest.raises(Kink, match="not smooth"):
        domain.call("fabs", domain.h)
    with pytest.raises(Kink):
        domain.call("choose", domain.ring.zero, domain.h, domain.ring.one)
    ramp = PiecewisePolynomial(
        (Fraction(0),), (Fraction(0),) * 2, ((Fraction(0),), (Fraction(0), Fraction(1)))
    )
    with pytest.raises(Kink):
        domain.call(ramp, domain.h)


def test_an_angle_is_exact_only_on_the_positive_axis() -> None:
    domain = SeriesDomain(QQ, 5)
    value = domain.call("atan2", domain.h, domain.ring.one + domain.h)
    h = sympy.Symbol("h")
    expected = sympy.series(sympy.atan(h / (1 + h)), h, 0, 6).removeO()
    assert [sympy.Rational(str(c)) for c in value.coefficients] == [expected.coeff(h, k) for k in range(6)]
    for pair in ((domain.ring.one, domain.ring.one), (domain.h, -domain.ring.one)):
        with pytest.raises(ArithmeticError, match="positive x-axis"):
            domain.call("atan2", *pair)


def test_the_formula_on_one_side_is_smooth_and_equal_there(name: str) -> None:
    root = read(Space(), FORMULAS[name])
    nodes, at, domain = selections([root]), POINTS[0], PreciseDomain(0, 40)
    tests = evaluated([node.args[0] for node in nodes], domain, at)
    sides = tuple(
        sum(bool(v >= domain.rational(*k.as_integer_ratio())) for k in node.payload.knots)
        if isinstance(node.payload, PiecewisePolynomial)
        else int(v > 0)
        for node, v in zip(nodes, tests, strict=True)
    )
    roots, margins = on_sides([root], nodes, sides)
    assert not selections(roots)
    assert all(v >= 0 for v in evaluated(margins, domain, at))
    assert abs(evaluated(roots, domain, at)[0] - evaluated([root], domain, at)[0]) < mpmath.mpf(10) ** -37
    assert features([root])


EACH = [pytest.param(name, marks=pytest.mark.slow) for name in sorted(FORMULAS)]
"""Each formula in its own module, and all formulas in one module."""


def scene(name: str) -> Problem:
    u, v = state = Rn(2).point("z")
    formula = FORMULAS[name] if name in FORMULAS else sum(FORMULAS.values()) / 10
    f = [formula.xreplace({x: u, y: v}), u - v / 2]
    return FieldScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=state,
        f=f,
        y0=[0.4, 1],
        span=(0, Fraction(1, 4)),
        name=name,
    )


@pytest.mark.parametrize("name", ["all", *EACH])
@pytest.mark.parametrize("target", ["c", "python"])
def test_emitted_steps_agree_with_60_digits(name: str, target: str) -> None:
    problem = scene(name)
    domain = PreciseDomain(Fraction(1, 8), 60)
    emitted = load(emit(problem, "ambient:rk4", target=target)).run([0.4, 1.0], h=0.125, steps=1)
    program = compile_method(problem, "ambient:rk4").program
    exact = interpret(program, problem, domain, {"y": problem.initial(domain), "t": domain.rational(0)})["y"]
    assert all(abs(a - b) <= 3 * math.ulp(max(1.0, abs(a))) for a, b in zip(emitted, exact, strict=True))


@pytest.mark.parametrize("name", ["all", *EACH])
@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("method", ["taylor(5)", "taylor(20)"])
def test_emitted_taylor_steps_agree_with_recurrences(name: str, method: str, target: str) -> None:
    problem = scene(name)
    domain, space = PreciseDomain(Fraction(1, 8), 40), Space()
    roots = problem.velocity(ExprDomain(space), tuple(map(space.sym, problem.symbols)), space.sym("t"))
    start = problem.initial(domain)
    series = Recurrence(roots, domain, problem.symbols, start, {"t": domain.rational(0)}, domain.rational(1))
    degree = int(method[7:-1])
    exact = [sum((c or 0) * domain.h**k for k, c in enumerate(row)) for row in series.extend(degree)]
    emitted = load(emit(problem, method, target=target)).run([0.4, 1.0], h=0.125, steps=1)
    assert all(abs(a - b) <= 4 * math.ulp(max(1.0, abs(a))) for a, b in zip(emitted, exact, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["all", *sorted(FORMULAS)])
@pytest.mark.parametrize("target", ["c", "python"])
def test_single_precision_and_implicit_stages_are_emitted(name: str, target: str) -> None:
    problem = scene(name)
    double = load(emit(problem, "ambient:gauss2", target=target)).run([0.4, 1.0], h=0.125, steps=1)
    single = load(emit(problem, "ambient:gauss2", target=target, precision="single"))
    assert all(
        abs(a - b) < 1e-6 for a, b in zip(single.run([0.4, 1.0], h=0.125, steps=1), double, strict=True)
    )


@pytest.mark.parametrize("name", ["all", *EACH])
@pytest.mark.parametrize("target", ["c", "python"])
def test_a_nan_is_a_status_and_not_a_branch(name: str, target: str) -> None:
    integrator = load(emit(scene(name), "ambient:rk4", target=target))
    for start in ([math.nan, 1.0], [0.4, math.nan]):
        with pytest.raises(StepFailed):
            integrator.run(start, h=0.125, steps=1)


@pytest.mark.parametrize("function", ["choose", "fabs", *(n for n in ("spline", "line", "step"))])
def test_a_nan_stays_a_nan(function: str) -> None:
    domain = FloatDomain(0.0)
    if function in FORMULAS:
        (node,) = selections([read(Space(), FORMULAS[function])])
        assert math.isnan(domain.call(node.payload, math.nan))
    elif function == "step":
        table = PiecewisePolynomial((Fraction(0),), (Fraction(0),) * 2, ((Fraction(0),), (Fraction(1),)))
        assert math.isnan(domain.call(table, math.nan))
    else:
        assert math.isnan(domain.call(function, *([math.nan, 1.0, 2.0][: 3 if function == "choose" else 1])))


def test_a_branch_that_is_not_selected_is_evaluated_at_safe_arguments() -> None:
    formula = sympy.Piecewise(
        (sympy.sqrt(x) + sympy.log(x) + 1 / x + sympy.asin(1 / x) + sympy.exp(-1000 * x), x > 1), (x, True)
    )
    root = read(Space(), formula)
    for domain in (FloatDomain(0.0), PreciseDomain(0, 30)):
        values = evaluate([root, *gradient(root, ["x"])], domain, {"x": domain.rational(-2)})
        assert [float(v) for v in values] == [-2.0, 1.0]


def test_a_float_means_the_decimal_that_prints_it() -> None:
    space = Space()
    assert read(space, 0.1 * x) is read(space, x / 10)
    assert read(space, x**0.5) is read(space, sympy.sqrt(x))
    with pytest.raises(SceneError, match=r"the number 1\.00"):
        read(space, sympy.Float("1e-400", 30))


def test_a_table_survives_pickling_and_is_named_by_its_data() -> None:
    (node,) = selections([read(Space(), FORMULAS["spline"])])
    table = node.payload
    again = pickle.loads(pickle.dumps(table))
    assert (again, again.rows, again.knots) == (table, table.rows, table.knots)
    assert table.derivative() != table
