from __future__ import annotations

import random

import pytest

from codegen.ir.domain import ExprDomain, FloatDomain, SeriesDomain
from codegen.ir.expr import Space, evaluate, power, text, walk
from codegen.ir.number import Number
from orderconds.ring import QQ


@pytest.fixture
def s():
    return Space()


def test_equal_expressions_are_one_node(s):
    x, y = s.sym("x"), s.sym("y")
    assert x + y is y + x
    assert x * y is y * x
    assert (x - y) * 3 is 3 * (x - y)
    assert s.call("sin", x + y) is s.call("sin", y + x)


def test_spaces_do_not_mix(s):
    with pytest.raises(ValueError, match="two different spaces"):
        s.sym("x") + Space().sym("x")


@pytest.mark.parametrize(
    ("spelled", "expected"),
    [
        (lambda x, y: x - x, "0"),
        (lambda x, y: x * 0 + y, "y"),
        (lambda x, y: x / x, "1"),
        (lambda x, y: x + x, "(2 * x)"),
        (lambda x, y: -(x - y), "(y - x)"),
        (lambda x, y: x + -y, "(x - y)"),
        (lambda x, y: -x - y, "-((x + y))"),
        (lambda x, y: 2 * (3 * x), "(6 * x)"),
        (lambda x, y: -x * -y, "(x * y)"),
        (lambda x, y: x / 4, "(1/4 * x)"),
        (lambda x, y: (-x) ** 3, "-((x)^3)"),
        (lambda x, y: (-x) ** 2, "(x)^2"),
        (lambda x, y: x**0 + x**1, "(1 + x)"),
        (lambda x, y: 1 / x**2, "(1 / (x)^2)"),
        (lambda x, y: 0 / x, "0"),
    ],
)
def test_nodes_simplify_locally(s, spelled, expected):
    assert text(spelled(s.sym("x"), s.sym("y"))) == expected


def test_the_square_of_a_root_is_its_argument(s):
    x = s.sym("x")
    assert s.call("sqrt", x) ** 2 is x
    assert s.call("sqrt", x) ** 4 is x**2


def test_division_by_the_constant_zero_is_refused(s):
    with pytest.raises(ZeroDivisionError):
        s.sym("x") / 0


def test_unknown_functions_are_refused(s):
    with pytest.raises(ValueError, match="unknown scalar function"):
        s.call("gamma", s.sym("x"))


def random_pair(s, rng, depth):
    """An expression, and the same computation in plain arithmetic as a function of x and y."""
    if depth == 0:
        pick = rng.randrange(3)
        if pick == 2:
            c = rng.randint(-3, 3)
            return s.const(Number.rational(c)), lambda x, y: QQ.rational(c)
        return s.sym("xy"[pick]), (lambda x, y: x) if pick == 0 else (lambda x, y: y)
    a, f = random_pair(s, rng, depth - 1)
    b, g = random_pair(s, rng, depth - 1)
    match rng.randrange(5):
        case 0:
            return a + b, lambda x, y: f(x, y) + g(x, y)
        case 1:
            return a - b, lambda x, y: f(x, y) - g(x, y)
        case 2:
            return a * b, lambda x, y: f(x, y) * g(x, y)
        case 3:
            return -a, lambda x, y: -f(x, y)
        case _:
            return a**2, lambda x, y: f(x, y) * f(x, y)


@pytest.mark.parametrize("seed", range(40))
def test_simplification_keeps_the_value(s, seed):
    rng = random.Random(seed)
    e, f = random_pair(s, rng, 6)
    x, y = QQ.rational(2, 3), QQ.rational(-5, 7)

    class Rational:
        @staticmethod
        def number(value):
            return value.element

    assert evaluate([e], Rational(), {"x": x, "y": y}) == [f(x, y)]


def test_evaluation_over_expressions_is_substitution(s):
    target = Space()
    x, u = s.sym("x"), target.sym("u")
    (e,) = evaluate([(x + 1) * x], ExprDomain(target), {"x": u * u})
    assert e is (u * u + 1) * (u * u)


def test_evaluation_over_series_is_taylor_expansion(s):
    d = SeriesDomain(QQ, 4)
    x = s.sym("x")
    (value,) = evaluate([s.call("exp", x) / (1 - x)], d, {"x": d.h})
    assert [str(c) for c in value.coefficients] == ["1", "2", "5/2", "8/3", "65/24"]


def test_walk_meets_every_node_once_and_arguments_first(s):
    x = s.sym("x")
    e = (x + 1) * (x + 1) - s.call("sin", x + 1)
    nodes = list(walk([e, x]))
    place = {n.id: k for k, n in enumerate(nodes)}
    assert len(place) == len(nodes)
    assert all(place[a.id] < place[n.id] for n in nodes for a in n.args)


@pytest.mark.parametrize("n", range(1, 20))
def test_power_by_squaring(n):
    assert power(3, n) == 3**n


def test_doubles_evaluate_functions(s):
    (value,) = evaluate([s.call("sqrt", s.sym("x"))], FloatDomain(0.1), {"x": 2.0})
    assert value == 2.0**0.5
