"""The discrete gradient method on S^3 over the time of Figure 2.7 of the thesis."""

from __future__ import annotations

import numpy as np
import pytest

from codegen import emit, load
from codegen.lab.pictures.source import formulas
from codegen.scenes import load as gallery

H, STEPS = 1 / 64, 64_000


@pytest.mark.slow
def test_the_discrete_gradient_keeps_the_energy_and_heun_does_not():
    scene, energies = gallery("free_rigid_body_s3"), {}
    energy = formulas(scene, ["energy"])
    for method in ("discrete_gradient:midpoint", "rkmk:heun"):
        module = load(emit(scene, method, "c"))
        states = np.asarray(module.trajectory(module.initial, H, STEPS, 1))
        energies[method] = energy(states.T, np.zeros(len(states)))[0]
        assert energies[method][0] == pytest.approx(31.125, rel=1e-15)
    kept, lost = (np.abs(row - 31.125).max() for row in energies.values())
    assert 0 < kept < 1e-11
    assert lost > 100
