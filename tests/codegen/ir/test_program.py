from __future__ import annotations

from codegen.ir.number import Number
from codegen.ir.operations import Zero
from codegen.ir.program import Builder
from codegen.ir.values import Coefficient, Kind, Var
from codegen.lower import lower
from codegen.method import Method
from tests.strategies import field_scene, hamiltonian_scene, shipped


def test_a_builder_gives_fresh_names():
    builder = Builder({"y"})
    names = [builder.fresh("x", Kind.ALG).name for _ in range(3)] + [builder.fresh("y", Kind.POINT).name]
    assert names == ["x", "x_2", "x_3", "y_2"]


def test_a_sum_without_terms_is_zero():
    builder = Builder()
    k = Var("k", Kind.ALG)
    builder.lin("x", Kind.ALG, [(Coefficient(Number.rational(0), 1), k)])
    (assign,) = builder.take()
    assert isinstance(assign.operation, Zero)
    assert assign.args == ()


def test_the_text_of_a_program_is_what_people_write():
    program = lower(field_scene("S^2"), Method("rkmk", shipped("heun"), 1))
    assert program.text() == (
        "rkmk(1):heun(y: Point)\n"
        "  k0 = field(y)\n"
        "  solve stages: v1 from k0, v2 from k0\n"
        "    u1 = zero()\n"
        "    g1 = exp(u1)\n"
        "    Y1 = act(g1, y)\n"
        "    k1 = field(Y1)\n"
        "    w1 = dexpinv(1)(u1, k1)\n"
        "    u2 = (1 h) v1\n"
        "    g2 = exp(u2)\n"
        "    Y2 = act(g2, y)\n"
        "    k2 = field(Y2)\n"
        "    w2 = dexpinv(1)(u2, k2)\n"
        "    until v1 = w1, v2 = w2\n"
        "  u = (1/2 h) v1 + (1/2 h) v2\n"
        "  g = exp(u)\n"
        "  y1 = act(g, y)\n"
        "  y' = y1\n"
    )


def test_times_of_stages_are_advanced_from_t():
    text = lower(hamiltonian_scene("SO(3)", time=True), Method("vcg", shipped("midpoint"))).text()
    assert "t_stage = advance(t, 1/2 h)" in text
    assert "hamilton(q, mu, t)" in text


def test_counts_name_each_operation():
    program = lower(field_scene("S^2"), Method("cg", shipped("euler")))
    assert program.counts() == {"act": 1, "exp": 1, "field": 2, "lin": 1}
