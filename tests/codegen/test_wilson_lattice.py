"""The Wilson flow of a lattice gauge field: its field, and emitted C against a Richardson reference."""

from __future__ import annotations

from functools import cache
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from sympy import lambdify

from codegen import emit, load_lattice
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import evaluate
from codegen.scene.site_scene import with_frozen_neighbours
from codegen.scene.sites import offset_text

FILE = Path(__file__).parents[2] / "codegen" / "scenes" / "wilson_lattice.py"
TWO_REGISTERS = ("cf:luescher3", "cf:williamson3", "cf:carpenter_kennedy4", "cf:yan5", "cf:cf5_2n_s10")


@cache
def example(dimension):
    """Return the variables of the example, in another dimension if it is not four."""
    text = FILE.read_text().replace("DIMENSION = 4", f"DIMENSION = {dimension}")
    variables = {"__name__": "wilson_lattice"}
    exec(compile(text, str(FILE), "exec"), variables)
    assert len(variables["links"]) == 18 * dimension
    return variables


def matrices(states):
    """Return the complex links of a lattice, an array of shape (n1, ..., nd, d, 3, 3)."""
    parts = states.reshape(*states.shape[:-1], -1, 6, 3)
    return parts[..., :3, :] + 1j * parts[..., 3:, :]


def inverse(link):
    return link.conj().swapaxes(-1, -2)


def density(states):
    """Return the mean over all sites of the sum of 2 Re tr(1 - P) over the plaquettes that begin there."""
    links, total = matrices(states), 0.0
    for a, b in combinations(range(links.shape[-3]), 2):
        A, B = links[..., a, :, :], links[..., b, :, :]
        P = A @ np.roll(B, -1, a) @ inverse(np.roll(A, -1, b)) @ inverse(B)
        total += 6 - 2 * np.trace(P, axis1=-2, axis2=-1).real.mean()
    return total


def unitarity(states):
    """Return the largest entry of V V^H - 1 and of det V - 1."""
    links = matrices(states)
    return max(np.abs(links @ inverse(links) - np.eye(3)).max(), np.abs(np.linalg.det(links) - 1).max())


def generators(states):
    """Return the formulas of the field at the first site: matrices in su(3), one for each link."""
    dimension = states.ndim - 1
    scene = with_frozen_neighbours(example(dimension)["scene"])
    values = dict(zip(scene.symbols, states[(0,) * dimension], strict=True))
    for offset, column in zip(scene.sites.offsets, scene.sites.symbols, strict=True):
        values |= dict(zip(column, states[offset], strict=True))
    field = evaluate(list(scene.roots), FloatDomain(0.0), values)
    return [algebra(field[8 * a : 8 * a + 8]) for a in range(dimension)]


def algebra(x):
    """Return the matrix in su(3) with these coordinates."""
    return np.array(
        [
            [1j * x[6], x[0] + 1j * x[1], x[2] + 1j * x[3]],
            [-x[0] + 1j * x[1], 1j * (x[7] - x[6]), x[4] + 1j * x[5]],
            [-x[2] + 1j * x[3], -x[4] + 1j * x[5], -1j * x[7]],
        ]
    )


def turned(states, a, X):
    """Return a lattice in which link ``a`` of the first site is multiplied by exp X from the left."""
    first, dimension = (0,) * (states.ndim - 1), states.ndim - 1
    parts = states.copy().reshape(*states.shape[:-1], dimension, 6, 3)
    link = expm(X) @ matrices(states)[(*first, a)]
    parts[(*first, a)] = np.vstack([link.real, link.imag])
    return parts.reshape(states.shape)


def test_the_start_is_unitary_and_has_a_fixed_seed():
    states = example(2)["start"]((2, 3))
    assert unitarity(states) < 2e-15
    assert np.array_equal(states, example(2)["start"]((2, 3)))
    assert not np.array_equal(states[0, 0], states[0, 1])


def test_the_field_is_the_gradient_of_the_action():
    states = example(2)["start"]((3, 3))
    for a, Z in enumerate(generators(states)):
        for k in range(8):
            X = 1e-5 * algebra(np.eye(8)[k])
            change = 9 * (density(turned(states, a, X)) - density(turned(states, a, -X))) / 2
            # A generator -g0^2 T^a d^a S with tr T^a T^b = -1/2 has this product with every direction X.
            assert abs(change - 2 * np.trace(Z @ X).real) < 1e-13


def test_the_variable_energy_is_the_density_of_the_action():
    variables, states = example(2), example(2)["start"]((3, 3))
    shifts = [(1, 0), (0, 1)]
    moved = {s: np.roll(states, (-s[0], -s[1]), (0, 1)) for s in shifts}
    names = [str(x) for x in variables["links"]]
    values = {name: states[..., k] for k, name in enumerate(names)}
    for s, array in moved.items():
        values |= {f"{name}_{offset_text(s)}": array[..., k] for k, name in enumerate(names)}
    symbols = sorted(variables["energy"].free_symbols, key=str)
    found = lambdify(symbols, variables["energy"])(*(values[str(x)] for x in symbols))
    assert found.mean() == pytest.approx(density(states), rel=1e-14)


@cache
def module(dimension, method):
    return load_lattice(emit(example(dimension)["scene"], method, target="c"))


def energies(lattice, states, steps):
    """Return E(t) at t = 1/4, 1/2, 3/4 and 1, and the final states; ``steps`` is the number of all steps."""
    listed = []
    for _ in range(4):
        result = lattice.run(states, 1 / steps, steps // 4)
        assert result.ok
        states = result.states
        listed.append(density(states))
    return np.array(listed), states


@pytest.mark.slow
@pytest.mark.parametrize("method", TWO_REGISTERS)
def test_the_energy_converges_with_the_order_of_the_method(method):
    lattice, states = module(2, method), example(2)["start"]((4, 4))
    order = lattice.artifact.manifest["order"]
    exact = energies(module(2, "cf:cf5_2n_s10"), states, 400)[0]
    counts = (20, 40) if order == 5 else (40, 80)
    errors = [np.abs(energies(lattice, states, n)[0] - exact).max() for n in counts]
    assert order - 0.4 < np.log2(errors[0] / errors[1]) < order + 0.6


@pytest.mark.slow
@pytest.mark.parametrize(("method", "steps"), [("cf:luescher3", 1600), ("cf:carpenter_kennedy4", 200)])
def test_the_energy_on_a_lattice_of_256_sites_has_its_richardson_reference(method, steps):
    lattice, states = module(4, method), example(4)["start"]((4, 4, 4, 4))
    order = lattice.artifact.manifest["order"]
    coarse, fine = (energies(lattice, states, n) for n in (steps // 2, steps))
    reference = fine[0] + (fine[0] - coarse[0]) / (2**order - 1)
    assert np.abs(fine[0] - reference).max() < 1e-8
    assert unitarity(fine[1]) < 1e-13
