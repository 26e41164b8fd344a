"""Adjoint maps that undo each other go, and exp(x) does not act on multiples of x."""

from __future__ import annotations

from codegen.ir.number import Number
from codegen.ir.operations import Adjoint, Bracket
from codegen.ir.program import Builder, Program
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes import opposites
from tests.strategies import hamiltonian_scene, same

q, mu = Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
SCENE = hamiltonian_scene("SO(3)")
HALF, WHOLE = (Coefficient(Number.rational(1, n), 1) for n in (2, 1))
MINUS = Coefficient(Number.rational(-2), 1)


def program(build):
    """The program whose new momentum is build(builder, xi, n)."""
    b = Builder({"q", "mu", "t", "h"})
    xi, n = b.hamilton("xi", "n", q, mu)
    result = build(b, xi, n)
    return verify(Program("p", (q, mu), b.take(), (("q", q), ("mu", result))))


def test_what_is_undone_at_once_is_not_done():
    def build(b, xi, n):
        g = b.exp("g", b.lin("x", Kind.ALG, [(HALF, xi)]))
        return b.adjoint("a", g, b.adjoint("b", g, n, inverse=True))

    before = program(build)
    after = verify(opposites.run(before))
    assert dict(after.outputs)["mu"] == next(a.targets[1] for a in before.assigns() if len(a.targets) == 2)
    assert same(SCENE, before, after)


def test_different_elements_do_not_undo_each_other():
    def build(b, xi, n):
        g, k = (b.exp("g", b.lin("x", Kind.ALG, [(c, xi)])) for c in (HALF, MINUS))
        return b.adjoint("a", g, b.adjoint("b", k, n, inverse=True))

    before = program(build)
    assert opposites.run(before) == before


def test_an_exponential_leaves_its_own_exponent_alone():
    def build(b, xi, n):
        g = b.exp("g", b.lin("x", Kind.ALG, [(HALF, xi)]))
        x = b.adjoint("y", g, b.lin("z", Kind.ALG, [(MINUS, xi)]))
        return b.bracket("a", x, n)

    before = program(build)
    after = verify(opposites.run(before))
    assert same(SCENE, before, after)
    reads = [a.args[0] for a in after.assigns() if isinstance(a.operation, Bracket)]
    assert [a.operation.name for a in after.assigns() if a.targets[0] in reads] == ["lin"]


def test_an_exponential_still_acts_on_other_vectors():
    def build(b, xi, n):
        g = b.exp("g", b.lin("x", Kind.ALG, [(HALF, xi)]))
        eta, _ = b.hamilton("eta", "m", q, n)
        return b.bracket("a", b.adjoint("y", g, eta), n)

    before = program(build)
    after = opposites.run(before)
    assert [a for a in after.assigns() if isinstance(a.operation, Adjoint)]
    assert after == before
