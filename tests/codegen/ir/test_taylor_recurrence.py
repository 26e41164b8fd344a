"""Taylor coefficients by recurrences are those that sympy computes by differentiation."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import pytest
import sympy

from codegen.errors import SceneError
from codegen.ir.domain import ExprDomain, PreciseDomain, SeriesDomain
from codegen.ir.expr import Space, evaluate, walk
from codegen.ir.from_sympy import read
from codegen.ir.taylor_loop import INVERSE, LINEAR, NEXT, ORDER, coordinate_names, order_loop
from codegen.ir.taylor_recurrence import Recurrence
from codegen.ir.taylor_series import Convolution, Power, Quotient, Root
from orderconds.ring import QQ

y, t = sympy.symbols("y t", real=True)
HALF = sympy.Rational(1, 2)

FIELDS = [
    1 + y - 3 * y,
    y * (t + y),
    y**2,
    y**5 - y**3,
    (1 + y) / (2 + y * t),
    1 / (1 + y**2),
    sympy.sqrt(3 + y),
    y / sympy.sqrt(1 + y**2),
    (1 + y**2) ** (-3 * HALF),
    (2 + y) ** (5 * HALF),
    1 / (2 + y) ** 3,
    sympy.sin(2 * y + t),
    sympy.sin(y) * sympy.cos(y),
    sympy.cos(3 * t) - y,
    sympy.exp(-y * t),
    sympy.exp(HALF * t),
    sympy.log(2 + y**2),
    sympy.sqrt(2) * y - t**3,
    sympy.Integer(7) / 3,
    t,
]
START, NOW = Fraction(5, 7), Fraction(3, 11)
DEGREE = 6


@cache
def exact(field: sympy.Expr) -> list[sympy.Expr]:
    """The coefficients at START and NOW, by repeated total derivatives along the field."""
    derivatives = [y]
    while len(derivatives) <= DEGREE:
        last = derivatives[-1]
        derivatives.append(sympy.diff(last, t) + sympy.diff(last, y) * field)
    at = {y: sympy.Rational(5, 7), t: sympy.Rational(3, 11)}
    return [(d.subs(at) / sympy.factorial(n)).evalf(40) for n, d in enumerate(derivatives)]


def recurrence(field: sympy.Expr, domain, scale):
    space = domain.space if isinstance(domain, ExprDomain) else Space()
    start, now = (domain.rational(x.numerator, x.denominator) for x in (START, NOW))
    if isinstance(domain, ExprDomain):
        start, now = space.sym("y"), space.sym("t")
    return Recurrence([read(space, field)], domain, ["y"], [start], {"t": now}, scale)


@pytest.mark.parametrize("field", FIELDS, ids=str)
def test_coefficients_are_the_derivatives_that_sympy_computes(field):
    domain = PreciseDomain(0, 35)
    (found,) = recurrence(field, domain, domain.rational(1)).extend(DEGREE)
    for x, expected in zip(found, exact(field), strict=True):
        value = domain.context.mpf(str(expected))
        assert abs((x or 0) - value) <= 1e-30 * max(1, abs(value))


@pytest.mark.parametrize("field", FIELDS, ids=str)
def test_the_loop_over_the_order_computes_the_same_coefficients(field):
    exprs, domain = ExprDomain(), PreciseDomain(0, 35)
    loop = order_loop(recurrence(field, exprs, exprs.space.one), exprs.space)
    known = {"y": domain.rational(5, 7), "t": domain.rational(3, 11)}
    first = evaluate([*loop.first, *loop.start], domain, known)
    values = dict(zip(loop.names, first, strict=False))
    row, left, right = [first[-1]], [], []
    for n in range(1, DEGREE):
        sums = [
            sum((left[j][k] * right[n - 2 - j][k] for j in range(n - 1)), domain.rational(0))
            for k in range(len(loop.sums))
        ]
        numbers = {ORDER: domain.rational(n), INVERSE: domain.rational(1, n)}
        numbers |= {NEXT: domain.rational(1, n + 1), LINEAR: domain.rational(int(n == 1))}
        at = {**values, **numbers, **dict(zip(loop.sums, sums, strict=True)), coordinate_names(1)[0]: row[-1]}
        left.append(evaluate(loop.left, domain, at))
        right.append(evaluate(loop.right, domain, at))
        row += evaluate(loop.following, domain, at)
    for x, expected in zip(row, exact(field)[1:], strict=True):
        value = domain.context.mpf(str(expected))
        assert abs(x - value) <= 1e-30 * max(1, abs(value))


def test_powers_of_the_step_are_part_of_scaled_coefficients():
    domain = SeriesDomain(QQ, 4)
    (found,) = recurrence(y * t, domain, domain.h).extend(4)
    (plain,) = recurrence(y * t, domain, domain.rational(1)).extend(4)
    power = domain.rational(1)
    for x, c in zip(found, plain, strict=True):
        assert domain.ring.is_zero(x - c * power)
        power = power * domain.h


def terms(field: sympy.Expr, degree: int) -> dict[str, int]:
    """The operations of the coefficients up to a degree, by their names."""
    domain = ExprDomain()
    (found,) = recurrence(field, domain, domain.space.one).extend(degree)
    counts: dict[str, int] = {}
    for node in walk(x for x in found if x is not None):
        counts[node.op] = counts.get(node.op, 0) + 1
    return counts


def test_the_convolution_of_a_square_is_halved():
    full, half = terms(y * (1 + y), 20), terms(y * y, 20)
    assert half["add"] < 0.6 * full["add"]


def test_expressions_that_are_linear_in_the_time_cost_one_term():
    # sin(3 t) alone: one product for the sine and one for the cosine of each order, besides constants.
    counts = terms(sympy.sin(3 * t), 12)
    assert counts["call"] == 2
    assert "add" not in counts


@pytest.mark.parametrize(
    ("field", "kinds"),
    [
        ((1 + y**2) ** (-3 * HALF), {Power}),
        (sympy.sqrt(1 + y) ** 3 / (1 + y), {Root}),
        (1 / (1 + y), {Quotient}),
        (y / (1 + y) ** (3 * HALF), {Convolution, Power}),
    ],
    ids=["power of a sum", "root", "quotient", "product of a power"],
)
def test_powers_of_one_expression_are_one_recurrence(field, kinds):
    domain = ExprDomain()
    (slope,) = (s for _, s in recurrence(field, domain, domain.space.one).slopes)
    found, waiting = set(), [slope]
    while waiting:
        series = waiting.pop()
        found |= {type(series)} & {Power, Root, Quotient, Convolution}
        waiting += [x for name in ("a", "b") if (x := getattr(series, name, None)) is not None]
    assert found == kinds


def test_a_function_without_recurrence_is_named():
    space, domain = Space(), PreciseDomain(0, 20)
    root = space.call("stumpff1", space.sym("y"))
    one = domain.rational(1)
    with pytest.raises(SceneError, match="no recurrence is known for the Taylor coefficients of stumpff1"):
        Recurrence([root], domain, ["y"], [one], {"t": one}, one)
