"""Methods by their spelling, and methods that cannot serve a scene."""

from __future__ import annotations

import pytest

from codegen import scenes
from codegen.emitter import compile_method
from codegen.errors import MethodError
from codegen.groups import LeftMultiplication, Rn
from codegen.ir.domain import ExprDomain
from codegen.kernel.translate import to_kernel
from codegen.lower import families_for, lower, lowering, names
from codegen.lower.flow_words import FlowLowering
from codegen.lower.linear import LinearLowering
from codegen.lower.variational import VariationalLowering
from codegen.method import Method, parse
from codegen.scene import FieldScene, HamiltonianScene
from orderconds.errors import InputError, TableauError, UnknownName, ZeroWeight
from orderconds.families import family_class
from orderconds.tableau import Tableau
from orderconds.tableau.library import available
from tests.strategies import butcher, field_scene, hamiltonian_scene, shipped

FIELD = ("rkmk", "cg", "cf")
ALL = ("rkmk", "cg", "cf", "vcg", "vrkmk", "vcf", "vrkmk_pade")


@pytest.mark.parametrize(
    ("spelling", "families", "label"),
    [
        ("rkmk(2):rk4", FIELD, "rkmk(2):rk4"),
        ("rkmk(0):rk4", FIELD, "rkmk(0):rk4"),
        ("rkmk:rk4", FIELD, "rkmk:rk4"),
        ("rk4", FIELD, "rkmk:rk4"),
        ("rkmk:cg4a", FIELD, "rkmk(2):cg4a"),
        ("rkmk:gauss3", FIELD, "rkmk(4):gauss3"),
        ("vrkmk(1):gauss2", ALL, "vrkmk(1):gauss2"),
        ("vrkmk:gauss2", ALL, "vrkmk(2):gauss2"),
        ("vrkmk_pade(2):gauss2", ALL, "vrkmk_pade(2):gauss2"),
        ("cg:rk4", FIELD, "cg:rk4"),
        ("vcg:triple_jump", ALL, "vcg:triple_jump"),
        (" cf4 ", FIELD, "cf:cf4"),
        ("cf4", ("vcg", "vcf", "cf"), "vcf:cf4"),
        ("cg3", FIELD, "rkmk:cg3"),
        ("cg3", ("cg", "rkmk"), "cg:cg3"),
    ],
)
def test_a_spelling_is_read(spelling, families, label):
    assert parse(spelling, families).label == label


def test_a_file_is_a_tableau(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        'name = "mine"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n[claims]\nrk = 1\ncg = 1\n', encoding="utf-8"
    )
    assert parse(f"cg:{path}", FIELD).label == "cg:mine"
    assert parse(str(path), FIELD).label == "cg:mine"


@pytest.mark.parametrize(
    ("spelling", "families", "error", "message"),
    [
        ("", FIELD, MethodError, "'' is not the name of a method"),
        (
            "vcg:midpoint",
            FIELD,
            MethodError,
            "family vcg cannot be used on this scene; expected one of rkmk, cg, cf",
        ),
        ("nosuch:midpoint", FIELD, MethodError, "family nosuch cannot be used on this scene"),
        ("cg(2):rk4", FIELD, MethodError, "the family cg has no cut-off"),
        ("vcg(1):midpoint", ALL, MethodError, "the family vcg has no cut-off"),
        ("rkmk(1):nosuch", FIELD, UnknownName, "no tableau 'nosuch'"),
        ("rk44", FIELD, UnknownName, "did you mean rk4"),
        ("nowhere.toml", FIELD, InputError, "nowhere.toml"),
        ("cf4", ("rkmk", "cg"), MethodError, "has the format cf, which these families cannot use: rkmk, cg"),
        ("vrkmk_pade:rk4", ALL, MethodError, "write vrkmk_pade(2):rk4"),
        ("rkmk:cf4", FIELD, MethodError, "has the format cf, which these families cannot use: rkmk"),
    ],
)
def test_what_cannot_be_read_is_named(spelling, families, error, message):
    with pytest.raises(error) as caught:
        parse(spelling, families)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_hints_for_scenes_of_users_name_methods_that_are_emitted():
    group = Rn(1)
    q, p = group.point("q"), group.dual("p")
    oscillator = HamiltonianScene(
        group=group, q=q, mu=p, H=(p[0] ** 2 + q[0] ** 2) / 2, q0=[1], mu0=[0], span=(0, 1)
    )
    y = group.point("y")
    decay = FieldScene(group=group, action=LeftMultiplication(), y=y, f=[-y[0]], y0=[1], span=(0, 1))
    for scene, tableaux in ((oscillator, ("magnus4",)), (decay, ("magnus4", "stormer_verlet"))):
        families = families_for(scene)
        for name in tableaux:
            hint = hint_of(name, families)
            assert hint
            compile_method(scene, hint)


PLACES = ("driven_spin", "duffing", "heavy_top", "linear_oscillator")
"""Scenes with different families."""


