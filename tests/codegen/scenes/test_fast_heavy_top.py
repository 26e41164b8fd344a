"""Emitted integrators on the fast top: the published angular velocity, and what its symmetries keep."""

from __future__ import annotations

import numpy as np
import pytest

from codegen.emitter import emit
from codegen.ir.domain import FloatDomain
from codegen.loader import load
from codegen.scenes import load as load_scene

SCENE = load_scene("fast_heavy_top")
INERTIA = np.diag([15.234375, 0.46875, 15.234375])


def after(spelling, steps):
    emission = emit("fast_heavy_top", spelling, "c")
    return emission.manifest["initial"], load(emission).run(emission.manifest["initial"], 2 / steps, steps)


@pytest.mark.parametrize(("spelling", "close"), [("rkmk(2):rk4", 1e-7), ("vcg:triple_jump", 1e-6)])
def test_the_published_angular_velocity_comes_out(spelling, close):
    """The world's omega_y at t = 2 is -106.16380414 (Bruels and Cardona 2010)."""
    _, state = after(spelling, 20000)
    g, mu = np.reshape(state[:9], (3, 3)), np.array(state[9:])
    omega = g @ np.linalg.solve(INERTIA, g.T @ mu)
    assert omega[1] == pytest.approx(-106.16380414, abs=close)


def drift(spelling, steps):
    """The change of both momenta over the span."""
    ends, d = after(spelling, steps), FloatDomain(0.0)
    names = ("momentum_about_vertical", "momentum_about_body_axis")
    values = [[SCENE.invariant(d, name, state) for name in names] for state in ends]
    return [abs(x - y) for x, y in zip(*values, strict=True)]


def test_a_variational_method_keeps_both_momenta_to_rounding_and_munthe_kaas_does_not():
    """Rotations about the vertical and about the body's axis leave H and the discrete action as they are."""
    assert max(drift("vcg:midpoint", 4000)) < 1e-11
    assert min(drift("rkmk(2):rk4", 4000)) > 1e-8
