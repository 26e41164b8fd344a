"""Euler's method beside the Lie-Euler method on a circle."""

from __future__ import annotations

import math

import pytest

from codegen import emit, load

H, STEPS = 0.1, 100


def final(method: str, a: str) -> tuple[float, float]:
    module = load(emit(f"circle[a={a}]", method, "python"))
    x, y = module.run(module.initial, H, STEPS)
    return math.hypot(x, y), math.atan2(y, x)


def test_eulers_method_leaves_the_circle():
    """At constant speed a step multiplies the radius by sqrt(1 + h^2)."""
    radius, _ = final("ambient:euler", "0")
    assert radius == pytest.approx((1 + H**2) ** (STEPS / 2), rel=1e-13)


def test_lie_euler_is_exact_at_constant_speed():
    radius, angle = final("rkmk(0):euler", "0")
    assert radius == pytest.approx(1, abs=1e-13)
    assert angle == pytest.approx(math.remainder(H * STEPS, 2 * math.pi), abs=1e-13)


def test_lie_euler_stays_on_the_circle_at_changing_speed():
    assert final("rkmk(0):euler", "1/2")[0] == pytest.approx(1, abs=1e-13)
    assert final("ambient:euler", "1/2")[0] > 1.5
