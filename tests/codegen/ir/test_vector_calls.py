"""Calls of vector functions in expressions: values, derivatives of every order, and shared calls."""

from __future__ import annotations

import random

import pytest

from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain, FloatDomain, PreciseDomain, SeriesDomain
from codegen.ir.expr import Space, evaluate, text
from codegen.ir.jacobian import jacobian
from codegen.ir.number import Number
from codegen.ir.tangent import tangents
from codegen.ir.vector_calls import component, vector_function
from orderconds.ring import QQ

FUNCTIONS = ("expm2", "expm3", "expm2_d1", "inverse3", "product2", "commutator2")
D = PreciseDomain(0, 60)


class Counting(FloatDomain):
    """Doubles that count the calls of vector functions."""

    calls = 0

    def vector(self, function, args):
        self.calls += 1
        return super().vector(function, args)


def arguments(function):
    return [f"x{k}" for k in range(sum(vector_function(function).arrays))]


def point(names, seed=0):
    rng = random.Random(seed)
    return {name: D.context.mpf(rng.uniform(-1, 1)) for name in names}


def called(function, space):
    names = arguments(function)
    # The arguments are products, so that the chain rule is tested as well.
    inner = [space.sym(n) * (1 + space.sym(names[0])) for n in names]
    return names, space.vector(function, inner)


def quotient(roots, values, name):
    """Central difference quotients of order 4 by one variable."""
    step, result = D.context.mpf("1e-12"), []
    around = [evaluate(roots, D, values | {name: values[name] + k * step}) for k in (-2, -1, 1, 2)]
    for a, b, c, d in zip(*around, strict=True):
        result.append((a - 8 * b + 8 * c - d) / (12 * step))
    return result


def close(a, b):
    return all(abs(x - y) <= D.context.mpf("1e-40") for x, y in zip(a, b, strict=True))


@pytest.mark.parametrize("function", FUNCTIONS)
def test_the_jacobian_is_the_limit_of_difference_quotients(function):
    space = Space()
    names, results = called(function, space)
    values = point(names)
    chosen = [names[0], names[-1], names[len(names) // 2]]
    rows = jacobian(list(results), chosen)
    for k, name in enumerate(chosen):
        assert close(evaluate([row[k] for row in rows], D, values), quotient(list(results), values, name))


@pytest.mark.parametrize("function", FUNCTIONS)
def test_tangents_and_gradients_agree_with_the_jacobian(function):
    space = Space()
    names, results = called(function, space)
    values = point(names)
    rates = {name: space.sym(f"d{k}") for k, name in enumerate(names)}
    values |= point([f"d{k}" for k in range(len(names))], 1)
    rows = jacobian(list(results), names)
    expected = [sum(a * values[f"d{k}"] for k, a in enumerate(evaluate(row, D, values))) for row in rows]
    assert close(evaluate(tangents(results, rates), D, values), expected)
    assert close(evaluate(gradient(results[1], names), D, values), evaluate(rows[1], D, values))


@pytest.mark.parametrize("function", ["expm2", "inverse3"])
def test_second_derivatives_exist(function):
    space = Space()
    names, results = called(function, space)
    values = point(names)
    first = gradient(results[0], names)
    second = jacobian(first, names[:2])
    for k, name in enumerate(names[:2]):
        assert close(evaluate([row[k] for row in second], D, values), quotient(first, values, name))


def test_the_results_of_one_call_are_computed_together():
    space = Space()
    names, results = called("expm3", space)
    domain = Counting(0.1)
    values = {name: 0.1 * k for k, name in enumerate(names)}
    assert len(evaluate(results, domain, values)) == 9
    assert domain.calls == 1
    tangent = tangents(results, {name: space.sym(name) for name in names})
    evaluate(tangent, domain, values)
    assert domain.calls == 2


@pytest.mark.parametrize("function", ["expm2", "inverse2", "product2", "commutator2"])
def test_a_call_over_series_has_the_coefficients_of_the_derivatives(function):
    d, space = SeriesDomain(QQ, 3), Space()
    names = arguments(function)
    results = space.vector(function, [space.sym(n) for n in names])
    n = round(vector_function(function).size ** 0.5)
    slopes = [d.rational(k + 1, 2) * d.h for k in range(len(names))]
    regular = int(function == "inverse2")
    unit = [d.rational(regular * int(k % (n + 1) == 0)) for k in range(n * n)]
    start = [*unit, *[d.rational(0)] * (len(names) - n * n)]
    values = {name: a + b for name, a, b in zip(names, start, slopes, strict=True)}
    series = evaluate(results, d, values)
    rates = {name: space.const(Number.rational(k + 1) / Number.rational(2)) for k, name in enumerate(names)}
    tangent = tangents(results, rates)
    at_start = evaluate(tangent, d, dict(zip(names, start, strict=True)))
    assert [x.coefficients[1] for x in series] == [x.coefficients[0] for x in at_start]


def test_the_zeros_of_a_nilpotent_matrix_give_a_polynomial():
    d = ExprDomain()
    x, y, zero = d.space.sym("x"), d.space.sym("y"), d.space.zero
    results = d.vector("expm3", (zero, x, zero, zero, zero, y, zero, zero, zero))
    assert [text(r) for r in results] == ["1", "x", "(1/2 * (x * y))", "0", "1", "y", "0", "0", "1"]
    full = d.vector("expm2", (zero, x, y, zero))
    assert component(full[0].payload) == (vector_function("expm2"), 0)


def test_unknown_names_are_refused():
    space = Space()
    for name in ("expm", "expm3_", "matmul3", "inverse"):
        with pytest.raises(ValueError, match="unknown vector function"):
            space.vector(name, [space.one])
        with pytest.raises(ValueError, match="unknown scalar function"):
            space.call(f"{name}.0", space.one)
        with pytest.raises(ValueError, match="unknown vector function"):
            FloatDomain(0.1).vector(name, [1.0])
