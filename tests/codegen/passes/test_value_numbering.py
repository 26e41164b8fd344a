from __future__ import annotations

import pytest

from codegen.ir.number import Number
from codegen.ir.program import Builder, Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import dead, fold_zeros, value_numbering
from tests.strategies import butcher, field_scene, full, hamiltonian_scene, lowered, same

H = Coefficient(Number.rational(1, 2), 1)


@pytest.mark.parametrize("tableau", ["kutta3", "midpoint", full(2), full(3)])
@pytest.mark.parametrize("family", ["vcg", "cg"])
def test_the_meaning_stays(family, tableau):
    scene = hamiltonian_scene("SO(3)") if family == "vcg" else field_scene("S^2")
    view, program = lowered(family, tableau, scene)
    assert same(view, program, verify(value_numbering.run(program)))


def test_no_value_is_computed_twice():
    _, program = lowered("vcg", "gauss2", hamiltonian_scene("SO(3)"))
    new = value_numbering.run(program)
    keys = [(a.operation, a.args, a.targets[0].kind) for a in new.assigns()]
    assert len(keys) == len(set(keys))


def test_exponentials_are_shared_between_stages_and_update():
    tableau = butcher("shared", [[0, 0, 0], ["1/2", 0, 0], ["1/2", "1/4", 0]], ["1/2", "1/4", "1/4"])
    scene, program = lowered("cg", tableau, field_scene("S^2"))
    new = value_numbering.run(program)
    assert program.counts()["exp"] == 6
    # exp(h k_1/2) and exp(h k_2/4) exp(h k_1/2) stand in all rows, the products too.
    assert new.counts()["exp"] == 3
    assert new.counts()["act"] == 3
    assert same(scene, program, new)


def hand_made(build):
    """A program on T*SO(3) whose momentum is what ``build`` makes of (builder, xi, n, mu)."""
    builder, q, mu = Builder({"q", "mu", "t", "h"}), Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
    xi, n = builder.hamilton("xi", "n", q, mu)
    result = build(builder, xi, n, mu)
    return verify(Program("p", (q, mu), builder.take(), (("q", q), ("mu", result))))


def test_sums_are_seen_as_equal_in_any_order():
    def build(b, xi, n, mu):
        one = b.lin("a", Kind.DUAL, [(ONE, mu), (H, n)])
        other = b.lin("b", Kind.DUAL, [(H, n), (ONE, mu)])
        return b.lin("m", Kind.DUAL, [(ONE, one), (H, other)])

    program = hand_made(build)
    new = verify(value_numbering.run(program))
    assert (program.counts()["lin"], new.counts()["lin"]) == (3, 2)
    assert same(hamiltonian_scene("SO(3)"), program, new)


def test_values_of_different_kinds_are_different():
    """The zero of the algebra is not the zero of its dual."""

    def build(b, xi, n, mu):
        x, z = b.lin("x", Kind.ALG, []), b.lin("z", Kind.DUAL, [])
        return b.lin("m", Kind.DUAL, [(ONE, b.dual_dexp("p", x, mu)), (H, z)])

    program = hand_made(build)
    assert verify(value_numbering.run(program)).counts()["zero"] == 2


def test_after_sharing_a_composition_cancels():
    _, program = lowered("vcg", "triple_jump", hamiltonian_scene("SO(3)"))
    shared = dead.run(fold_zeros.run(value_numbering.run(fold_zeros.run(program))))
    unshared = dead.run(fold_zeros.run(fold_zeros.run(program)))
    assert shared.counts()["dexp*"] < unshared.counts()["dexp*"]


def test_vcf4_shares_what_cf4_shares():
    """Stage 4 starts from stage 2: five exponentials, not six, and one product more than stages need."""
    from codegen.passes import optimise

    view, program = lowered("vcf", "cf4", hamiltonian_scene("SO(3)"))
    optimised, _ = optimise(program, view)
    assert optimised.counts()["exp"] == 5
