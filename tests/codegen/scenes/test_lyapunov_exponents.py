"""The Lyapunov exponents of Lorenz's system from emitted frames, and what the frame keeps."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from codegen import emit, load
from codegen.scenes.lyapunov_exponents import lyapunov

EXPONENTS = (0.9056, 0, -14.5723)
END, STEPS = 1000, 100_000


@cache
def final(k: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the frame and the integrals of k exponents at the end time."""
    module = load(emit(lyapunov(k), "rkmk(2):rk4", "c"))
    state = np.array(module.run(module.initial, END / STEPS, STEPS))
    return state[: 3 * k].reshape(3, k), state[-k:]


@pytest.mark.parametrize("k", [3, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 2))])
def test_the_means_of_the_integrals_are_the_exponents(k):
    frame, integrals = final(k)
    assert np.abs(integrals / END - EXPONENTS[:k]).max() < 0.01
    assert np.abs(frame.T @ frame - np.eye(k)).max() < 1e-12


def test_the_sum_of_all_exponents_is_the_trace_of_the_jacobian():
    """The trace -sigma - 1 - beta is constant."""
    assert abs(final(3)[1].sum() / END + 10 + 1 + 8 / 3) < 1e-10
