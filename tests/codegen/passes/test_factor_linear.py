from __future__ import annotations

import pytest

from codegen.ir.number import Number
from codegen.ir.operations import Adjoint, Bracket, DualDexp
from codegen.ir.program import Builder, Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import factor_linear
from tests.strategies import full, hamiltonian_scene, lowered, same

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
H = Coefficient(Number.rational(1, 2), 1)

MAPS = (Adjoint(dual=True), Adjoint(dual=True, inverse=True), DualDexp(), Bracket(dual=True))


def program(build):
    builder = Builder({"q", "mu", "t", "h"})
    xi, n = builder.hamilton("xi", "n", q, mu)
    result = build(builder, builder.lin("x", Kind.ALG, [(H, xi)]), n)
    return verify(Program("p", (q, mu), builder.take(), (("q", q), ("mu", result))))


def after(build):
    before = program(build)
    new = verify(factor_linear.run(before))
    assert same(hamiltonian_scene("SO(3)"), before, new)
    return new.counts()


@pytest.mark.parametrize("operation", MAPS, ids=lambda operation: operation.name)
def test_one_map_of_a_sum_replaces_a_sum_of_maps(operation):
    def build(b, x, n):
        by = x if operation.signature()[0][0] is Kind.ALG else q
        terms = [(ONE, b.add(operation, "p", by, mu)), (H, b.add(operation, "p", by, n))]
        return b.lin("m", Kind.DUAL, terms)

    assert after(build)[operation.name] == 1


def test_nested_maps_come_out_one_after_the_other():
    def build(b, x, n):
        def moved(v):
            return b.dual_dexp("d", x, b.adjoint("p", q, v, inverse=True))

        return b.lin("m", Kind.DUAL, [(ONE, moved(mu)), (H, moved(n)), (H, mu)])

    counts = after(build)
    assert counts["dexp*"] == counts["Ad*^-1"] == 1


def test_different_maps_stay():
    def build(b, x, n):
        y = b.lin("y", Kind.ALG, [(ONE, x), (ONE, x)])
        return b.lin("m", Kind.DUAL, [(ONE, b.dual_dexp("p", x, mu)), (H, b.dual_dexp("p", y, n))])

    assert after(build)["dexp*"] == 2


def test_values_with_other_uses_are_not_computed_again():
    def build(b, x, n):
        p, r = b.dual_dexp("p", x, mu), b.dual_dexp("r", x, n)
        total = b.lin("m", Kind.DUAL, [(ONE, p), (H, r)])
        other = b.adjoint("a", q, b.bracket("b", x, p))
        return b.lin("m", Kind.DUAL, [(ONE, total), (H, other), (H, b.bracket("c", x, b.adjoint("d", q, r)))])

    assert after(build)["dexp*"] == 2


@pytest.mark.parametrize("tableau", ["midpoint", "kutta3", full(2)])
def test_momenta_need_one_transport_for_each_map(tableau):
    scene, before = lowered("vcg", tableau, hamiltonian_scene("SO(3)"))
    new = verify(factor_linear.run(before))
    assert new.counts()["dexp*"] < before.counts()["dexp*"]
    assert same(scene, before, new)
