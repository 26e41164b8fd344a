"""Unknowns that the others determine are computed, and no cycle arises."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import diag

from codegen.ir.operations import Bracket
from codegen.ir.program import Assign, Solve
from codegen.ir.values import Kind, Var
from codegen.ir.verify import verify
from codegen.passes import body_frame, legendre, tearing
from tests.strategies import full, hamiltonian_scene, lowered, same, top_scene


@pytest.mark.parametrize("family", ["vcg", "vrkmk"])
def test_tearing_removes_the_forces_once_velocities_give_them(family):
    scene, before = lowered(family, full(2), top_scene(diag(1, 2, 3)), 2 if family == "vrkmk" else None)
    framed = body_frame.run(before, scene)
    turned = verify(legendre.run(framed, scene))
    after = verify(tearing.run(turned))
    assert same(scene, before, after, order=3)
    assert all(u.kind is Kind.ALG for s in after.body if isinstance(s, Solve) for u in s.unknowns)
    kept = tearing.run(framed)  # without the transform the force of a stage hangs on its momentum
    assert any(u.kind is Kind.DUAL for s in kept.body if isinstance(s, Solve) for u in s.unknowns)


def test_an_unknown_that_depends_on_itself_is_kept():
    _, before = lowered("vcg", "midpoint", hamiltonian_scene("SO(3)"))
    (block,) = (s for s in tearing.run(before).body if isinstance(s, Solve))
    assert block.unknowns


x, y, z = (Var(name, Kind.ALG) for name in "xyz")
FIRST = Assign((y,), Bracket(), (x, x))
SECOND = Assign((z,), Bracket(), (y, x))


def test_assignments_are_put_in_order():
    assert tearing.ordered((SECOND, FIRST)) == (FIRST, SECOND)


def test_an_order_that_is_right_is_kept():
    other = Assign((Var("w", Kind.ALG),), Bracket(), (x, x))
    assert tearing.ordered((FIRST, other, SECOND)) == (FIRST, other, SECOND)


def test_a_cycle_has_no_order():
    assert tearing.ordered((SECOND, replace(FIRST, args=(z, x)))) is None


def test_tearing_again_changes_nothing():
    scene, before = lowered("vcg", full(2), top_scene(diag(1, 2, 3)))
    once = tearing.run(legendre.run(body_frame.run(before, scene), scene))
    assert tearing.run(once) == once
