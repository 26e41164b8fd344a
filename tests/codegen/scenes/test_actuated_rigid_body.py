"""The actuated body against Euler's equations with torques, written in the body and integrated by SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codegen import emit, load

INERTIA = np.array([0.6, 0.8, 1.0])


def euler(t, y):
    """g' = g hat(W) and P' = P x W + u, W = P/I."""
    g, P = y[:9].reshape(3, 3), y[9:]
    W = P / INERTIA
    torque = np.array([np.sin(t) / 2, 0.1, np.cos(2 * t) / 5])
    hat = np.array([[0, -W[2], W[1]], [W[2], 0, -W[0]], [-W[1], W[0], 0]])
    return np.concatenate([(g @ hat).ravel(), np.cross(P, W) + torque])


@pytest.mark.parametrize("method", ["rkmk:rk4", "vcg:triple_jump"])
def test_torques_in_the_body_turn_the_body(method):
    emission = emit("actuated_rigid_body", method, "c")
    start = np.array(emission.manifest["initial"])
    exact = solve_ivp(euler, (0, 5), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    exact[9:] = exact[:9].reshape(3, 3) @ exact[9:]  # the momentum of space
    found = load(emission).run(start, 5 / 2000, 2000)
    assert np.abs(found - exact).max() < 1e-9
