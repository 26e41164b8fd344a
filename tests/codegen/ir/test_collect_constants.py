"""Numbers are gathered: equal expressions, fewer operations, and what is kept stands as it is."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from codegen.ir.collect_constants import gathered
from codegen.ir.domain import ExprDomain, PreciseDomain
from codegen.ir.expr import evaluate, walk

D = ExprDomain()
x, y = D.space.sym("x"), D.space.sym("y")
P = PreciseDomain(0, 40)


def number(p, q=1):
    return D.rational(p, q)


def operations(roots):
    return sum(n.payload - 1 if n.op == "pow" else bool(n.args) and n.op != "neg" for n in walk(roots))


inverse = number(1) / D.call("sqrt", x + y)

CASES = {
    "nested": (number(101, 100) + number(3, 2) * (number(3, 2) - 2 * x - number(1, 5) * y),),
    "alike": (number(3, 2) * x - number(3, 2) * y - 1,),
    "power": ((number(1, 2) * x) ** 3 * (number(-4, 3) * y),),
    "gone": (number(1, 3) * (3 * x + 6 * y) - x - y,),
    "inside": (2 * D.call("sqrt", number(1) + number(1, 2) * (number(3) - number(4) * x)),),
    "inverse root": (x * (number(3, 2) * inverse**3 - 1), y * (number(3, 20) * (inverse * inverse**2) - x)),
    "fifth power": (x * (number(2) * inverse**5 + 1),),
    "negative": (-(number(1, 2) * x) - number(1, 2) * (y - 3),),
}


@pytest.mark.parametrize("roots", CASES.values(), ids=CASES)
def test_the_value_stays_and_operations_become_fewer(roots):
    found = gathered(roots)
    assert operations(found) < operations(roots)
    values = {"x": P.rational(-3, 7), "y": P.rational(5, 11)}
    for a, b in zip(evaluate(found, P, values), evaluate(roots, P, values), strict=True):
        assert abs(a - b) < 1e-38 * max(1, abs(b))


def test_an_inverse_root_is_cubed_under_the_fraction():
    other = number(1) / D.call("sqrt", x - y)
    a, b = inverse * inverse**2, (number(1, 2) * other) * other**2
    found = gathered((x * (number(3, 2) * (a - 2 * b) - 1), y * (number(3, 20) * (a + 2 * b))))
    ops = [n.op for n in walk(found)]
    assert (ops.count("div"), ops.count("call"), ops.count("pow")) == (2, 2, 0)
    numerators = [n.args[0].payload.fraction() for n in walk(found) if n.op == "div"]
    assert numerators == [Fraction(3, 2)] * 2


def test_an_inverse_root_that_is_read_itself_stays():
    roots = (x * inverse, y * inverse**3)
    assert gathered(roots) == roots


def test_what_is_kept_stays_as_it_is():
    kept = number(3) * (x + number(1, 3) * (y + number(2)))
    (found,) = gathered((number(2) * (number(5) * kept + 1),), (kept,))
    assert kept.args[1] in set(walk([found]))
    assert operations([found]) == operations([kept.args[1]]) + 2


def test_what_would_be_longer_stays():
    shared = x + number(1, 2) * y
    roots = (number(3) * shared, D.call("sin", shared) * shared)
    assert gathered(roots) == roots


def drawn(rng):
    """Some expressions that share parts, products of inverse roots among them, and one of them to be kept."""
    D = ExprDomain()
    pool = [D.space.sym(name) for name in "xy"]

    def some():
        return D.rational(rng.choice([-3, -2, -1, 1, 2, 5]), rng.randint(1, 4))

    inverses = [D.rational(1) / D.call("sqrt", D.rational(7) + some() * s) for s in pool]
    pool += [some(), *inverses]
    for _ in range(rng.randint(4, 18)):
        a, b, r = rng.choice(pool), rng.choice(pool), rng.choice(inverses)
        made = [
            a + b,
            a - b,
            a * b,
            -a,
            some() * a,
            a ** rng.randint(2, 5),
            r**3 * some(),
            (some() * r) * r**2,
        ]
        pool.append(rng.choice(made))
    return rng.sample(pool, rng.randint(1, 3)), rng.sample(pool, rng.randint(0, 1))


def test_values_stay_whatever_is_gathered_and_kept():
    values, changed = {"x": P.rational(3, 7), "y": P.rational(-5, 11)}, 0
    for seed in range(300):
        roots, kept = drawn(random.Random(seed))
        found = gathered(roots, kept)
        changed += found != tuple(roots)
        for a, b in zip(evaluate(found, P, values), evaluate(roots, P, values), strict=True):
            assert abs(a - b) < 1e-34 * max(1, abs(b))
    assert changed > 30


def test_what_is_kept_may_be_a_power_of_an_inverse_root():
    kept = inverse**3
    (found,) = gathered((x * (number(2) * (number(3) * kept**3 + number(1, 2)) - 1),), (kept,))
    assert kept in set(walk([found]))
