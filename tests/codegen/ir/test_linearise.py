"""Jacobians to first order in h: the exact one, truncated."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest

from codegen.ir.domain import SeriesDomain
from codegen.ir.expr import Space, evaluate
from codegen.ir.linearise import FirstOrder, NotLinearised
from orderconds.ring import QQ


def difference(root, unknowns, values, k):
    """The exact derivative of a polynomial by unknown k, as a series in h: by interpolation in eps."""
    d = SeriesDomain(QQ, 6)
    n = 7  # more than the degree

    def at(eps):
        moved = {name: d.rational(x) for name, x in values.items()} | {"h": d.h}
        moved[unknowns[k]] = moved[unknowns[k]] + d.rational(eps)
        return evaluate([root], d, moved)[0]

    # the derivative at 0 of the polynomial through the points 0, 1, ..., n
    total = d.rational(0)
    samples = [at(j) for j in range(n + 1)]
    differences = list(samples)
    for order in range(1, n + 1):
        differences = [b - a for a, b in pairwise(differences)]
        total = total + differences[0] * d.rational((-1) ** (order + 1), order)
    return total


def test_it_is_the_exact_jacobian_up_to_the_first_power_of_h():
    rng = random.Random(5)
    space = Space()
    h, names = space.sym("h"), ["x", "y", "z"]
    symbols = [space.sym(n) for n in names]
    for _ in range(10):
        root = space.zero
        for _ in range(5):
            term = space.coerce(rng.randint(1, 4))
            for _ in range(rng.randint(1, 4)):
                term = term * rng.choice([*symbols, h])
            root = root + term
        root = root * (symbols[0] - h) - root * h
        (row,) = FirstOrder(names).jacobian([root])
        values = {n: rng.randint(-3, 3) for n in names}
        d = SeriesDomain(QQ, 6)
        point = {n: d.rational(x) for n, x in values.items()} | {"h": d.h}
        for k, entry in enumerate(row):
            exact = difference(root, names, values, k)
            found = evaluate([entry], d, point)[0]
            assert found.coefficients[:2] == exact.coefficients[:2]
            assert all(c == 0 for c in found.coefficients[2:])


@pytest.mark.parametrize("function", ["stumpff1", "stumpff2", "stumpff3"])
def test_of_a_rotation_by_h_x_there_remains_its_first_order(function):
    space = Space()
    h, x = space.sym("h"), space.sym("x")
    root = h * x * space.call(function, h * h * x * x)
    (row,) = FirstOrder(["x"]).jacobian([root])
    weight = {"stumpff1": 1, "stumpff2": 2, "stumpff3": 6}[function]
    assert row[0] is h * (space.one / weight)


def test_roots_and_quotients_are_differentiated():
    space = Space()
    h, x = space.sym("h"), space.sym("x")
    values = {"x": 1.7, "h": 1e-4}
    root = space.call("sqrt", x + h * x * x) / (x + h)

    class Floats:
        def number(self, value):
            return float(value)

        def call(self, function, z):
            return z**0.5

    def f(x0):
        return evaluate([root], Floats(), values | {"x": x0})[0]

    slope = (f(1.7 + 1e-5) - f(1.7 - 1e-5)) / 2e-5
    (row,) = FirstOrder(["x"]).jacobian([root])
    assert abs(evaluate(row, Floats(), values)[0] - slope) < 1e-7


def test_a_pole_at_h_0_is_refused():
    space = Space()
    with pytest.raises(NotLinearised, match="divisor"):
        FirstOrder(["x"]).jacobian([space.sym("x") / space.sym("h")])
    with pytest.raises(NotLinearised, match="argument of a Stumpff function"):
        FirstOrder(["x"]).jacobian([space.call("stumpff1", space.sym("x"))])


@pytest.mark.parametrize("function", ["quotient", *(f"signed_stumpff{k}" for k in range(4))])
def test_a_function_without_an_expansion_is_refused(function):
    space = Space()
    x = space.sym("x")
    call = space.call(function, x, x + 1) if function == "quotient" else space.call(function, x)
    with pytest.raises(NotLinearised, match=f"the function {function} cannot be expanded in h"):
        FirstOrder(["x"]).jacobian([call])
