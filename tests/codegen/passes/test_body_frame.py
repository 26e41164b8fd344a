"""The body frame: the same step, which needs of q what the body's field needs."""

from __future__ import annotations

import pytest
from sympy import diag

from codegen import scenes
from codegen.ir.program import Solve
from codegen.ir.values import Kind
from codegen.ir.verify import verify
from codegen.lower import lower, problem_for
from codegen.method import parse
from codegen.passes import body_frame, optimise
from tests.strategies import full, full_exponentials, hamiltonian_scene, lowered, same, top_scene

METHODS = [("vcg", full(2), None), ("vrkmk", full(2), 2), ("vcf", full_exponentials(2), None)]
METHODS += [("vrkmk_pade", full(1), 2), ("vcg", "kutta3", None)]


@pytest.mark.parametrize(("family", "tableau", "cutoff"), METHODS, ids=lambda x: str(getattr(x, "name", x)))
@pytest.mark.parametrize("body", [True, False], ids=["body", "space"])
def test_a_program_in_the_body_frame_is_the_same_step_exactly(family, tableau, cutoff, body):
    scene, before = lowered(family, tableau, top_scene(diag(1, 2, 3), body=body), cutoff)
    after = verify(body_frame.run(before, scene))
    assert "hamilton" not in after.counts()
    assert same(scene, before, after, order=3)


def test_a_scene_that_depends_on_time_is_framed_too():
    scene, before = lowered("vcg", "midpoint", hamiltonian_scene("SO(3)", time=True))
    after = verify(body_frame.run(before, scene))
    assert {"velocity", "force"} <= set(after.counts())
    assert same(scene, before, after, order=3)


def test_a_group_without_a_body_frame_is_left_alone():
    scene, before = lowered("vcg", "midpoint", hamiltonian_scene("GL(2)"))
    assert body_frame.run(before, scene) is before


def test_field_programs_are_left_alone():
    scene = scenes.load("free_rigid_body")
    method = parse("rkmk:rk4", ("rkmk",))
    program = lower(scene, method)
    assert body_frame.run(program, problem_for(scene, method)) is program


@pytest.mark.parametrize(
    ("method", "unknowns"), [("vcg:midpoint", 1), ("vrkmk(2):gauss2", 2), ("vcf:cf4", 4), ("vcg:kahan", 3)]
)
def test_every_stage_has_one_unknown_a_velocity_and_a_momentum_to_compare(method, unknowns):
    scene = scenes.load("dipole")
    made = parse(method, ("vcg", "vrkmk", "vcf"))
    program, _ = optimise(lower(scene, made), problem_for(scene, made), framed=True)
    (block,) = (s for s in program.body if isinstance(s, Solve))
    assert [u.kind for u in block.unknowns] == [Kind.ALG] * unknowns
    assert [r.kind for r in block.residuals] == [Kind.DUAL] * unknowns


def test_a_composition_stays_sequential_in_the_body_frame():
    scene = scenes.load("dipole")
    made = parse("vcg:triple_jump", ("vcg",))
    program, _ = optimise(lower(scene, made), problem_for(scene, made), framed=True)
    assert [len(s.unknowns) for s in program.body if isinstance(s, Solve)] == [1, 1, 1]


@pytest.mark.parametrize(("family", "tableau", "cutoff"), METHODS, ids=lambda x: str(getattr(x, "name", x)))
def test_all_passes_together_keep_the_step_exactly(family, tableau, cutoff):
    scene, before = lowered(family, tableau, top_scene(diag(1, 2, 3)), cutoff)
    after, _ = optimise(before, scene, framed=True)
    assert same(scene, before, after, order=3)
