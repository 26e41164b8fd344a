"""Inertial navigation against the coning motion in closed form."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from codegen import emit, load
from tests.codegen.scenes.test_gallery import kept


def motion(time, digits=30):
    """Return attitude, velocity and position in closed form, by Rodrigues' formula for a rotation vector."""
    with mpmath.workdps(digits):
        t, nu, c = mpmath.mpf(time), 4, mpmath.mpf(1) / 2
        x, y = mpmath.cos(nu * t), mpmath.sin(nu * t)
        angle = mpmath.acos(mpmath.mpf(12) / 13)
        R = mpmath.expm(angle * mpmath.matrix([[0, 0, y], [0, 0, -x], [-y, x, 0]]))
        s, k = mpmath.sin(c * t), mpmath.cos(c * t)
        return [*R, -c * s, c * k, c * k / 4, k, s, s / 4]


def test_the_state_at_the_end_is_the_closed_form():
    assert max(abs(a - b) for a, b in zip(kept("inertial_navigation"), motion(2), strict=True)) < 1e-25


def drift(method, h, end):
    """Return the largest error of an entry of the attitude at the end."""
    module = load(emit("inertial_navigation", method, "c"))
    found = np.array(module.run(module.initial, h, round(end / h)))
    return np.abs(found - np.array([float(x) for x in motion(end)]))[:9].max()


@pytest.mark.parametrize(
    ("method", "order", "largest"),
    [("rkmk(2):rk4", 4, 2e-7), pytest.param("rkmk(0):rk4", 2, 1e-2, marks=pytest.mark.slow)],
)
def test_the_drift_has_the_order_of_the_method(method, order, largest):
    """Without brackets the classical method ignores coning within a step, and has order 2."""
    coarse, fine = (drift(method, h, 100) for h in (0.02, 0.01))
    assert fine < largest
    assert abs(np.log2(coarse / fine) - order) < 0.1
