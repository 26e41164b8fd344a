from __future__ import annotations

import pytest

from codegen.ir.number import Number
from codegen.ir.program import ONE, Builder, Coefficient, Kind, Program, Var
from codegen.ir.verify import verify
from codegen.passes import factor_linear
from tests.strategies import full, hamiltonian_scene, lowered, same

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
H = Coefficient(Number.rational(1, 2), 1)


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


@pytest.mark.parametrize("name", ["Adt", "Adtinv", "dexpt", "adt"])
def test_one_map_of_a_sum_replaces_a_sum_of_maps(name):
    def build(b, x, n):
        by = q if name.startswith("Ad") else x
        terms = [(ONE, b.do(name, "p", by, mu)), (H, b.do(name, "p", by, n))]
        return b.lin("m", Kind.DUAL, terms)

    assert after(build)[name] == 1


def test_nested_maps_come_out_one_after_the_other():
    def build(b, x, n):
        def moved(v):
            return b.do("dexpt", "d", x, b.do("Adtinv", "p", q, v))

        return b.lin("m", Kind.DUAL, [(ONE, moved(mu)), (H, moved(n)), (H, mu)])

    counts = after(build)
    assert counts["dexpt"] == counts["Adtinv"] == 1


def test_different_maps_stay():
    def build(b, x, n):
        y = b.lin("y", Kind.ALG, [(ONE, x), (ONE, x)])
        return b.lin("m", Kind.DUAL, [(ONE, b.do("dexpt", "p", x, mu)), (H, b.do("dexpt", "p", y, n))])

    assert after(build)["dexpt"] == 2


def test_values_with_other_uses_are_not_computed_again():
    def build(b, x, n):
        p, r = b.do("dexpt", "p", x, mu), b.do("dexpt", "r", x, n)
        total = b.lin("m", Kind.DUAL, [(ONE, p), (H, r)])
        other = b.do("Adt", "a", q, b.do("adt", "b", x, p))
        return b.lin(
            "m", Kind.DUAL, [(ONE, total), (H, other), (H, b.do("adt", "c", x, b.do("Adt", "d", q, r)))]
        )

    assert after(build)["dexpt"] == 2


@pytest.mark.parametrize("tableau", ["midpoint", "kutta3", full(2)])
def test_momenta_need_one_transport_for_each_map(tableau):
    scene, before = lowered("vcg", tableau, hamiltonian_scene("SO(3)"))
    new = verify(factor_linear.run(before))
    assert new.counts()["dexpt"] < before.counts()["dexpt"]
    assert same(scene, before, new)
