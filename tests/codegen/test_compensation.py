"""Compensated summation as an option of emission: rounding errors of many short steps do not add up."""

from __future__ import annotations

import math
from functools import cache

import pytest

from codegen.build import Compiler
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.integrator import Integrator
from codegen.loader import load
from tests.codegen.test_integrate import fall, rotation
from tests.promises import clean_c, clean_python

SCENES = {"fall": fall, "rotation": rotation}


@cache
def emitted(scene: str, method: str, compensate: bool, target: str = "c", events: int = 0) -> Integrator:
    place = SCENES[scene]() if scene in SCENES else scene
    made = compile_method(place, method, compensate=compensate, events=events)
    return load(emit_compiled(made, target, prefix="sum_"))


@pytest.mark.slow
@pytest.mark.parametrize("target", ["c"])
def test_the_gain_over_ten_million_steps_on_a_vector_space_and_on_a_group(target: str) -> None:
    """The method is exact for both motions, so all errors are rounding errors."""
    steps = 10**7
    exact = {"fall": [0.0, -10.0], "rotation": [math.cos(1), math.sin(1), 0.0]}
    for scene, method in (("fall", "rk:rk4"), ("rotation", "cf:cf4")):
        errors = []
        for compensate in (False, True):
            integrator = emitted(scene, method, compensate, target)
            state = integrator.run(integrator.initial, 1 / steps, steps)
            errors.append(max(abs(x - y) for x, y in zip(state, exact[scene], strict=False)))
        plain, compensated = errors
        assert plain > 1e-11
        assert compensated < 2e-15
        assert plain > 1000 * compensated


@pytest.mark.slow
def test_the_gain_over_ten_million_steps_on_the_free_rigid_body() -> None:
    deviations = []
    for compensate in (False, True):
        integrator = emitted("free_rigid_body", "cf:cf4", compensate)
        start = integrator.initial
        state = integrator.run(start, 1e-4, 10**7)
        deviations.append(abs(math.hypot(*state[:3]) - math.hypot(*start[:3])))
    assert deviations[0] > 1e-13
    assert deviations[1] < 5e-16


def test_the_state_has_a_carry_for_each_coordinate_which_a_later_run_continues() -> None:
    for target in ("c", "python"):
        integrator = emitted("free_rigid_body", "cf:cf4", True, target)
        plain = emitted("free_rigid_body", "cf:cf4", False, target)
        assert integrator.interface.size == 2 * plain.interface.size
        assert integrator.initial == [*plain.initial, 0.0, 0.0, 0.0]
        whole = integrator.run(integrator.initial, 0.01, 300)
        parts = integrator.run(integrator.run(integrator.initial, 0.01, 100), 0.01, 200)
        assert whole == parts
        assert any(whole[3:])
        assert max(map(abs, whole[3:])) < 2e-16
        assert whole[:3] == pytest.approx(plain.run(plain.initial, 0.01, 300), abs=1e-14)


def test_events_and_outputs_work_with_carries() -> None:
    integrator = emitted("rotation", "rkmk:rk4", True, events=1)
    found = integrator.integrate(integrator.initial, 0, 2, 0.5, events=[lambda t, y: y[0]], t_eval=[0.3])
    assert [x.t for x in found.crossings] == pytest.approx([math.pi / 2], abs=1e-13)
    assert found.states[0][:2] == pytest.approx([math.cos(0.3), math.sin(0.3)], abs=1e-15)


def test_options_that_need_another_state_are_refused() -> None:
    for method, options in (
        ("cf:cf43", {"adaptive": True}),
        ("cf:cf4", {"jacobian": True}),
        ("rkmk(2):rk4", {"dense": True}),
    ):
        with pytest.raises(MethodError, match=r"is not available for .* with compensated summation"):
            compile_method("free_rigid_body", method, compensate=True, **options)


def test_the_header_states_the_layout_and_the_command() -> None:
    made = compile_method("free_rigid_body", "cf:cf4", compensate=True)
    emission = emit_compiled(made, "c")
    (text,) = (text for name, text in emission.files.items() if name.endswith(".c"))
    assert "the second half of the state contains correction terms" in " ".join(
        text.replace("*", " ").split()
    )
    assert "--compensate" in emission.manifest["command"]
    plain = emit_compiled(compile_method("free_rigid_body", "cf:cf4"), "c")
    assert not any("carry" in text or "compensate" in text for text in plain.files.values())


@pytest.mark.slow
def test_modules_with_carries_are_clean(compiler: Compiler, tmp_path: object) -> None:
    for k, (scene, method) in enumerate(
        [("free_rigid_body", "cf:cf4"), ("dipole", "vcg:triple_jump"), ("heavy_top", "slgi:midpoint")]
    ):
        made = compile_method(scene, method, compensate=True, integrate=True)
        folder = tmp_path / f"c{k}"  # type: ignore[operator]
        folder.mkdir()
        clean_c(emit_compiled(made, "c", prefix="sum_"), compiler, folder)
        if compiler.command[0] == "gcc":
            clean_python(emit_compiled(made, "python", prefix="sum_"), folder)
