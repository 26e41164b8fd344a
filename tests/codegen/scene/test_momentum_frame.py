"""Momenta of the body in place of those of space: another state in, another out, the same step between."""

from __future__ import annotations

import numpy as np
import pytest

from codegen.emitter import emit
from codegen.errors import SceneError
from codegen.loader import load
from orderconds.errors import UnknownName
from tests.compilations import emitted

METHODS = (
    "vcg:midpoint",
    pytest.param("vrkmk(1):kutta3", marks=pytest.mark.slow),
    "rkmk:rk4",
    pytest.param("cf:cf4", marks=pytest.mark.slow),
    "slgi:midpoint",
)


def turned(state, sign=1):
    """(q, mu) to (q, q^T mu), or back with sign -1."""
    g = np.array(state[:9]).reshape(3, 3)
    return [*state[:9], *((g.T if sign > 0 else g) @ np.array(state[9:]))]


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("method", METHODS)
def test_a_run_in_the_body_is_the_run_in_space_seen_from_the_body(method, target):
    space, body = (emitted("dipole", method, target, frame=frame) for frame in ("space", "body"))
    start = space.manifest["initial"]
    assert body.manifest["initial"] == pytest.approx(turned(start), abs=1e-16)
    middle = load(space).run(start, 0.02, 5)
    assert load(body).run(turned(start), 0.02, 5) == pytest.approx(turned(middle), abs=1e-13)
    assert turned(middle) != pytest.approx(middle, abs=1e-3)
    rows = load(body).trajectory(turned(start), 0.02, 5)
    assert turned(rows[5], -1) == pytest.approx(middle, abs=1e-13)


@pytest.mark.parametrize("target", ["c", "python"])
def test_splittings_that_put_off_the_end_of_their_steps_are_seen_from_the_body_too(target):
    method = "splitting:strang"
    space, body = (emitted("fast_heavy_top", method, target, frame=frame) for frame in ("space", "body"))
    start = space.manifest["initial"]
    middle = load(space).run(start, 1e-3, 7)
    assert load(body).run(turned(start), 1e-3, 7) == pytest.approx(turned(middle), abs=1e-11)


def test_the_angular_momentum_of_a_free_body_stands_still_in_space_and_turns_in_the_body():
    emission = emitted("free_rigid_body_attitude", "vcg:midpoint", frame="body")
    rows = np.array(load(emission).trajectory(emission.manifest["initial"], 0.05, 100))
    in_space = np.array([turned(row, -1)[9:] for row in rows])
    assert np.abs(in_space - in_space[0]).max() < 1e-12
    assert np.abs(rows[:, 9:] - rows[0, 9:]).max() > 0.5


def test_the_frame_is_in_the_head_the_command_and_the_name():
    emission = emitted("dipole", "vcg:midpoint", frame="body")
    text = emission.files["dipole_vcg_midpoint_body.c"]
    assert "[9..11] mu: left-trivialised momentum (body frame)" in text
    assert "--frame body" in emission.manifest["command"]
    assert "right-trivialised momentum" in "".join(emitted("dipole", "vcg:midpoint").files.values())


@pytest.mark.parametrize("scene", ["free_rigid_body", "linear_oscillator"])
def test_a_scene_without_a_body_is_refused(scene):
    with pytest.raises(SceneError, match="no momentum in the body frame"):
        emit(scene, "rkmk:rk4", frame="body")


def test_another_frame_is_refused():
    with pytest.raises(UnknownName, match="unknown frame car; expected space or body"):
        emit("dipole", "vcg:midpoint", frame="car")
