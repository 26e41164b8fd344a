from __future__ import annotations

import pytest

from codegen.ir.number import Number
from codegen.ir.program import ONE, Assign, Builder, Coefficient, Kind, Operation, Program, Var
from codegen.ir.verify import verify
from codegen.passes import fold_zeros
from tests.strategies import field_scene, full, hamiltonian_scene, lowered, same

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)


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
    operation = Operation("lin", (ONE, zero))
    made = Var("m", Kind.DUAL)

    def build(b, xi, n):
        b.body.append(Assign((made,), operation, (mu, n)))
        return made

    assert after(build).outputs == (("q", q), ("mu", mu))


def test_terms_in_one_value_are_added():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(h(1, 2), n), (ONE, mu), (h(1, 3), n)]))
    (made,) = [a for a in new.assigns() if a.operation.name == "lin"]
    assert [c.text() for c in made.operation.coefficients] == ["5/6 h", "1"]


def test_powers_of_h_are_kept_apart():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(h(1), mu), (ONE, mu)]))
    (made,) = [a for a in new.assigns() if a.operation.name == "lin"]
    assert [c.text() for c in made.operation.coefficients] == ["1 h", "1"]


def test_terms_that_cancel_go():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(ONE, mu), (h(1, 3), n), (h(-1, 3), n)]))
    assert new.outputs[1] == ("mu", mu)


def test_a_sum_that_cancels_is_zero():
    new = after(lambda b, xi, n: b.lin("m", Kind.DUAL, [(h(1), n), (h(-1), n)]))
    assert "lin" not in new.counts()
    assert new.counts()["zero"] == 1


@pytest.mark.parametrize("name", ["Adt", "Adtinv"])
def test_the_identity_moves_nothing(name):
    new = after(lambda b, xi, n: b.do(name, "m", b.do("identity", "e"), n))
    assert name not in new.counts()


def test_the_exponential_of_zero_is_the_identity():
    def build(b, xi, n):
        e = b.do("exp", "e", b.lin("x", Kind.ALG, []))
        return b.do("Adt", "m", b.do("mul", "g", e, b.do("mul", "k", q, e)), n)

    new = after(build)
    assert "exp" not in new.counts()
    assert "mul" not in new.counts()
    assert new.counts()["Adt"] == 1


def test_dexp_at_zero_does_nothing():
    new = after(lambda b, xi, n: b.do("dexpt", "m", b.lin("x", Kind.ALG, []), n))
    assert "dexpt" not in new.counts()


@pytest.mark.parametrize(("name", "first"), [("dexpt", "xi"), ("adt", "xi"), ("Adt", "q"), ("Adtinv", "q")])
def test_linear_operations_on_zero_are_zero(name, first):
    def build(b, xi, n):
        zero = b.lin("z", Kind.DUAL, [])
        return b.do(name, "m", b.lin("x", Kind.ALG, [(h(1), xi)]) if first == "xi" else q, zero)

    assert name not in after(build).counts()


def test_a_bracket_with_zero_is_zero():
    assert "adt" not in after(lambda b, xi, n: b.do("adt", "m", b.lin("x", Kind.ALG, []), n)).counts()


def test_a_stage_at_the_time_of_the_step_needs_no_time_of_its_own():
    builder = Builder({"y", "t"})
    y, t = Var("y", Kind.POINT), Var("t", Kind.REAL)
    now = builder.advance("now", t, Coefficient(Number.rational(0), 1))
    k = builder.do("fieldt", "k", y, now)
    out = builder.do("actexp", "y1", k, y)
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
    assert {k: v for k, v in removed.items() if v} == {"Adtinv": 5, "mul": 3}
