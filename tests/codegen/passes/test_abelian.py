from __future__ import annotations

import pytest

from codegen.ir.verify import verify
from codegen.passes import abelian
from tests.strategies import field_scene, full, hamiltonian_scene, lowered, same

BRACKETS = {"dexpinv", "ad", "ad*", "Ad", "Ad*", "Ad*^-1", "dexp*", "dexpinv*", "P*"}


@pytest.mark.parametrize("cutoff", [0, 1, 2, 4])
def test_on_a_vector_space_no_bracket_stays(cutoff):
    scene, program = lowered("rkmk", full(2), field_scene("R^3"), cutoff)
    after = verify(abelian.run(program, abelian=True))
    assert not BRACKETS & set(after.counts())
    assert same(scene, program, after)


def test_on_its_cotangent_bundle_neither():
    scene, program = lowered("vcg", full(2), hamiltonian_scene("R^3"))
    after = verify(abelian.run(program, abelian=True))
    assert not BRACKETS & set(after.counts())
    assert same(scene, program, after)


@pytest.mark.parametrize("cutoff", [0, 2])
def test_vrkmk_loses_its_multipliers(cutoff):
    scene, program = lowered("vrkmk", full(2), hamiltonian_scene("R^3"), cutoff)
    after = verify(abelian.run(program, abelian=True))
    assert not BRACKETS & set(after.counts())
    assert same(scene, program, after)


def test_cut_off_at_zero_vrkmk_has_no_derivative_of_dexpinv():
    scene, program = lowered("vrkmk", full(2), hamiltonian_scene("SO(3)"), 0)
    after = verify(abelian.run(program, abelian=False))
    assert not {"dexpinv", "dexpinv*", "P*"} & set(after.counts())
    assert "dexp*" in after.counts()
    assert same(scene, program, after)


def test_elsewhere_only_a_cut_off_at_zero_vanishes():
    scene, program = lowered("rkmk", full(2), field_scene("S^2"), 0)
    after = verify(abelian.run(program, abelian=False))
    assert program.counts()["dexpinv"] == 2
    assert "dexpinv" not in after.counts()
    assert same(scene, program, after)


def test_elsewhere_brackets_stay():
    _, program = lowered("rkmk", full(2), field_scene("S^2"), 1)
    assert abelian.run(program, abelian=False) == program


def test_on_another_group_it_would_be_wrong():
    scene, program = lowered("rkmk", full(2), field_scene("S^2"), 1)
    assert not same(scene, program, abelian.run(program, abelian=True))
