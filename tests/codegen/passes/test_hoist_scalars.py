"""Numbers stand outside of linear maps, sums are flat, and terms in proportion are added once."""

from __future__ import annotations

from sympy import diag

from codegen.ir.number import Number
from codegen.ir.operations import Linear
from codegen.ir.program import Builder, Program, Solve
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import hoist_scalars, optimise
from tests.strategies import full, hamiltonian_scene, lowered, same, top_scene

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
HALF = Coefficient(Number.rational(1, 2), 1)
SCENE = hamiltonian_scene("SO(3)")


def made(build):
    b = Builder({"q", "mu", "t", "h"})
    xi, n = b.hamilton("xi", "n", q, mu)
    result = build(b, xi, n)
    return verify(Program("p", (q, mu), b.take(), (("q", q), ("mu", result))))


def test_a_factor_of_a_maps_argument_joins_the_sum_that_reads_it():
    def build(b, xi, n):
        scaled = b.lin("s", Kind.DUAL, [(HALF, n)])
        return b.lin("m", Kind.DUAL, [(ONE, mu), (HALF, b.adjoint("a", q, scaled))])

    before = made(build)
    after = verify(hoist_scalars.run(before))
    assert same(SCENE, before, after)
    (total,) = (a for a in after.assigns() if isinstance(a.operation, Linear))
    assert [c.power for c in total.operation.coefficients] == [0, 2]


def test_a_sum_that_nothing_else_reads_becomes_part_of_its_reader():
    def build(b, xi, n):
        inner = b.lin("s", Kind.DUAL, [(ONE, mu), (HALF, n)])
        return b.lin("m", Kind.DUAL, [(HALF, inner), (HALF, n)])

    before = made(build)
    after = verify(hoist_scalars.run(before))
    assert same(SCENE, before, after)
    assert after.counts()["lin"] == 1


def test_terms_in_one_proportion_are_added_once_for_all_sums():
    scene, before = lowered("vrkmk", "gauss2", top_scene(diag(1, 2, 3)), 2)
    program, trace = optimise(before, scene, framed=True)
    assert "numbers outside maps" in [report.name for report in trace]
    (block,) = (s for s in program.body if isinstance(s, Solve))
    shared = [a.targets[0] for a in block.body if a.targets[0].name.startswith("sum_")]
    assert len(shared) == 2
    for total in shared:
        assert sum(total in a.args for a in block.body) == 2


def test_the_step_stays_the_same_exactly():
    scene, before = lowered("vcg", full(2), top_scene(diag(1, 2, 3)))
    assert same(scene, before, verify(hoist_scalars.run(before)), order=3)
