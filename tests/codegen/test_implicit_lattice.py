"""Implicit methods on chains and lattices: against the product of all sites, orders, failures."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from click.testing import CliRunner

from codegen import emit, load_lattice
from codegen.arrival import Status
from codegen.errors import MethodError
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.lower import lower, method_for, problem_for
from codegen.scene.unrolled import unrolled
from orderconds.cli import program
from tests.codegen.bodies import bodies, joined, springs
from tests.codegen.chains import chain, open_chain, open_plane, oscillators, plane

SCENES = {
    "chain": chain,
    "open_chain": open_chain,
    "plane": plane,
    "open_plane": open_plane,
    "oscillators": oscillators,
}


@cache
def module(name, method):
    return load_lattice(emit(SCENES[name](), method, target="c"))


def states(shape, size=3):
    found = np.random.default_rng(1).normal(size=(*shape, size))
    return found / np.linalg.norm(found, axis=-1, keepdims=True)


def step_of_the_product(name, method, start, h, t=0.0):
    """Return a step of the unrolled program on the product of the groups of all sites."""
    whole = unrolled(SCENES[name](), start.shape[:-1])
    chosen = method_for(whole, method)
    lowered, problem = lower(whole, chosen), problem_for(whole, chosen)
    inputs = {"y": tuple(start.ravel().tolist())}
    inputs |= {"t": t} if any(v.name == "t" for v in lowered.inputs) else {}
    return np.reshape(interpret(lowered, problem, FloatDomain(h), inputs)["y"], start.shape)


@pytest.mark.parametrize(
    ("name", "method", "shape"),
    [
        ("oscillators", "rk:gauss1", (4,)),
        pytest.param("oscillators", "rk:crouzeix3", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "rkmk:gauss2", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "rkmk:gauss2", (2,), marks=pytest.mark.slow),
        pytest.param("chain", "rkmk:gauss3", (4,), marks=pytest.mark.slow),
        pytest.param("open_chain", "cf:gauss2", (4,), marks=pytest.mark.slow),
        pytest.param("open_chain", "cf:gauss2", (1,), marks=pytest.mark.slow),
        pytest.param("open_chain", "ambient:lobatto3a3", (4,), marks=pytest.mark.slow),
        pytest.param("chain", "cg:kahan_triple_jump", (4,), marks=pytest.mark.slow),
        pytest.param("plane", "ambient:gauss1", (2, 3), marks=pytest.mark.slow),
        pytest.param("open_plane", "rkmk:radau2a2", (2, 2), marks=pytest.mark.slow),
        pytest.param("oscillators", "rk:gauss2", (1,), marks=pytest.mark.slow),
    ],
)
def test_an_implicit_step_is_the_step_of_the_product(name, method, shape):
    lattice = module(name, method)
    start = states(shape, lattice.interface.size)
    found = lattice.run(start, 0.1, 1, t=0.3)
    assert (found.status, found.completed) == (Status.OK, 1)
    expected = step_of_the_product(name, method, start, 0.1, 0.3)
    assert np.abs(found.states - expected).max() < 2e-14


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "method", "order"),
    [("chain", "rkmk:gauss2", 4), ("open_chain", "cf:gauss1", 2), ("oscillators", "rk:gauss2", 4)],
)
def test_the_order_is_seen_from_below_and_above(name, method, order):
    lattice = module(name, method)
    start = states((4,), lattice.interface.size)
    exact = module(name, "rkmk:gauss3").run(start, 1 / 256, 256, t=0.2).states
    errors = []
    for n in (16, 32):
        result = lattice.run(start, 1 / n, n, t=0.2)
        assert result.ok
        errors.append(np.abs(result.states - exact).max())
    assert order - 0.1 < np.log2(errors[0] / errors[1]) < order + 0.1


@pytest.mark.slow
def test_long_chains_repeat_the_bits_of_short_chains():
    # A short chain and its repetition have the same maxima, so they take the same number of sweeps.
    lattice, start = module("chain", "rkmk:gauss2"), states((4,))
    short = lattice.run(start, 0.1, 5).states
    tiled = lattice.run(np.tile(start, (1000, 1)), 0.1, 5).states
    assert np.array_equal(tiled, np.tile(short, (1000, 1)))


@pytest.mark.slow
def test_a_block_that_does_not_converge_leaves_the_last_good_state():
    lattice, start = module("open_chain", "cf:gauss2"), states((4,))
    result = lattice.run(start, 5.0, 3)
    assert (result.status, result.completed) == (Status.NOT_CONVERGED, 0)
    assert "did not converge" in result.reason
    assert np.array_equal(result.states, start)


def test_a_step_without_finite_numbers_is_reported():
    lattice, start = module("oscillators", "rk:gauss1"), states((3,), 2)
    result = lattice.run(start, 1e200, 3)
    assert (result.status, result.completed) == (Status.NOT_FINITE, 0)
    assert np.array_equal(result.states, start)


@pytest.mark.slow
def test_large_rotations_use_the_complete_functions():
    # The stages rotate spins by more than one radian, and the iteration still converges.
    lattice = load_lattice(emit(chain(), "rkmk:gauss1", target="c", parameters=["K"]))
    start = np.tile([0.0, 0.0, 1.0], (5, 1)) + 1e-3 * states((5,))
    start /= np.linalg.norm(start, axis=-1, keepdims=True)
    result = lattice.run(start, 0.5, 4, K=4.0)
    assert result.ok
    assert np.abs(np.linalg.norm(result.states, axis=-1) - 1).max() < 1e-14


def moving_bodies(number):
    """Return states of bodies with random frames and momenta, of shape (number, 12)."""
    random = np.random.default_rng(1)
    frames, _ = np.linalg.qr(random.normal(size=(number, 3, 3)))
    frames *= np.sign(np.linalg.det(frames))[:, None, None]
    return np.concatenate([frames.reshape(number, 9), random.normal(size=(number, 3))], axis=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    "method",
    ["vcg:midpoint", "vcf:vcf4_s2", "vrkmk:gauss2", "vrkmk_pade(2):gauss2", "slgi:gauss2"],
)
def test_a_variational_step_is_the_step_of_the_product(method):
    lattice = load_lattice(emit(bodies(), method, target="c"))
    whole = joined(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    start, h = moving_bodies(4), 0.05
    found = lattice.run(start, h, 1)
    inputs = {"q": tuple(start[:, :9].ravel()), "mu": tuple(start[:, 9:].ravel())}
    end = interpret(lower(whole, method_for(whole, method)), whole, FloatDomain(h), inputs)
    expected = np.concatenate([np.reshape(end["q"], (4, 9)), np.reshape(end["mu"], (4, 3))], axis=1)
    assert np.abs(found.states - expected).max() < 2e-14


@pytest.mark.slow
def test_a_variational_method_conserves_the_momentum_of_a_free_chain():
    lattice = load_lattice(emit(springs(), "vcg:midpoint", target="c"))
    assert lattice.artifact.manifest["order"] == 2
    rest = moving_bodies(6)
    places = np.arange(18.0).reshape(6, 3) / 5
    start = np.concatenate([rest[:, :9], places, rest[:, 9:], rest[:, 9:] / 2], axis=1)
    result = lattice.run(start, 0.01, 300)
    assert result.ok
    moments = [x[:, 12:].sum(axis=0) for x in (start, result.states)]
    assert np.abs(moments[1] - moments[0]).max() < 1e-11
    assert np.abs(result.states[:, 12:] - start[:, 12:]).max() > 0.1


def test_other_solvers_are_refused():
    with pytest.raises(MethodError, match="first order in h for a chain or lattice; expected fixed point"):
        emit(oscillators(), "rk:gauss1", target="c", solver="simplified-newton")


def test_explain_shows_the_sweeps_that_are_repeated():
    answer = CliRunner().invoke(
        program, ["emit", "examples/lattice/spin_lattice.py", "-m", "rkmk:gauss1", "--explain"]
    )
    assert answer.exit_code == 0
    assert "loop 1: k0 = field(y); v1 = k0" in answer.output
    assert "loops 2 to 3 are repeated until the unknowns v1 converge at all sites" in answer.output
    assert "in each sweep of the equations of v1" in answer.output
    assert "the equations of v1: fixed point, 3 unknowns" in answer.output
