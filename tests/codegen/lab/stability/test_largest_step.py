"""The largest usable step is sharp, and its reason is what fails one step below."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from click.testing import CliRunner
from sympy import Matrix, Rational, symbols

from codegen import scenes
from codegen.commands.stability import command
from codegen.emitter import compile_method
from codegen.groups import LeftMultiplication, Rn
from codegen.lab.default_methods import methods_for
from codegen.lab.reference import cached_reference
from codegen.lab.runner import Emitted
from codegen.lab.stability import largest_step as limits
from codegen.lab.stability.endurance import Endurance, endure
from codegen.lab.stability.largest_step import largest_step
from codegen.lab.stability.linear_stability import region
from codegen.lab.stability.order_reduction import order_reduction
from codegen.scene import FieldScene
from codegen.scenes import stiff_variants
from codegen.scenes.free_rigid_body import thin_body


def method(scene, spelling):
    (found,) = methods_for(scenes.load(scene), [spelling])
    return found


@pytest.mark.parametrize(
    ("scene", "spelling", "reason"),
    [("dipole", "vcg:triple_jump", "converge"), ("free_rigid_body", "rkmk(0):euler", "a tenth")],
)
def test_one_step_fewer_is_not_usable(scene, spelling, reason):
    made, exact = compile_method(scene, spelling), cached_reference(scenes.load(scene))
    runner = Emitted(made, "c")
    found = largest_step(made, runner, exact)
    assert found.steps is not None
    assert limits._failure(made, runner, exact, found.steps) is None
    assert limits._failure(made, runner, exact, found.steps - 1) == found.reason
    assert reason in found.reason


@pytest.mark.parametrize(
    ("spelling", "real", "imaginary"),
    [
        ("rkmk:rk4", 2.785293563405282, 2 * math.sqrt(2)),
        ("rkmk(0):euler", 2.0, 0.0),
        ("rkmk(0):midpoint", math.inf, math.inf),
        ("rkmk(1):kutta3", 2.512745326618329, math.sqrt(3)),
        ("rkmk(3):radau2a2", math.inf, math.inf),
    ],
)
def test_stability_intervals_are_the_known_ones(spelling, real, imaginary):
    """Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.2."""
    found = region(method("free_rigid_body", spelling))
    assert found is not None
    assert found.real == pytest.approx(real, abs=1e-6)
    assert found.imaginary == pytest.approx(imaginary, abs=1e-4)


def test_order_is_lost_on_a_thin_body_and_kept_by_nothing_that_is_resolved():
    thin = thin_body(10**6)
    left = order_reduction(thin, method("free_rigid_body", "cf:cf4"), cached_reference(thin.scene))
    assert left.stated == 4
    assert "order reduction from 4 to" in left.verdict
    gentle = thin_body(10)
    kept = order_reduction(gentle, method("free_rigid_body", "cf:cf4"), cached_reference(gentle.scene))
    assert "order reduction" not in kept.verdict


def test_the_stiff_spin_answers_at_every_step_size():
    """Explicit methods find the solution where h times 2000 is near one; a tenth of the span shows it."""
    (thin,) = stiff_variants(scenes.load("stiff_driven_spin"))
    thin = replace(thin, scene=replace(thin.scene, span=(0, Fraction(1, 10))))
    left = order_reduction(thin, method("driven_spin", "rkmk:rk4"), cached_reference(thin.scene))
    assert len(left.runs) > 10
    assert all(error is not None or "finite" in why for _, error, why in left.runs)
    usable = [h for h, error, _ in left.runs if error is not None and error < 1e-3]
    assert 0.5 < 2000 * max(usable) < 20


def test_many_steps_keep_the_manifold_and_a_status_ends_those_that_do_not(monkeypatch):
    monkeypatch.setattr("codegen.lab.stability.endurance.MANY", 100_000)
    monkeypatch.setattr("codegen.lab.stability.endurance.BACK", 1000)
    made = compile_method("dipole", "cf:cf4")
    forward, back = endure(made, Emitted(made, "c"))
    assert forward.held
    assert forward.defect is not None
    assert forward.defect < 1e-11
    assert back.returned is not None
    ambient = compile_method("dipole", "ambient:rk4")
    off, _ = endure(ambient, Emitted(ambient, "c"))
    assert off.failure or not off.held, "a classical method leaves the manifold by its error"


def test_a_run_off_the_manifold_does_not_hold():
    assert not Endurance("forward", 1000, 1e-6, None).held
    assert Endurance("forward", 1000, 1e-14, None).held
    assert Endurance("forward and back", 1000, None, 1e-3).held
    assert not Endurance("forward and back", 1000, None, math.inf).held
    assert Endurance("forward", 3, None, None, "step 4: the new state is not finite").held


def test_the_command_prints_its_tables_and_needs_one_scene():
    done = CliRunner().invoke(command, ["free_rigid_body", "-m", "cf:cf4", "--quick"], standalone_mode=False)
    assert done.exception is None
    assert done.return_value == 0
    for word in ("largest usable step", "angle pi", "accurate", "inertia ratio 1e+06"):
        assert word in done.output
    assert CliRunner().invoke(command, ["dipole", "--all"]).exit_code == 2
    assert CliRunner().invoke(command, []).exit_code == 2


def test_the_dipole_passes_the_charge_at_the_distance_that_its_scene_gives():
    """The charges of the dipole are at sqrt(1 + a^2) from the pivot, a = 1/10 in the scene."""
    (variant,) = (v for v in stiff_variants(scenes.load("dipole")) if v.name.endswith("0.01"))
    depth = variant.scene.parameters["depth"].fraction() - Fraction(1, 100)
    assert depth**2 == pytest.approx(Fraction(101, 100), abs=1e-14)


def test_a_scene_of_the_user_with_the_name_of_a_gallery_scene_has_no_stiff_variants():
    own = replace(scenes.load("free_rigid_body"), name="dipole")
    assert stiff_variants(own) == ()
    assert len(stiff_variants(scenes.load("dipole"))) == 3


@pytest.mark.parametrize("unit", [Rational(1, 10**6), 1, 10**6])
def test_the_unit_of_the_state_does_not_change_the_largest_step(unit):
    y = Matrix(symbols("y0:2", real=True))
    turning = FieldScene(
        group=Rn(2), action=LeftMultiplication(), y=y, f=[y[1], -y[0]], y0=[unit, 0], span=(0, 10)
    )
    made = compile_method(turning, "ambient:rk4")
    assert largest_step(made, Emitted(made, "c"), cached_reference(turning)).steps == 10
