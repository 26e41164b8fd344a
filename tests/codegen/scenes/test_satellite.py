"""The satellite against Euler's equations with wheels, written in the body and integrated by SciPy."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from codegen import emit, load
from codegen.ir.domain import FloatDomain
from codegen.scenes import load as gallery
from tests.codegen.scenes.test_gallery import kept

J = np.array([[12, 1, -1], [1, 10, 1], [-1, 1, 8]]) / 10


def wheels(t):
    return np.array([np.sin(t) / 5, np.cos(t) / 10, 0.2])


def motors(t):
    """Return the torques of the motors, the derivative of the momenta of the wheels."""
    return np.array([np.cos(t) / 5, -np.sin(t) / 10, 0])


def euler(t, y):
    """J w' = (J w + h) x w - h' + 3 r x J r and g' = g hat(w)."""
    g, w = y[:9].reshape(3, 3), y[9:]
    r = g.T @ np.array([np.cos(t), np.sin(t), 0])
    hat = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    torque = np.cross(J @ w + wheels(t), w) - motors(t) + 3 * np.cross(r, J @ r)
    return np.concatenate([(g @ hat).ravel(), np.linalg.solve(J, torque)])


def test_the_state_at_the_end_solves_eulers_equations_in_the_body():
    start = np.array([float(x) for x in gallery("satellite").initial(FloatDomain(0.0))])
    start[9:] = np.linalg.solve(J, start[9:] - wheels(0))
    end = solve_ivp(euler, (0, 3), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    end[9:] = end[:9].reshape(3, 3) @ (J @ end[9:] + wheels(3))
    assert np.abs(end - np.array([float(x) for x in kept("satellite")])).max() < 1e-9


def test_wheels_supplied_at_run_time_give_the_motion_of_the_formulas():
    """Without wheels the motion is another."""
    names = ("h0", "h1", "h2")
    own = load(emit("satellite", "rkmk(0):euler", "python"))
    supplied = load(emit("satellite", "rkmk(0):euler", "python", inputs=names))
    expected = np.array(own.run(own.initial, 0.1, 30))
    found = supplied.run(own.initial, 0.1, 30, inputs=wheels)
    still = supplied.run(own.initial, 0.1, 30, inputs=lambda t: (0, 0, 0))
    assert np.abs(np.array(found) - expected).max() < 1e-13
    assert np.abs(np.array(still) - expected).max() > 0.1
