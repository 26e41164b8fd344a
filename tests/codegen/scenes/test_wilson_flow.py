"""The Wilson flow of a plaquette against the flow of the phases of its eigenvalues."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codegen import emit, load
from codegen.ir.domain import FloatDomain
from codegen.scenes import load as gallery
from tests.codegen.scenes.test_gallery import kept


def links(state):
    """Return the four complex matrices of a state."""
    parts = np.array([float(x) for x in state]).reshape(4, 6, 3)
    return parts[:, :3] + 1j * parts[:, 3:]


def phases(state):
    """Return the phases of the eigenvalues of the plaquette."""
    a, b, c, d = links(state)
    return np.angle(np.linalg.eigvals(a @ b @ c.conj().T @ d.conj().T))


def action(angles):
    return 2 * (1 - np.cos(angles)).sum()


def falling(t, angles):
    """The plaquette commutes with its generator, so each phase follows -4 (sin angle - mean)."""
    return -4 * (np.sin(angles) - np.sin(angles).mean())


def start():
    return gallery("wilson_flow").initial(FloatDomain(0.0))


def test_the_phases_of_the_plaquette_follow_their_own_equation():
    before, after = phases(start()), phases(kept("wilson_flow"))
    expected = solve_ivp(falling, (0, 1), before, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    assert np.abs(np.sort(expected) - np.sort(after)).max() < 1e-9
    assert action(before) > 7
    assert action(after) < 0.03


def test_the_links_are_special_unitary():
    for link in (*links(start()), *links(kept("wilson_flow"))):
        assert np.abs(link.conj().T @ link - np.eye(3)).max() < 1e-14
        assert abs(np.linalg.det(link) - 1) < 1e-14


@pytest.mark.slow
@pytest.mark.parametrize(("method", "order"), [("cf:luescher3", 3), ("rkmk(2):rk4", 4)])
def test_the_action_converges_to_its_richardson_reference(method, order):
    module = load(emit("wilson_flow", method, "c"))
    states = [module.run(module.initial, 1 / steps, steps) for steps in (40, 80, 160, 320, 640)]
    found = [action(phases(state)) for state in states]
    reference = found[-1] + (found[-1] - found[-2]) / (2**order - 1)
    assert abs(reference - action(phases(kept("wilson_flow")))) < 1e-11
    assert abs(found[-1] - reference) < 1e-8
    ratio = (found[1] - reference) / (found[2] - reference)
    assert abs(np.log2(ratio) - order) < 0.2
    for link in links(module.run(module.initial, 1 / 100, 10_000)):
        assert np.abs(link.conj().T @ link - np.eye(3)).max() < 1e-13