def hint_of(text, families):
    """Return the method that the hint of a refusal names; '' if the text names a method."""
    try:
        parse(text, families)
    except MethodError as error:
        return (error.hint or "").partition("write ")[2].removeprefix("for example ")
    return ""


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("name", ["magnus4", "strang", "stormer_verlet", "cf4", "bogacki_shampine3"])
def test_the_hint_of_a_refusal_names_a_method_that_can_be_lowered(place, name):
    scene = scenes.load(place)
    families = families_for(scene)
    for hint in {hint_of(f"{family}:{name}", families) for family in families} | {hint_of(name, families)}:
        if hint:
            lower(scene, parse(hint, families))


@pytest.mark.slow
@pytest.mark.parametrize("place", PLACES)
def test_every_hint_of_a_refusal_names_a_method_that_can_be_lowered(place):
    scene = scenes.load(place)
    families = families_for(scene)
    prefixes = ("", *(f"{family}:" for family in families))
    hints = {hint_of(prefix + name, families) for name in available() for prefix in prefixes} - {""}
    assert hints
    for hint in sorted(hints):
        lower(scene, parse(hint, families))


def refused(scene, method, error=MethodError):
    with pytest.raises(error) as caught:
        lower(scene, method)
    return str(caught.value)


def test_vcg_needs_a_hamiltonian():
    assert "the family vcg cannot be used on free_rigid_body; expected a Hamiltonian scene" in refused(
        scenes.load("free_rigid_body"), Method("vcg", shipped("midpoint"))
    )


@pytest.mark.parametrize("place", ["dipole", "free_rigid_body"])
def test_plain_runge_kutta_needs_a_vector_space(place):
    assert "expected R^n; use rkmk, cg or cf" in refused(scenes.load(place), Method("rk", shipped("rk4")))


@pytest.mark.parametrize("family", [f for f in names() if isinstance(lowering(f), VariationalLowering)])
def test_variational_families_divide_by_every_weight(family):
    cutoff = 1 if family_class(family).takes_cutoff else None
    tableau = butcher("zero", [[0, 0], ["1/2", 0]], [0, 1])
    message = refused(scenes.load("dipole"), Method(family, tableau, cutoff), ZeroWeight)
    assert "b_1 = 0" in message
    assert "non-zero" in message


def test_a_weight_that_cancels_is_zero():
    text = 'name = "x"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["sqrt(2)*sqrt(8) - 4", "1"]\n'
    assert "b_1 = 0" in refused(scenes.load("dipole"), Method("vcg", Tableau.loads(text)), ZeroWeight)


@pytest.mark.parametrize("tableau", ["gauss2", "cg4a"])
def test_the_fewest_brackets_need_an_explicit_tableau_of_exact_numbers(tableau):
    message = refused(scenes.load("free_rigid_body"), Method("rkmk", shipped(tableau)))
    assert f"rkmk:{tableau} needs a cut-off, because its tableau is implicit or its coefficients" in message
    assert "inexact; expected an explicit tableau with exact" in message


def test_vrkmk_needs_a_finite_number_of_brackets():
    message = refused(scenes.load("dipole"), Method("vrkmk", shipped("gauss2")))
    assert "needs a cut-off" in message


@pytest.mark.parametrize("family", ["rkmk", "cg", "vcg", "vrkmk"])
def test_a_commutator_free_tableau_is_no_butcher_tableau(family):
    scene = scenes.load("dipole")
    cutoff = 1 if family_class(family).takes_cutoff else None
    assert f"{family} cannot use cf4, a tableau of format cf" in refused(
        scene, Method(family, shipped("cf4"), cutoff)
    )


def test_a_family_without_lowering_is_named():
    message = refused(scenes.load("dipole"), Method("sprk", shipped("midpoint")))
    assert f"expected one of {', '.join(names())}" in message


WITH_STAGES = [
    f
    for f in names()
    if family_class(f).has_tableau and not isinstance(lowering(f), FlowLowering | LinearLowering)
]
"""The families whose methods are given by stages."""


@pytest.mark.parametrize("family", WITH_STAGES)
def test_every_lowering_serves_a_cotangent_bundle(family):
    scene = hamiltonian_scene("R^3")
    tableau = shipped("cf4" if family in ("cf", "vcf") else "heun")
    program = lower(scene, Method(family, tableau, 1 if family_class(family).takes_cutoff else None))
    paired = lowering(family).hamiltonian
    assert [name for name, _ in program.outputs] == (["q", "mu"] if paired else ["y"])


def test_a_matrix_group_without_closed_forms_calls_the_matrix_exponential():
    scene = field_scene("GL(2)")
    kernel = to_kernel(lower(scene, Method("cg", shipped("euler"))), scene)
    assert any("expm" in name for name in kernel.functions())


def test_a_nilpotent_matrix_group_can():
    scene = field_scene("Heisenberg")
    kernel = to_kernel(lower(scene, Method("cg", shipped("euler"))), scene)
    assert kernel.functions() == ()


def test_a_tableau_file_that_is_broken_is_its_own_error(tmp_path):
    path = tmp_path / "broken.toml"
    path.write_text("name = [", encoding="utf-8")
    with pytest.raises(TableauError, match=r"broken\.toml"):
        parse(f"cg:{path}", FIELD)


def test_expressions_hold_no_step_of_another_name():
    assert str(ExprDomain().h) == "h"
