from __future__ import annotations

import pytest

from codegen.ir.number import Number
from codegen.ir.operations import ActExp, Adjoint, Bracket, DualDexp, Linear
from codegen.ir.program import Assign, Builder, Program
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import fold_zeros
from tests.strategies import field_scene, full, hamiltonian_scene, lowered, same

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)


MAPS = (DualDexp(), Bracket(dual=True), Adjoint(dual=True), Adjoint(dual=True, inverse=True))


def h(p, r=1):
    return Coefficient(Number.rational(p, r), 1)


def program(build):
    """A program on T*SO(3) whose momentum is what ``build`` makes of (builder, q, mu, xi, n)."""
    builder = Builder({"q", "mu", "t", "h"})
    xi, n = builder.hamilton("xi", "n", q, mu)
    result = build(builder, xi, n)
    return verify(Program("p", (q, mu), builder.take(), (("q", q), ("mu", result))))


def after(build):
    scene = hamiltonian_scene("SO(3)")
    before = program(build)
    new = verify(fold_zeros.run(before))
    assert same(scene, before, new)
    return new


def test_zero_coefficients_go():
    zero = Coefficient(Number.rational(0), 1)
    operation = Linear((ONE, zero))
    made = Var("m", Kind.DUAL)

    def build(b, xi, n):
        b.body.append(Assign((made,), operation, (mu, n)))
        return made

    assert after(build).outputs == (("q", q), ("mu", mu))


def test_terms_in_one_value_are_added():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(h(1, 2), n), (ONE, mu), (h(1, 3), n)]))
    (made,) = [a for a in new.assigns() if isinstance(a.operation, Linear)]
    assert [c.text() for c in made.operation.coefficients] == ["5/6 h", "1"]


def test_powers_of_h_are_kept_apart():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(h(1), mu), (ONE, mu)]))
    (made,) = [a for a in new.assigns() if isinstance(a.operation, Linear)]
    assert [c.text() for c in made.operation.coefficients] == ["1 h", "1"]


def test_terms_that_cancel_go():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(ONE, mu), (h(1, 3), n), (h(-1, 3), n)]))
    assert new.outputs[1] == ("mu", mu)


def test_a_sum_that_cancels_is_zero():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(h(1), n), (h(-1), n)]))
    assert "lin" not in new.counts()
    assert new.counts()["zero"] == 1


@pytest.mark.parametrize("name", ["Ad*", "Ad*^-1"])
def test_the_identity_moves_nothing(name):
    new = after(lambda b, xi, n: b.adjoint("m", b.identity("e"), n, inverse=name == "Ad*^-1"))
    assert name not in new.counts()


def test_the_exponential_of_zero_is_the_identity():
    def build(b, xi, n):
        e = b.exp("e", b.lin("x", Kind.ALG, []))
        return b.adjoint("m", b.mul("g", e, b.mul("k", q, e)), n)

    new = after(build)
    assert "exp" not in new.counts()
    assert "mul" not in new.counts()
    assert new.counts()["Ad*"] == 1


def test_dexp_at_zero_does_nothing():
    new = after(lambda b, xi, n: b.dual_dexp("m", b.lin("x", Kind.ALG, []), n))
    assert "dexp*" not in new.counts()


@pytest.mark.parametrize("operation", MAPS, ids=lambda operation: operation.name)
def test_linear_operations_on_zero_are_zero(operation):
    def build(b, xi, n):
        zero = b.lin("z", Kind.DUAL, [])
        x = b.lin("x", Kind.ALG, [(h(1), xi)])
        return b.add(operation, "m", x if operation.signature()[0][0] is Kind.ALG else q, zero)

    assert operation.name not in after(build).counts()


def test_a_bracket_with_zero_is_zero():
    assert "ad*" not in after(lambda b, xi, n: b.bracket("m", b.lin("x", Kind.ALG, []), n)).counts()


def test_a_stage_at_the_time_of_the_step_needs_no_time_of_its_own():
    builder = Builder({"y", "t"})
    y, t = Var("y", Kind.POINT), Var("t", Kind.REAL)
    now = builder.advance("now", t, Coefficient(Number.rational(0), 1))
    k = builder.field_at("k", y, now)
    out = builder.add(ActExp(), "y1", k, y)
    before = Program("p", (y, t), builder.take(), (("y", out),))
    assert "advance" not in fold_zeros.run(verify(before)).counts()


@pytest.mark.parametrize("tableau", ["heun", "kutta3", "midpoint"])
def test_methods_keep_their_meaning(tableau):
    for scene, program in (
        lowered("vcg", tableau, hamiltonian_scene("SO(3)")),
        lowered("cg", tableau, field_scene("S^2")),
        lowered("rkmk", tableau, field_scene("GL(2)"), 1),
    ):
        new = verify(fold_zeros.run(program))
        assert sum(new.counts().values()) <= sum(program.counts().values())
        assert same(scene, program, new)


def test_a_full_tableau_has_nothing_to_remove_but_identities():
    _, program = lowered("vcg", full(2), hamiltonian_scene("SO(3)"))
    removed = {k: v - fold_zeros.run(program).counts().get(k, 0) for k, v in program.counts().items()}
    # Each of the three products starts from the identity; (e^0)^-1 and (E_j^0)^-1 move nothing in M_1.
    assert {k: v for k, v in removed.items() if v} == {"Ad*^-1": 5, "mul": 3}
