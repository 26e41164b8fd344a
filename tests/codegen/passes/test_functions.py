"""Chains of functions of one ad become one operation, and nothing else does."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from sympy import diag

from codegen import scenes
from codegen.groups import SO3
from codegen.ir.ad_series import Factor, simplified
from codegen.ir.domain import PreciseDomain
from codegen.ir.number import Number
from codegen.ir.operations import AdSeries
from codegen.ir.program import Builder, Program
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import body_frame, functions
from codegen.passes.equivalence import Reference
from tests.strategies import full, hamiltonian_scene, lowered, same, top_scene

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
SCENE = hamiltonian_scene("SO(3)")
HALF, WHOLE = (Coefficient(Number.rational(1, n), 1) for n in (2, 1))
MINUS = Coefficient(Number.rational(-2), 1)
MINUS_HALF = Coefficient(Number.rational(-1, 2), 1)
D = PreciseDomain(0, 40)


def program(build):
    """The program whose new momentum is build(builder, xi, n)."""
    b = Builder({"q", "mu", "t", "h"})
    xi, n = b.hamilton("xi", "n", q, mu)
    result = build(b, xi, n)
    return verify(Program("p", (q, mu), b.take(), (("q", q), ("mu", result))))


@pytest.mark.parametrize("power", [1, -1])
@pytest.mark.parametrize("dual", [False, True])
@pytest.mark.parametrize(
    "factors", [("exp",), ("dexp",), ("dexpinv",), ("exp", "dexp"), ("dexpinv", "exp", "dexp")]
)
def test_a_product_of_functions_of_ad_is_what_the_groups_operations_do(factors, dual, power):
    """Each factor is compared with exp, dexp and dexp^{-1} of the group; an inverse must undo it."""
    group, x = SO3(), tuple(D.rational(k, 10) for k in (7, -4, 9))
    v = tuple(D.rational(k, 7) for k in (3, 5, -2))
    word = [Factor(f, Fraction(-3, 2), 4 if f == "dexpinv" else 0, power) for f in factors]
    scaled = tuple(D.rational(-3, 2) * a for a in x)
    back = tuple(-a for a in scaled) if not dual else scaled
    expected = group.series(D, word, dual, x, v) if power < 0 else v
    for f in factors:
        if f == "exp":
            g = group.exp(D, scaled)
            expected = (group.Adt if dual else group.Ad)(D, g, expected)
        elif f == "dexp":
            expected = group.dexpt(D, scaled if dual else back, expected)  # dexp_x = dexp*_{-x} here
        else:
            expected = (group.dexpinvt if dual else group.dexpinv)(D, scaled, expected, 4)
    found = v if power < 0 else group.series(D, word, dual, x, v)
    assert all(abs(a - b) < 1e-35 for a, b in zip(found, expected, strict=True))


def test_words_cancel():
    exp, back = Factor("exp", Fraction(1)), Factor("exp", Fraction(-1))
    dexp = Factor("dexp", Fraction(1))
    assert simplified((exp, back)) == ()
    assert simplified((dexp, replace(dexp, power=-1))) == ()
    assert simplified((back, dexp)) == (Factor("dexp", Fraction(-1)),)
    assert simplified((exp, exp)) == (Factor("exp", Fraction(2)),)


def test_chains_of_functions_of_multiples_of_one_ad_become_one_operation():
    def build(b, xi, n):
        x, y = (b.lin("x", Kind.ALG, [(c, xi)]) for c in (HALF, MINUS))
        moved = b.adjoint("a", b.exp("g", x), b.dual_dexp("d", y, n))
        return b.dexpinv("e", x, moved, 2)

    before = program(build)
    after = verify(functions.run(before, SCENE))
    assert same(SCENE, before, after)
    word = next(a.operation.word for a in after.assigns() if a.targets[0] == dict(after.outputs)["mu"])
    assert [f.text() for f in word] == ["exp(-1/4t)", "dexp(t)", "dexpinv2(-1/4t)"]


def test_a_group_that_does_not_know_functions_of_ad_keeps_its_operations():
    scene, before = lowered("vcg", "midpoint", hamiltonian_scene("GL(2)"))
    assert functions.run(before, scene) is before


def test_an_element_times_an_exponential_row_by_row_is_the_product():
    group, x = SO3(), tuple(D.rational(k, 10) for k in (7, -4, 9))
    g = group.exp(D, tuple(D.rational(k, 10) for k in (-3, 8, 2)))
    expected = group.mul(D, g, group.exp(D, x))
    assert all(abs(a - b) < 1e-38 for a, b in zip(group.mulexp(D, g, x), expected, strict=True))


def test_where_the_field_reads_one_row_no_exponential_is_formed_for_it():
    scene = scenes.load("dipole")
    _, before = lowered("vrkmk", "gauss2", scene, 2)
    framed = body_frame.run(before, scene)
    after = verify(functions.rows(framed, scene))
    assert after.counts()["mulexp"] == 2
    assert Reference(framed, scene).differs(after) == ""


def test_where_the_field_reads_more_rows_products_stay():
    scene = top_scene(diag(1, 2, 3))
    _, before = lowered("vrkmk", full(2), scene, 2)
    framed = body_frame.run(before, scene)
    assert functions.rows(framed, scene) == framed


def test_functions_of_different_ads_stay_two_operations():
    def build(b, xi, n):
        eta, _ = b.hamilton("eta", "m", q, n)
        inner = b.dual_dexp("d", b.lin("x", Kind.ALG, [(HALF, xi)]), n)
        return b.dual_dexp("e", b.lin("y", Kind.ALG, [(HALF, eta)]), inner)

    before = program(build)
    after = verify(functions.run(before, SCENE))
    assert same(SCENE, before, after)
    assert sum(isinstance(a.operation, AdSeries) for a in after.assigns()) == 2


@pytest.mark.parametrize("inverse", [False, True])
def test_a_function_and_its_inverse_leave_the_value(inverse):
    def build(b, xi, n):
        x, y = (b.lin("x", Kind.ALG, [(c, xi)]) for c in (HALF, HALF if inverse else MINUS_HALF))
        inner = b.adjoint("c", b.exp("g", x), n)
        return b.adjoint("a", b.exp("k", y), inner, inverse=inverse)

    before = program(build)
    after = verify(functions.run(before, SCENE))
    assert same(SCENE, before, after)
    assert dict(after.outputs)["mu"].name == "n"


def test_the_ratio_of_two_combinations_is_rational_or_none():
    b = Builder()
    x, y = Var("x", Kind.ALG), Var("y", Kind.ALG)
    u = b.lin("u", Kind.ALG, [(HALF, x), (WHOLE, y)])
    v = b.lin("v", Kind.ALG, [(MINUS, y), (Coefficient(Number.rational(-1), 1), x)])
    w = b.lin("w", Kind.ALG, [(HALF, x), (HALF, y)])
    zero = b.lin("zero", Kind.ALG, [(WHOLE, x), (MINUS, x)])
    none = b.lin("none", Kind.ALG, [(HALF, u), (MINUS, u), (HALF, u)])
    definitions = {a.targets[0]: a for a in b.body}
    assert functions.ratio(definitions, zero, none) is None
    assert functions.ratio(definitions, v, u) == Fraction(-2)
    assert functions.ratio(definitions, w, u) is None
    assert functions.ratio(definitions, x, u) is None
