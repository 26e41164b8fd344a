"""The driven quantum system: its equation, and the norm of its state over many steps."""

from __future__ import annotations

import random
from fractions import Fraction

import mpmath
import pytest

from codegen.emitter import compile_method, emit_compiled
from codegen.ir.domain import PreciseDomain
from codegen.lab.reference import cached_reference
from codegen.loader import load
from codegen.scenes import load as gallery

STEP = 1 / 40
"""About 400 steps in the time interval: the method below has the error 1e-10."""


def test_the_velocity_is_minus_i_h_psi():
    d, rng = PreciseDomain(Fraction(0), 40), random.Random(1)
    scene = gallery("four_level_system")
    with mpmath.workdps(40):
        psi = [mpmath.mpc(rng.gauss(0, 1), rng.gauss(0, 1)) for _ in range(4)]
        time = d.rational(7, 3)
        angle = mpmath.mpf(157) / 500 * time
        H = mpmath.matrix(4, 4)
        for k in range(4):
            H[k, k] = 30 * mpmath.cos(angle) * k - 6 * k * (k - 1)
        for k in range(1, 4):
            H[k - 1, k] = H[k, k - 1] = 10 * mpmath.sin(angle) ** 2 * mpmath.sqrt(k)
        rate = [-1j * x for x in H * mpmath.matrix(psi)]
        state = [d.context.mpf(x) for x in (*(z.real for z in psi), *(z.imag for z in psi))]
        found = scene.velocity(d, state, time)
        expected = [*(z.real for z in rate), *(z.imag for z in rate)]
        assert all(abs(x - y) < 1e-35 for x, y in zip(found, expected, strict=True))


def drift(method, steps):
    """The largest deviation of the norm of the state from 1, seen a hundred times in a run."""
    module = load(emit_compiled(compile_method("four_level_system", method), "c"))
    state, worst, time = list(gallery_state()), 0.0, 0.0
    for _ in range(100):
        state = module.run(state, STEP, steps // 100, time)
        time += STEP * (steps // 100)
        square = sum((Fraction(x) ** 2 for x in state), Fraction(0))
        worst = max(worst, abs(float(square - 1)) / 2)
    return worst


def gallery_state():
    return (0.6, 0.0, 0.0, 0.0, 0.0, 0.8, 0.0, 0.0)


@pytest.mark.parametrize("steps", [10_000, pytest.param(1_000_000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("method", ["cf_magnus:cf_magnus6", "magnus:magnus4"])
def test_the_norm_is_kept(method, steps):
    assert drift(method, steps) < 1e-13


def test_a_classical_method_does_not_keep_the_norm():
    assert drift("ambient:dop853", 10_000) > 1e-10


def test_400_steps_of_order_six_have_ten_digits():
    scene = gallery("four_level_system")
    module = load(emit_compiled(compile_method(scene, "cf_magnus:cf_magnus6"), "c"))
    found = module.run(gallery_state(), STEP, 400, 0.0)
    exact = [float(x) for x in cached_reference(scene).state]
    assert max(abs(x - y) for x, y in zip(found, exact, strict=True)) < 1e-10
