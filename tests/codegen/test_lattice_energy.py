"""Discrete gradients on lattices: the total energy to rounding, and scenes without an energy."""

from __future__ import annotations

import numpy as np
import pytest

from codegen import emit, load_lattice
from codegen.arrival import Status
from codegen.emitter import compile_method
from codegen.errors import MethodError, SceneError
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import evaluate
from codegen.scene import Bond, neighbour
from codegen.scene.energy import energy_of
from codegen.scene.unrolled import unrolled
from codegen.scenes import load as gallery
from tests.codegen.bodies import open_bodies, sheet, string
from tests.codegen.chains import S, chain
from tests.codegen.four_bodies import (
    clamped_bodies,
    conservative_spins,
    frames,
    plane_states,
    quartic_springs,
    unit_spins,
)

METHOD = "discrete_gradient:midpoint"


def total_energy(scene, states):
    """Return the energy of the unrolled lattice."""
    whole, domain = unrolled(scene, states.shape[:-1]), FloatDomain(0.0)
    return evaluate([energy_of(whole)], domain, whole.values(domain, states.ravel().tolist()))[0]


@pytest.mark.parametrize(
    ("scene", "states", "shape"),
    [
        (quartic_springs, plane_states, (4,)),
        pytest.param(quartic_springs, plane_states, (1,), marks=pytest.mark.slow),
        pytest.param(clamped_bodies, frames, (4,), marks=pytest.mark.slow),
        (conservative_spins, unit_spins, (4,)),
        (lambda: gallery("spin_lattice"), unit_spins, (2, 2)),
        pytest.param(sheet, frames, (2, 2), marks=pytest.mark.slow),
    ],
)
def test_the_total_energy_is_conserved_up_to_rounding(scene, states, shape):
    listed = states()[: int(np.prod(shape))]
    start = np.array([[float(x) for x in state] for state in listed]).reshape((*shape, -1))
    lattice = load_lattice(emit(scene(), METHOD, target="c"))
    result = lattice.run(start, 0.05, 100)
    assert result.ok
    energies = [total_energy(scene(), x) for x in (start, result.states)]
    assert np.abs(result.states - start).max() > 0.1
    assert abs(energies[1] - energies[0]) < 1e-13 * max(1, abs(energies[0]))
    # A method of the same order changes the energy much more.
    other = load_lattice(emit(scene(), "rkmk:kutta3", target="c")).run(start, 0.05, 100)
    assert abs(total_energy(scene(), other.states) - energies[0]) > 1e-9


def test_the_energy_of_a_long_chain_is_conserved():
    lattice, n = load_lattice(emit(string(), METHOD, target="c")), 5000
    start = np.random.default_rng(1).normal(size=(n, 2))

    def energy(states):
        x, p = states.T
        return (p**2).sum() / 2 + ((np.roll(x, -1) - x) ** 2).sum() / 2

    result = lattice.run(start, 0.1, 20)
    assert result.ok
    assert abs(energy(result.states) - energy(start)) < 1e-14 * energy(start)


def test_a_state_of_rest_stays_at_rest():
    # All sums are zero, and the quotient 0/0 counts as zero.
    result = load_lattice(emit(string(), METHOD, target="c")).run(np.zeros((5, 2)), 0.1, 3)
    assert result.status == Status.OK
    assert not result.states.any()


def test_an_error_at_one_site_is_seen_in_the_sums():
    start = np.zeros((3000, 2))
    start[2999] = 1e300
    result = load_lattice(emit(quartic_springs(), METHOD, target="c")).run(start, 0.1, 3)
    assert (result.status, result.completed) == (Status.NOT_FINITE, 0)


@pytest.mark.parametrize(
    ("scene", "options", "message"),
    [
        (open_bodies, {}, "the force at the open boundary is not the derivative of an energy"),
        (chain, {}, "which has no energy"),
        (string, {"solver": "simplified-newton"}, "equations that contain sums over all sites"),
    ],
)
def test_lattices_without_a_discrete_gradient_are_refused(scene, options, message):
    with pytest.raises(MethodError, match=message):
        emit(scene(), METHOD, target="c", **options)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"energy": S[0]}, "the total energy of 3 sites is not constant"),
        ({"bonds": (Bond((1,), -2 * S.dot(neighbour(S, (1,)))),)}, "is not constant: the time derivative is"),
        # The state outside follows the site, and its force is not the derivative of an energy.
        ({"outside": (S[1], S[0], 1)}, "expected an energy that is constant"),
        ({"bonds": (Bond((2,), -S.dot(neighbour(S, (2,)))),)}, r"a bond with the offset \(2,\)"),
        ({"bonds": (Bond((1,), S[0]),)}, "coordinates of fewer than two sites"),
    ],
)
def test_energies_that_are_not_constant_are_refused(options, message):
    with pytest.raises(SceneError, match=message):
        conservative_spins(**options)


def test_the_sums_of_a_step_are_explained():
    step = compile_method(string(), METHOD).kernel.sites
    assert step is not None
    lines = step.explanation()
    # |eta|^2 is known before the energy of the new state.
    sums = [line for line in lines if "sums over all sites" in line]
    assert sums == [f"  computes the sums over all sites: {name}" for name in ("sum_2", "sum")]
