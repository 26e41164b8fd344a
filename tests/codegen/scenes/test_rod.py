"""The rods and the chain of bodies: closed forms, order, and conserved quantities."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from codegen import emit, load_lattice
from codegen.scenes.free_rod import straight

EA, GJ, EI, GA = 400.0, 0.8, 1.0, 27 / 28 * 160
INERTIA = np.array([1 / 400, 1 / 400, 1 / 200])


@cache
def module(name, method):
    return load_lattice(emit(name, method, target="c"))


def moving(number, ds, size, seed=3):
    """Return the states of a straight rod with random momenta."""
    states = np.array(straight(number, ds))
    states[:, 12:] = size * np.random.default_rng(seed).normal(size=(number, 6)) * [0.01, 0.01, 0.01, 1, 1, 1]
    # The momenta are angular momenta about the origin, so those of a moving section contain x x p.
    states[:, 12:15] += np.cross(states[:, 9:12], states[:, 15:])
    return states


def energy(states, ds):
    """Return the energy of a free rod, without the formulas of the scene."""
    R, x, pi, p = states[:, :9].reshape(-1, 3, 3), states[:, 9:12], states[:, 12:15], states[:, 15:]
    P = np.einsum("nab,na->nb", R, pi - np.cross(x, p))
    total = (P**2 / INERTIA).sum() / 2 + (p**2).sum() / 2
    gamma = np.einsum("nab,na->nb", (R[1:] + R[:-1]) / 2, (x[1:] - x[:-1]) / ds) - [0, 0, 1]
    turn = np.einsum("nab,nac->nbc", R[:-1], R[1:])
    # sum_a D_a (1 - cosine of the angle between d_a and d_a'), with D = (GJ/2, GJ/2, EI - GJ/2)
    bend = (1 - np.einsum("naa->na", turn)) @ [GJ / 2, GJ / 2, EI - GJ / 2]
    return total + (gamma**2 @ [GA, GA, EA]).sum() / 2 + bend.sum() / ds**2


@pytest.mark.slow
def test_longitudinal_waves_have_the_closed_form():
    n, ds, T = 8, 1 / 20, 0.3
    states, mode = np.array(straight(n, ds)), np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    states[:, 11] += 1e-3 * mode
    rate = 2 * np.sqrt(EA) / ds * np.sin(np.pi / n)
    found = module("free_rod", "splitting:strang").run(states, T / 30000, 30000).states
    expected = states[:, 11] - 1e-3 * mode * (1 - np.cos(rate * T))
    # The forces are linear in these displacements.
    assert np.abs(found[:, 11] - expected).max() < 1e-6
    assert np.abs(found[:, :9] - states[:, :9]).max() < 1e-12


@pytest.mark.slow
def test_small_torsion_waves_have_the_closed_form():
    n, ds, T, size = 8, 1 / 20, 0.2, 1e-4
    mode = np.cos(np.pi * (np.arange(n) + 0.5) / n)
    states = np.array(straight(n, ds))
    c, s = np.cos(size * mode), np.sin(size * mode)
    states[:, 0], states[:, 1], states[:, 3], states[:, 4] = c, -s, s, c
    rate = 2 * np.sqrt(GJ / INERTIA[2]) / ds * np.sin(np.pi / n / 2)
    found = module("free_rod", "splitting:strang").run(states, T / 10000, 10000).states
    assert np.abs(found[:, 3] - size * mode * np.cos(rate * T)).max() < 1e-4 * size


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "method", "order"),
    [
        ("free_rod", "splitting:strang", 2),
        ("free_rod", "composition:triple_jump", 4),
        ("swinging_rod", "cg:cg3", 3),
        ("swinging_rod", "cf:cf4", 4),
        ("pipe_laying[length=1/4]", "rkmk:rk4", 4),
        ("body_chain", "splitting:strang", 2),
        ("body_chain", "cf:cf4", 4),
    ],
)
def test_a_chain_of_four_shows_the_order_from_below_and_above(name, method, order):
    T = 1 / 16
    states = moving(4, 0.05, 0.1)
    if name == "body_chain":
        states, T = np.array(hanging(4)), 0.5
    exact = module(name, "cf:cf4").run(states, T / 8192, 8192).states
    errors = []
    for n in (512, 1024):
        result = module(name, method).run(states, T / n, n)
        assert result.ok
        errors.append(np.abs(result.states - exact).max())
    assert order - 0.2 < np.log2(errors[0] / errors[1]) < order + 0.2


def hanging(number):
    """Return the states of bodies that hang and move sideways."""
    frame = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    return [[*frame, 0, 0, -0.5 - i, 0, 0.3 - 0.5 * i, 0.1, 0.5, 0, 0] for i in range(number)]


@pytest.mark.slow
def test_momentum_and_energy_of_the_free_rod_are_bounded_over_a_hundred_thousand_steps():
    n, ds = 20, 1 / 20
    states = moving(n, ds, 0.2)
    first, momentum = energy(states, ds), states[:, 12:].sum(axis=0)
    lattice, errors = module("free_rod", "splitting:strang"), []
    for _ in range(100):
        result = lattice.run(states, 1e-3, 1000)
        assert result.ok
        states = result.states
        errors.append(energy(states, ds) / first - 1)
        assert np.abs(states[:, 12:].sum(axis=0) - momentum).max() < 1e-10
    low, high = min(errors), max(errors)
    print(f"relative error of the energy between {low:.2e} and {high:.2e} in 1e5 steps")
    assert -0.1 < low < high < 0.1
    early, late = np.array(errors[:50]), np.array(errors[50:])
    assert abs(late.mean() - early.mean()) < 3 * (late.std() + early.std()) / np.sqrt(50)


@pytest.mark.slow
def test_a_thousand_sections_run():
    n = 1000
    lattice = load_lattice(emit("swinging_rod", "splitting:strang", target="c", parameters=["ds"]))
    result = lattice.run(np.array(straight(n, 1 / n)), 2e-5, 100, ds=1 / n)
    assert result.ok
