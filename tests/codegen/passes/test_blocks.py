from __future__ import annotations

from dataclasses import replace

import pytest

from codegen.ir.operations import ActExp
from codegen.ir.program import Assign, Solve
from codegen.ir.scene_operations import Field
from codegen.ir.values import Kind, Var
from codegen.ir.verify import verify
from codegen.passes import blocks, dead, fold_zeros, optimise, value_numbering
from tests.strategies import butcher, field_scene, full, hamiltonian_scene, lowered, same, shipped


def solved(program):
    """The unknowns of each block."""
    return [[v.name for v in s.unknowns] for s in program.body if isinstance(s, Solve)]


def prepared(program):
    return dead.run(fold_zeros.run(value_numbering.run(fold_zeros.run(program))))


@pytest.mark.parametrize(("family", "cutoff"), [("cg", None), ("cf", None), ("rkmk", 2)])
@pytest.mark.parametrize("tableau", ["euler", "heun", "kutta3", "rk4", "cg3"])
def test_explicit_methods_lose_their_solver(family, cutoff, tableau):
    scene, program = lowered(family, tableau, field_scene("S^2"), cutoff)
    new = verify(blocks.run(prepared(program)))
    assert solved(new) == []
    assert same(scene, program, new)


def test_a_diagonally_implicit_method_is_solved_stage_by_stage():
    tableau = butcher("dirk", [["1/4", 0], ["1/2", "1/4"]], ["1/2", "1/2"])
    scene, program = lowered("rkmk", tableau, field_scene("S^2"), 1)
    new = verify(blocks.run(prepared(program)))
    assert solved(new) == [["v1"], ["v2"]]
    assert same(scene, program, new)


def test_a_fully_implicit_method_stays_one_block():
    scene, program = lowered("rkmk", full(3), field_scene("S^2"), 1)
    new = verify(blocks.run(prepared(program)))
    assert solved(new) == [["v1", "v2", "v3"]]
    assert same(scene, program, new)


def test_implicit_stages_after_an_explicit_one_are_solved_alone():
    A = [[0, 0, 0], ["1/4", "1/4", "1/3"], ["1/4", "1/2", "1/4"]]
    tableau = butcher("mixed", A, ["1/6", "1/3", "1/2"])
    scene, program = lowered("cg", tableau, field_scene("GL(2)"))
    new = verify(blocks.run(prepared(program)))
    assert solved(new) == [["k2", "k3"]]
    assert same(scene, program, new)


@pytest.mark.parametrize("tableau", ["triple_jump", "suzuki4", "yoshida6"])
def test_a_composition_makes_vcg_sequential(tableau):
    """Lemma 3.5.4: the terms of the later stages cancel; exactly, or by the spelling of equal balls."""
    _, program = lowered("vcg", tableau, hamiltonian_scene("SO(3)"))
    new = verify(blocks.run(prepared(program)))
    stages = len(shipped(tableau).method.gamma)
    assert solved(new) == [[f"xi{i}", f"n{i}"] for i in range(1, stages + 1)]


def test_a_composition_keeps_its_meaning_exactly():
    third = butcher("thirds", [["1/4", 0], ["1/2", "1/4"]], ["1/2", "1/2"])
    scene, program = lowered("vcg", third, hamiltonian_scene("GL(2)"))
    new = verify(blocks.run(prepared(program)))
    assert len(solved(new)) == 2
    assert same(scene, program, new)


def test_another_explicit_tableau_leaves_vcg_coupled():
    _, program = lowered("vcg", "kutta3", hamiltonian_scene("SO(3)"))
    assert len(solved(blocks.run(prepared(program)))) == 1


def hand_made(images, starts=("k0", "k0")):
    """Two unknowns v, w with given images, on the sphere."""
    y, y1 = Var("y", Kind.POINT), Var("y1", Kind.POINT)
    k0, v, w, f = (Var(name, Kind.ALG) for name in ("k0", "v", "w", "f"))
    named = {x.name: x for x in (k0, v, w, f)}
    inside = (Assign((y1,), ActExp(), (v, y)), Assign((f,), Field(), (y1,)))
    block = Solve("b", (v, w), tuple(named[s] for s in starts), inside, tuple(named[name] for name in images))
    out = Var("y2", Kind.POINT)
    body = (Assign((k0,), Field(), (y,)), block, Assign((out,), ActExp(), (w, y1)))
    scene, template = lowered("cg", "euler", field_scene("S^2"))
    return scene, verify(replace(template, body=body, outputs=(("y", out),)))


def test_an_image_that_is_another_unknown_is_followed():
    _, program = hand_made(("w", "f"))  # v = w, w = field(exp(v) y): a cycle through v
    assert solved(verify(blocks.run(program))) == [["v"]]
    assert solved(verify(blocks.run(hand_made(("f", "v"))[1]))) == [["v"]]


def test_an_image_known_before_the_block_needs_no_block():
    _, program = hand_made(("k0", "f"))
    assert solved(verify(blocks.run(program))) == []


def test_an_unknown_that_must_equal_itself_stays_at_its_start():
    _, program = hand_made(("v", "f"))
    new = verify(blocks.run(program))
    assert solved(new) == []
    (first,) = [a for a in new.assigns() if a.targets[0].name == "y1"]
    assert first.args[0].name == "k0"


def test_splitting_again_changes_nothing():
    _, program = lowered("vcg", "suzuki4", hamiltonian_scene("SO(3)"))
    once = blocks.run(prepared(program))
    assert blocks.run(once) == once


def test_on_a_vector_space_vrkmk_of_a_composition_is_solved_stage_by_stage():
    """There the multipliers' terms cancel, and SPRK of a composition is a sequence of midpoints."""
    view, program = lowered("vrkmk", "triple_jump", hamiltonian_scene("R^3"), 2)
    optimised, _ = optimise(program, view)
    assert [len(s.unknowns) for s in optimised.body if isinstance(s, Solve)] == [2, 2, 2]


def test_explicit_vrkmk_needs_one_momentum_for_all_stages():
    view, program = lowered("vrkmk", "kutta3", hamiltonian_scene("SO(3)"), 1)
    optimised, _ = optimise(program, view)
    (block,) = (s for s in optimised.body if isinstance(s, Solve))
    assert [v.name for v in block.unknowns] == ["v1", "v2", "Lambda"]


def test_vcf_of_a_composition_is_solved_stage_by_stage_like_vcg():
    blocks_of = []
    for family in ("vcf", "vcg"):
        view, program = lowered(family, "triple_jump", hamiltonian_scene("SO(3)"))
        blocks_of.append([len(s.unknowns) for s in optimise(program, view)[0].body if isinstance(s, Solve)])
    assert blocks_of == [[2, 2, 2]] * 2
