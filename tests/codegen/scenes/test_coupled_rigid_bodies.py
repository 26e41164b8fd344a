"""Two bodies at a ball joint against Newton's and Euler's equations with the force of the joint."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from codegen.ir.domain import FloatDomain
from codegen.scenes import load as gallery
from tests.codegen.scenes.test_gallery import kept

INERTIAS = np.diag([1, 2, 2.5]), np.diag([1.5, 0.5, 1])
JOINTS = np.array([0, 0, 1]), np.array([0.75, 0, 0])
EPS = 0.5


def hat(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def bodies(y):
    """Return attitudes, inertia tensors in space, and joints in space, from the attitudes of a state."""
    g = y[:9].reshape(3, 3), y[9:18].reshape(3, 3)
    return (
        g,
        [a @ J @ a.T for a, J in zip(g, INERTIAS, strict=True)],
        [a @ d for a, d in zip(g, JOINTS, strict=True)],
    )


def newton_euler(t, y):
    """Return the derivatives of attitudes and angular velocities, with the force F of the joint.

    The distance of the centres r = d2 - d1 (in space) satisfies r'' = F/eps, and I w' + w x I w = +- d x F.
    """
    g, tensors, d = bodies(y)
    w = y[18:21], y[21:]
    free = [np.linalg.solve(tensors[k], -np.cross(w[k], tensors[k] @ w[k])) for k in (0, 1)]
    # r'' = sum of sign_k (w_k' x d_k + w_k x (w_k x d_k)) with w_k' = free_k - sign_k I_k^-1 (d_k x F)
    signs = (-1, 1)
    known = sum(s * np.cross(free[k], d[k]) for k, s in enumerate(signs))
    known += sum(s * np.cross(w[k], np.cross(w[k], d[k])) for k, s in enumerate(signs))
    matrix = np.eye(3) / EPS + sum(hat(d[k]).T @ np.linalg.solve(tensors[k], hat(d[k])) for k in (0, 1))
    force = np.linalg.solve(matrix, known)
    turns = [free[k] - s * np.linalg.solve(tensors[k], np.cross(d[k], force)) for k, s in enumerate(signs)]
    return np.concatenate([*((hat(w[k]) @ g[k]).ravel() for k in (0, 1)), *turns])


def momenta(y):
    """Return the canonical momenta of a state with angular velocities."""
    _, tensors, d = bodies(y)
    w = y[18:21], y[21:]
    apart = np.cross(w[1], d[1]) - np.cross(w[0], d[0])
    return np.concatenate(
        [tensors[0] @ w[0] - EPS * np.cross(d[0], apart), tensors[1] @ w[1] + EPS * np.cross(d[1], apart)]
    )


def test_the_state_at_the_end_solves_the_equations_of_newton_and_euler():
    start = np.array([float(x) for x in gallery("coupled_rigid_bodies").initial(FloatDomain(0.0))])
    mass = np.column_stack([momenta(np.concatenate([start[:18], e])) for e in np.eye(6)])
    start[18:] = np.linalg.solve(mass, start[18:])
    end = solve_ivp(newton_euler, (0, 2), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    end[18:] = momenta(end)
    assert np.abs(end - np.array([float(x) for x in kept("coupled_rigid_bodies")])).max() < 1e-9
