"""Momenta and forces follow from velocities, and residuals compare momenta."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import diag

from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.ir.program import Solve
from codegen.ir.values import ONE, Kind
from codegen.ir.verify import IllFormed, verify
from codegen.passes import body_frame, legendre, tearing
from codegen.passes.equivalence import Reference
from tests.strategies import full, hamiltonian_scene, lowered, same, starting, top_scene


def test_residuals_vanish_at_the_solution_and_nowhere_near_it():
    scene, before = lowered("vcg", full(2), top_scene(diag(1, 2, 3)))
    program = legendre.residuals(tearing.run(legendre.run(body_frame.run(before, scene), scene)), scene)
    (block,) = (s for s in program.body if isinstance(s, Solve))
    ends = dict(program.outputs)
    shown = replace(program, outputs=(("q", ends["q"]), ("mu", block.residuals[0])))
    d = FloatDomain(2.0**-6)
    inputs = starting(scene, d)
    assert max(map(abs, interpret(shown, scene, d, inputs)["mu"])) < 1e-13
    (wrong,) = (a for a in block.body if a.targets == (block.residuals[0],))
    doubled = replace(wrong, operation=replace(wrong.operation, coefficients=(ONE, ONE)))
    body = tuple(doubled if a is wrong else a for a in block.body)
    broken = replace(shown, body=tuple(replace(s, body=body) if s is block else s for s in shown.body))
    assert max(map(abs, interpret(broken, scene, d, inputs)["mu"])) > 1e-2


def test_a_wrong_legendre_transform_is_seen(monkeypatch):
    scene, before = lowered("vcg", "midpoint", top_scene(diag(1, 2, 3)))
    framed = body_frame.run(before, scene)
    reference = Reference(framed, scene)
    assert reference.differs(legendre.run(framed, scene)) == ""
    rows = tuple(tuple(x + x for x in row) for row in scene.body.inverse)
    monkeypatch.setitem(scene.__dict__, "body", replace(scene.body, inverse=rows))
    assert reference.differs(tearing.run(legendre.run(framed, scene)))


def test_a_block_needs_a_residual_for_each_unknown():
    scene, before = lowered("vcg", full(2), top_scene(diag(1, 2, 3)))
    program = legendre.residuals(tearing.run(legendre.run(body_frame.run(before, scene), scene)), scene)
    body = tuple(replace(s, residuals=s.residuals[:1]) if isinstance(s, Solve) else s for s in program.body)
    with pytest.raises(IllFormed, match="one residual for each unknown"):
        verify(replace(program, body=body))


def test_the_step_stays_the_same_exactly():
    scene, before = lowered("vcg", full(2), top_scene(diag(1, 2, 3)))
    framed = body_frame.run(before, scene)
    after = verify(legendre.run(framed, scene))
    assert after != framed
    assert after.counts()["legendre"] > 0
    assert same(scene, framed, after, order=3)


def test_a_scene_without_a_body_frame_is_left_alone():
    scene, before = lowered("vcg", "midpoint", hamiltonian_scene("GL(2)"))
    assert legendre.run(before, scene) is before
    assert legendre.residuals(before, scene) is before


def test_an_unknown_that_is_no_velocity_has_no_path():
    scene, before = lowered("vcg", "midpoint", top_scene(diag(1, 2, 3)))
    framed = body_frame.run(before, scene)
    (block,) = (s for s in framed.body if isinstance(s, Solve))
    found = {u.kind: legendre.path(block, u) is not None for u in block.unknowns}
    assert found == {Kind.ALG: True, Kind.DUAL: False}


def test_a_block_with_a_force_among_its_unknowns_gets_no_residuals():
    scene, before = lowered("vcg", "midpoint", top_scene(diag(1, 2, 3)))
    framed = body_frame.run(before, scene)
    assert legendre.residuals(framed, scene) == framed
