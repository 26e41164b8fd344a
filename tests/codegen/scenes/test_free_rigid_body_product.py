"""Attitude in the group, momentum in a vector space: what the product keeps and what it does not."""

from __future__ import annotations

import numpy as np
import pytest

from codegen.emitter import emit
from codegen.ir.domain import FloatDomain
from codegen.loader import load
from codegen.scenes import load as load_scene

SCENE = load_scene("free_rigid_body_product")


def after(method, h, steps, scene="free_rigid_body_product"):
    emission = emit(scene, method, "c")
    start = emission.manifest["initial"]
    return np.array(start), np.array(load(emission).run(start, h, steps))


def energy(state):
    return SCENE.invariant(FloatDomain(0.0), "energy", list(state))


def test_the_attitude_stays_a_rotation_to_rounding():
    _, end = after("rkmk:rk4", 0.1, 10_000)
    g = end[:9].reshape(3, 3)
    assert np.abs(g.T @ g - np.eye(3)).max() < 1e-12


def test_the_momentum_is_integrated_as_in_a_vector_space():
    """P' = P x W does not see the attitude: its part is the classical Runge-Kutta method."""
    start, end = after("rkmk:rk4", 0.1, 7)
    weights, P, h = 1 / np.array([0.6, 0.8, 1.0]), start[9:], 0.1

    def f(p):
        return np.cross(p, weights * p)

    for _ in range(7):
        k1 = f(P)
        k2 = f(P + h / 2 * k1)
        k3 = f(P + h / 2 * k2)
        P = P + h / 6 * (k1 + 2 * k2 + 2 * k3 + f(P + h * k3))
    assert np.abs(end[9:] - P).max() < 1e-14


@pytest.mark.slow
def test_over_a_million_steps_two_thousandths_of_the_energy_are_lost():
    start, end = after("rkmk:rk4", 0.1, 1_000_000)
    assert 1 - energy(end) / energy(start) == pytest.approx(2e-3, rel=0.3)


def test_on_the_cotangent_group_the_momentum_is_kept_to_rounding():
    """There it is one of the group's own coordinates: mu is constant, whatever the method."""
    start, end = after("rkmk:rk4", 0.1, 10_000, "free_rigid_body_attitude")
    assert np.abs(end[9:] - start[9:]).max() < 1e-11
    start, end = after("rkmk:rk4", 0.1, 10_000)
    assert abs(np.linalg.norm(end[9:]) - np.linalg.norm(start[9:])) > 1e-6
