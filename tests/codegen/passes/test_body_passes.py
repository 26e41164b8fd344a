"""What makes equations in the body frame small: opposites, tearing, functions of ad, common sums."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from sympy import diag

from codegen import scenes
from codegen.groups import SO3
from codegen.ir.ad_series import Factor, simplified
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.number import Number
from codegen.ir.operations import Bracket
from codegen.ir.program import Builder, Program, Solve
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.ir.verify import IllFormed, verify
from codegen.passes import body_frame, functions, legendre, opposites, shared_sums, tearing
from codegen.passes.equivalence import Reference
from tests.strategies import full, hamiltonian_scene, lowered, same, starting, top_scene

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
HALF, WHOLE = (Coefficient(Number.rational(1, n), 1) for n in (2, 1))
MINUS = Coefficient(Number.rational(-2), 1)
SCENE = hamiltonian_scene("SO(3)")
D = PreciseDomain(0, 40)


def made(build):
    """The program whose new momentum is build(builder, xi, n)."""
    b = Builder({"q", "mu", "t", "h"})
    xi, n = b.hamilton("xi", "n", q, mu)
    result = build(b, xi, n)
    return verify(Program("p", (q, mu), b.take(), (("q", q), ("mu", result))))


def counted(run, build):
    before = made(build)
    after = verify(run(before))
    assert same(SCENE, before, after)
    return after.counts()


def test_what_is_undone_at_once_is_not_done():
    def build(b, xi, n):
        g = b.exp("g", b.lin("x", Kind.ALG, [(HALF, xi)]))
        return b.adjoint("a", g, b.adjoint("b", g, n, inverse=True))

    before = made(build)
    after = verify(opposites.run(before))
    assert dict(after.outputs)["mu"] == next(a.targets[1] for a in before.assigns() if len(a.targets) == 2)
    assert same(SCENE, before, after)


def test_different_elements_do_not_undo_each_other():
    def build(b, xi, n):
        g, k = (b.exp("g", b.lin("x", Kind.ALG, [(c, xi)])) for c in (HALF, MINUS))
        return b.adjoint("a", g, b.adjoint("b", k, n, inverse=True))

    before = made(build)
    assert opposites.run(before) == before


def test_an_exponential_leaves_its_own_exponent_alone():
    def build(b, xi, n):
        g = b.exp("g", b.lin("x", Kind.ALG, [(HALF, xi)]))
        x = b.adjoint("y", g, b.lin("z", Kind.ALG, [(MINUS, xi)]))
        return b.bracket("a", x, n)

    before = made(build)
    after = verify(opposites.run(before))
    assert same(SCENE, before, after)
    reads = [a.args[0] for a in after.assigns() if isinstance(a.operation, Bracket)]
    assert [a.operation.name for a in after.assigns() if a.targets[0] in reads] == ["lin"]


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

    before = made(build)
    after = verify(functions.run(before, SCENE))
    assert same(SCENE, before, after)
    word = next(a.operation.word for a in after.assigns() if a.targets[0] == dict(after.outputs)["mu"])
    assert [f.text() for f in word] == ["exp(-1/4t)", "dexp(t)", "dexpinv2(-1/4t)"]


def test_a_group_that_does_not_know_functions_of_ad_keeps_its_operations():
    scene, before = lowered("vcg", "midpoint", hamiltonian_scene("GL(2)"))
    assert functions.run(before, scene) is before


def test_sums_in_fixed_proportions_are_mapped_once():
    def build(b, xi, n):
        x = b.lin("x", Kind.ALG, [(HALF, xi)])
        p, r = b.dual_dexp("p", x, mu), b.dual_dexp("r", x, n)
        first = b.lin("m", Kind.DUAL, [(ONE, p), (HALF, r)])
        second = b.lin("l", Kind.DUAL, [(WHOLE, p), (Coefficient(Number.rational(1, 2), 2), r)])
        return b.bracket(
            "a",
            b.lin("y", Kind.ALG, [(ONE, xi)]),
            b.lin("s", Kind.DUAL, [(ONE, first), (ONE, second)]),
        )

    def run(p):
        block = Solve("b", (Var("u", Kind.ALG),), (p.body[0].targets[0],), p.body, (p.body[0].targets[0],))
        return shared_sums.run(replace(p, body=(p.body[0], replace(block, body=p.body[1:]))))

    assert counted(run, build)["dexp*"] == 1


def test_momenta_of_all_stages_share_what_is_carried():
    scene, before = lowered("vcf", "cf4", hamiltonian_scene("SO(3)"))
    after = verify(shared_sums.run(before))
    assert after.counts()["dexp*"] < before.counts()["dexp*"]
    assert same(scene, before, after, order=3)


@pytest.mark.parametrize("family", ["vcg", "vrkmk"])
def test_tearing_removes_the_forces_once_velocities_give_them(family):
    scene, before = lowered(family, full(2), top_scene(diag(1, 2, 3)), 2 if family == "vrkmk" else None)
    framed = body_frame.run(before, scene)
    turned = verify(legendre.run(framed, scene))
    after = verify(tearing.run(turned))
    assert same(scene, before, after, order=3)
    assert all(u.kind is Kind.ALG for s in after.body if isinstance(s, Solve) for u in s.unknowns)
    kept = tearing.run(framed)  # without the transform the force of a stage hangs on its momentum
    assert any(u.kind is Kind.DUAL for s in kept.body if isinstance(s, Solve) for u in s.unknowns)


def test_an_unknown_that_depends_on_itself_is_kept():
    _, before = lowered("vcg", "midpoint", hamiltonian_scene("SO(3)"))
    (block,) = (s for s in tearing.run(before).body if isinstance(s, Solve))
    assert block.unknowns


def test_residuals_vanish_at_the_solution_and_nowhere_near_it():
    scene, before = lowered("vcg", full(2), top_scene(diag(1, 2, 3)))
    program = legendre.residuals(tearing.run(legendre.run(body_frame.run(before, scene), scene)), scene)
    (block,) = (s for s in program.body if isinstance(s, Solve))
    ends = dict(program.outputs)
    shown = replace(program, outputs=(("q", ends["q"]), ("mu", block.residuals[0])))
    d = FloatDomain(2.0**-6)
    inputs = starting(scene, d)
    assert max(map(abs, interpret(shown, scene, d, inputs)["mu"])) < 1e-13
    (wrong,) = (a for a in block.body if a.targets == (block.residuals[0],))
    doubled = replace(wrong, operation=replace(wrong.operation, coefficients=(ONE, ONE)))
    body = tuple(doubled if a is wrong else a for a in block.body)
    broken = replace(shown, body=tuple(replace(s, body=body) if s is block else s for s in shown.body))
    assert max(map(abs, interpret(broken, scene, d, inputs)["mu"])) > 1e-2


def test_a_wrong_legendre_transform_is_seen(monkeypatch):
    scene, before = lowered("vcg", "midpoint", top_scene(diag(1, 2, 3)))
    framed = body_frame.run(before, scene)
    reference = Reference(framed, scene)
    assert reference.differs(legendre.run(framed, scene)) == ""
    rows = tuple(tuple(x + x for x in row) for row in scene.body.inverse)
    monkeypatch.setitem(scene.__dict__, "body", replace(scene.body, inverse=rows))
    assert reference.differs(tearing.run(legendre.run(framed, scene)))


def test_a_block_needs_a_residual_for_each_unknown():
    scene, before = lowered("vcg", full(2), top_scene(diag(1, 2, 3)))
    program = legendre.residuals(tearing.run(legendre.run(body_frame.run(before, scene), scene)), scene)
    body = tuple(replace(s, residuals=s.residuals[:1]) if isinstance(s, Solve) else s for s in program.body)
    with pytest.raises(IllFormed, match="a residual for each unknown"):
        verify(replace(program, body=body))


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
