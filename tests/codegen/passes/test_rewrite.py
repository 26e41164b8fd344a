"""The traversal that local passes share: names are replaced everywhere, and readers are counted."""

from __future__ import annotations

from codegen.ir.number import Number
from codegen.ir.operations import Linear
from codegen.ir.program import Assign, Builder, Program, Solve
from codegen.ir.values import ONE, Coefficient, Kind, Var
from codegen.ir.verify import verify
from codegen.passes.rewrite import defined, rewrite, uses
from tests.strategies import hamiltonian_scene, lowered, same

H = Coefficient(Number.rational(1), 1)
x, y = Var("x", Kind.ALG), Var("y", Kind.ALG)


def without_copies(rewriter, assign):
    if assign.is_multiple and assign.terms[0][0].is_one:
        return assign.args
    return rewriter.emit(assign)


def in_a_block():
    """A block u = c + h u whose start, body and image read copies."""
    u, a, b, c, image, last = (Var(name, Kind.ALG) for name in ("u", "a", "b", "c", "image", "last"))
    copy = [Assign((v,), Linear((ONE,)), (w,)) for v, w in ((a, x), (b, a), (c, b), (last, image))]
    total = Assign((image,), Linear((ONE, H)), (c, u))
    block = Solve("b", (u,), (b,), (copy[2], total, copy[3]), (last,))
    return verify(Program("p", (x,), (copy[0], copy[1], block), (("x", u),))), u, image


def test_a_rule_that_emits_everything_changes_nothing():
    _, program = lowered("vcg", "gauss2", hamiltonian_scene("SO(3)"))
    assert rewrite(program, lambda rewriter, assign: rewriter.emit(assign)) == program


def test_a_replaced_value_is_replaced_in_every_reader():
    before, u, image = in_a_block()
    after = verify(rewrite(before, without_copies))
    (block,) = after.body
    assert block.starts == (x,)
    assert [a.args for a in block.body] == [(x, u)]
    assert (block.images, after.outputs) == ((image,), (("x", u),))


def test_a_rule_sees_definitions_that_came_before_it_and_no_others():
    seen = []

    def rule(rewriter, assign):
        seen.append([v.name for v in rewriter.definitions])
        return rewriter.emit(assign)

    before, _, _ = in_a_block()
    rewrite(before, rule)
    assert seen == [[], ["a"], ["a", "b"], ["a", "b", "c"], ["a", "b", "c", "image"]]


def test_starts_images_and_outputs_count_as_readers():
    before, _, _ = in_a_block()
    count = {v.name: n for v, n in uses(before).items()}
    assert count == {"x": 1, "a": 1, "b": 2, "c": 1, "u": 2, "image": 1, "last": 1}


def test_every_variable_is_named_once():
    before, _, _ = in_a_block()
    assert sorted(v.name for v in defined(before)) == ["a", "b", "c", "image", "last", "u", "x"]


def test_fresh_names_differ_from_those_of_statements_to_come():
    def rule(rewriter, assign):
        target = rewriter.builder.fresh("image", Kind.ALG)
        assert target.name != "image"
        return rewriter.emit(assign)

    rewrite(in_a_block()[0], rule)


def test_the_step_stays_the_same_where_values_are_replaced_by_equal_ones():
    b, q, mu = Builder({"q", "mu", "t", "h"}), Var("q", Kind.GROUP), Var("mu", Kind.DUAL)
    _, n = b.hamilton("xi", "n", q, mu)
    copy = b.lin("c", Kind.DUAL, [(ONE, n)])
    new = b.lin("m", Kind.DUAL, [(ONE, mu), (H, copy)])
    last = b.lin("l", Kind.DUAL, [(ONE, new)])
    before = verify(Program("p", (q, mu), b.take(), (("q", q), ("mu", last))))
    after = verify(rewrite(before, without_copies))
    assert len(list(after.assigns())) == len(list(before.assigns())) - 2
    assert same(hamiltonian_scene("SO(3)"), before, after)
