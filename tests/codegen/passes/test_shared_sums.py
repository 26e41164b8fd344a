"""A linear map is applied once to a combination that several sums share."""

from __future__ import annotations

from dataclasses import replace

from codegen.ir.number import Number
from codegen.ir.program import Builder, Program, Solve
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import shared_sums
from tests.strategies import hamiltonian_scene, lowered, same

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
SCENE = hamiltonian_scene("SO(3)")
HALF, WHOLE = (Coefficient(Number.rational(1, n), 1) for n in (2, 1))


def program(build):
    """The program whose new momentum is build(builder, xi, n)."""
    b = Builder({"q", "mu", "t", "h"})
    xi, n = b.hamilton("xi", "n", q, mu)
    result = build(b, xi, n)
    return verify(Program("p", (q, mu), b.take(), (("q", q), ("mu", result))))


def counted(run, build):
    before = program(build)
    after = verify(run(before))
    assert same(SCENE, before, after)
    return after.counts()


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


def test_outside_a_block_maps_stay():
    """There a map is evaluated once a step, and the pass for single readers has been there."""

    def build(b, xi, n):
        x = b.lin("x", Kind.ALG, [(HALF, xi)])
        p, r = b.dual_dexp("p", x, mu), b.dual_dexp("r", x, n)
        sums = [b.lin("m", Kind.DUAL, [(c, p), (HALF, r)]) for c in (HALF, HALF)]
        return b.lin("s", Kind.DUAL, [(ONE, v) for v in sums])

    before = program(build)
    assert shared_sums.run(before) is before


def test_as_many_combinations_as_values_stay():
    """Two values in two proportions: two maps of combinations would replace two maps."""

    def build(b, xi, n):
        x = b.lin("x", Kind.ALG, [(HALF, xi)])
        p, r = b.dual_dexp("p", x, mu), b.dual_dexp("r", x, n)
        sums = [b.lin("m", Kind.DUAL, [(c, p), (HALF, r)]) for c in (HALF, WHOLE)]
        return b.lin("s", Kind.DUAL, [(ONE, v) for v in sums])

    p = program(build)
    start = p.body[0].targets[0]
    block = Solve("b", (Var("u", Kind.ALG),), (start,), p.body[1:], (start,))
    before = replace(p, body=(p.body[0], block))
    assert shared_sums.run(before) is before
