"""Functions of one ad in a sum are nested: the sum of the values one by one, in two brackets."""

from __future__ import annotations

from fractions import Fraction

import pytest

from codegen.emitter import compile_method
from codegen.groups import SO3
from codegen.ir.ad_series import Factor
from codegen.ir.domain import ExprDomain, PreciseDomain
from codegen.ir.expr import walk

ONE, HALF = Fraction(1), Fraction(1, 2)
WORDS = [
    (Factor("exp", -ONE), Factor("dexp", 2 * ONE)),
    (Factor("dexp", -ONE),),
    (Factor("exp", HALF),),
    (Factor("dexpinv", ONE, 4),),
]


@pytest.mark.parametrize("dual", [False, True])
def test_the_sum_is_that_of_the_values_one_by_one(dual):
    d, group = PreciseDomain(0, 40), SO3()
    x = tuple(d.rational(k, 7) for k in (3, -2, 5))
    terms = [
        (d.rational(k - 2, 3), word, tuple(d.rational(k * k - j, 5) for j in range(3)))
        for k, word in enumerate(WORDS)
    ]
    one_by_one = [tuple(f * a for a in group.series(d, word, dual, x, v)) for f, word, v in terms]
    for a, b in zip(
        group.series_sum(d, terms, dual, x), map(sum, zip(*one_by_one, strict=True)), strict=True
    ):
        assert abs(a - b) < 1e-37


def test_more_terms_take_no_more_brackets():
    def products(n):
        d, group = ExprDomain(), SO3()
        x = tuple(d.space.sym(f"x{k}") for k in range(3))
        terms = [
            (d.rational(1), WORDS[k % 2], tuple(d.space.sym(f"v{k}{j}") for j in range(3))) for k in range(n)
        ]
        return sum(node.op == "mul" for node in walk(group.series_sum(d, terms, True, x)))

    assert products(6) == products(2)


def test_the_equations_of_vcg_take_few_products():
    (loop,) = compile_method("dipole", "vcg:midpoint").kernel.loops
    work = sum(n.op in ("mul", "pow") for n in walk([let.value for let in loop.body]))
    assert work < 85


def test_equations_do_not_wait_for_sums_that_follow_them():
    """The momentum at the end of the step is a sum of the same two values as that of the stage."""
    (loop,) = compile_method("dipole", "vcg:midpoint").kernel.loops
    values = {let.name: let.value for let in loop.body}
    needed = {n.payload for n in walk(loop.images) if n.op == "sym"}
    for name in reversed(values):
        if name in needed:
            needed |= {n.payload for n in walk([values[name]]) if n.op == "sym"}
    assert {name for name in values if name.startswith("s_mu")}.isdisjoint(needed)
    assert "mu0" in needed
