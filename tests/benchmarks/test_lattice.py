"""Benchmark of lattices: the loops written by hand and the step in NumPy make the emitted steps."""

import numpy as np
import pytest

from benchmarks import lattice as measured
from codegen import emit, load_lattice


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cf4", "strang"])
def test_hand_written_loops_make_the_emitted_steps(name):
    rows, difference = measured.compared(name, 8, 3)
    assert len(rows) == 3
    assert difference < 1e-14


@pytest.mark.slow
def test_the_step_in_numpy_is_the_emitted_step():
    spins = np.random.default_rng(1).normal(size=(6, 4, 3))
    spins /= np.linalg.norm(spins, axis=-1, keepdims=True)
    lattice = load_lattice(emit(measured.SCENE, "cf:cf4", target="c"))
    moved = measured.numpy_step()(np.moveaxis(spins, -1, 0), 0.1)
    assert np.abs(np.moveaxis(moved, 0, -1) - lattice.run(spins, 0.1, 1).states).max() < 1e-14
