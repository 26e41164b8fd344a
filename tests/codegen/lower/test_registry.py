"""The registry of lowerings: every family is asked for what the compiler needs to know of it."""

from __future__ import annotations

import pytest

from codegen import scenes
from codegen.errors import MethodError
from codegen.lower import Lowering, families_for, lowering, names, problem_for, register, unregister
from codegen.lower.field import FieldLowering
from codegen.lower.rkmk import with_cutoff
from codegen.method import Method
from tests.strategies import shipped


def test_every_lowering_is_in_a_file_with_the_name_of_its_family():
    assert [type(lowering(name)).__module__ for name in names()] == [f"codegen.lower.{n}" for n in names()]


def test_every_lowering_knows_its_own_name():
    assert [lowering(name).family for name in names()] == list(names())


def test_a_family_without_lowering_is_named_with_those_that_have_one():
    with pytest.raises(
        MethodError, match=r"the compiler does not support the family sprk; expected one of rk, rkmk, cg, cf"
    ):
        lowering("sprk")


def test_a_lowering_needs_the_name_of_a_family():
    class Nameless(FieldLowering):
        def lower(self, problem, method):
            return with_cutoff(problem, method, 0)

    with pytest.raises(MethodError, match='the class Nameless does not set the attribute "family"'):
        register(Nameless)


def test_a_family_has_one_lowering():
    class Second(FieldLowering):
        family = "vcg"

        def lower(self, problem, method):
            return with_cutoff(problem, method, 0)

    with pytest.raises(MethodError, match="Second: another class is registered for the family vcg"):
        register(Second)
    assert type(lowering("vcg")) is not Second


def test_a_built_in_lowering_stays():
    with pytest.raises(MethodError, match="the built-in family vcg cannot be removed"):
        unregister("vcg")
    assert "vcg" in names()


def test_a_class_that_does_not_lower_is_no_lowering():
    with pytest.raises(TypeError, match="abstract"):
        Lowering()


@pytest.mark.parametrize(
    ("scene", "able"),
    [
        ("free_rigid_body", ("rkmk", "cg", "cf", "discrete_gradient", "ambient")),
        ("linear_oscillator", ("vcg", "vrkmk", "vcf", "vrkmk_pade", "slgi", "rk", "rkmk", "cg", "cf")),
    ],
)
def test_variational_families_come_first_on_hamiltonian_scenes(scene, able):
    found = families_for(scenes.load(scene))
    assert tuple(family for family in found if family in able) == able
    assert found[0] == able[0]


@pytest.mark.parametrize(
    ("scene", "family", "message"),
    [
        (
            "dipole",
            "rk",
            r"rk cannot be used on dipole, whose group is T\*SO\(3\); expected R\^n; use rkmk, cg or cf",
        ),
        (
            "free_rigid_body",
            "slgi",
            "slgi cannot be used on free_rigid_body; expected a Hamiltonian scene, because",
        ),
        (
            "driven_spin",
            "discrete_gradient",
            "discrete_gradient cannot be used on driven_spin, which depends on time",
        ),
        (
            "actuated_rigid_body",
            "splitting",
            "splitting cannot be used on actuated_rigid_body, which is driven by a wrench",
        ),
    ],
)
def test_an_objection_says_what_was_found_what_is_expected_and_what_to_use(scene, family, message):
    with pytest.raises(MethodError, match=message):
        problem_for(scenes.load(scene), Method(family, shipped("midpoint")))
