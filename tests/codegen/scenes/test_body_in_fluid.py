"""Kirchhoff's equations: what emitted steps keep, and the plane as a part of space."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codegen import emit, load
from codegen.ir.domain import FloatDomain
from codegen.scenes import load as gallery
from tests.codegen.scenes.test_gallery import kept

J, M = np.diag([2, 1, 2 / 3]), np.diag([3.0, 2, 1])
C = np.array([[0.1, 0, 0], [0, 0, 0.2], [0, 0.2, -0.1]])


def kirchhoff(t, y):
    m, p = y[:3], y[3:]
    w, v = np.linalg.solve(J, m) + C @ p, np.linalg.solve(M, p) + C.T @ m
    return np.concatenate([np.cross(m, w) + np.cross(p, v), np.cross(p, w)])


def test_the_state_at_the_end_solves_kirchhoffs_equations():
    start = [float(x) for x in gallery("body_in_fluid").initial(FloatDomain(0.0))]
    end = solve_ivp(kirchhoff, (0, 4), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    assert np.abs(end - np.array([float(x) for x in kept("body_in_fluid")])).max() < 1e-9


@pytest.mark.parametrize(
    ("method", "steps", "largest"),
    [
        ("rkmk(0):euler", 2000, 1e-13),
        pytest.param("cf:cf4", 2000, 1e-13, marks=pytest.mark.slow),
        pytest.param("cf:cf4", 100_000, 1e-12, marks=pytest.mark.slow),
        pytest.param("rkmk:rk4", 100_000, 1e-12, marks=pytest.mark.slow),
    ],
)
def test_emitted_steps_keep_both_casimir_functions(method, steps, largest):
    module = load(emit("body_in_fluid", method, "c"))
    before, after = (np.array(y) for y in (module.initial, module.run(module.initial, 0.05, steps)))
    assert abs(after[3:] @ after[3:] - before[3:] @ before[3:]) < largest
    assert abs(after[:3] @ after[3:] - before[:3] @ before[3:]) < largest
    assert np.abs(after - before).max() > 0.1


def test_the_velocity_in_the_plane_is_the_cross_product_in_space():
    scene, d = gallery("planar_body_in_fluid"), FloatDomain(0.0)
    m, p, r = 0.7, -1.1, 0.4
    w, u, v = m + p / 4, 3 * p + m / 4, r / 2
    expected = np.cross([0, 0, m], [0, 0, w]) + np.cross([p, r, 0], [u, v, 0])
    turned = np.cross([p, r, 0], [0, 0, w])
    found = scene.velocity(d, (m, p, r), float(Fraction(0)))
    assert np.abs(np.array(found) - [expected[2], *turned[:2]]).max() < 1e-14
