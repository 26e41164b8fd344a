"""Jacobians by elimination are those by reverse differentiation, and cost less than column after column."""

from __future__ import annotations

import random

import pytest

from codegen.ir.differentiate import NotDifferentiable, gradient
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Expr, Space, evaluate, walk
from codegen.ir.jacobian import jacobian

NAMES = ("x0", "x1", "x2", "x3")


def formulas(seed: int) -> list[Expr]:
    """Random formulas that share much; a variable, a constant and a formula inside another are results."""
    rng, space = random.Random(seed), Space()
    pool = [space.sym(name) for name in (*NAMES, "h")]
    for _ in range(40):
        a, b = rng.choice(pool), rng.choice(pool)
        made = [a + b, a * b, a - b, -a, a / (2 + b * b), a**3, space.call("stumpff2", a * a)]
        pool.append(rng.choice([*made, space.call("sin", a), space.call("sqrt", 1 + a * a)]))
    return [*pool[-6:], pool[20], space.sym("x1"), space.one, space.sym("h")]


@pytest.mark.parametrize("seed", range(12))
def test_elimination_gives_the_gradients(seed):
    roots = formulas(seed)
    found = jacobian(roots, NAMES)
    expected = [gradient(root, NAMES) for root in roots]
    rng = random.Random(seed)
    values = {name: rng.uniform(-1, 1) for name in (*NAMES, "h")}
    for row, other in zip(found, expected, strict=True):
        a, b = (evaluate(side, FloatDomain(0.1), values) for side in (row, other))
        assert a == pytest.approx(b, rel=1e-11, abs=1e-11)


def test_a_variable_twice_in_one_operation_counts_twice():
    space = Space()
    x = space.sym("x")
    ((slope,),) = jacobian([x / (x + 1)], ["x"])
    assert evaluate([slope], FloatDomain(0.1), {"x": 3.0}) == [pytest.approx(1 / 16)]


def test_cancelling_paths_leave_no_edge():
    space = Space()
    x, y = space.sym("x"), space.sym("y")
    a = x + y
    assert jacobian([a - (x - y)], ["x"])[0][0].is_zero


def test_a_product_of_many_factors_costs_less_than_a_column_after_another():
    """One result of many variables: forward differentiation would repeat the chain for each of them."""
    space = Space()
    xs = [space.sym(f"x{i}") for i in range(12)]
    product = xs[0]
    for x in xs[1:]:
        product = product * x
    ((*row,),) = jacobian([product], [f"x{i}" for i in range(12)])
    assert len([n for n in walk(row) if n.op == "mul"]) < 4 * 12


def test_what_has_no_derivative_is_refused():
    space = Space()
    with pytest.raises(NotDifferentiable):
        jacobian([space.call("signed_slope1", space.sym("x"))], ["x"])
