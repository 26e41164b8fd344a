"""The separation of mixed signals against their sources, and against fixed points of FastICA."""

from __future__ import annotations

import numpy as np
import pytest

from codegen import emit, load
from codegen.scenes import independent_components as ica


@pytest.fixture(scope="module")
def rows() -> np.ndarray:
    """Return the matrix at the end of a long run."""
    module = load(emit("independent_components", "rkmk(0):euler", "c"))
    return np.array(module.run(module.initial, 0.05, 4000)).reshape(3, 3)


def test_the_components_are_the_sources(rows):
    """The sources of a finite sample are correlated, so the correlations are not exactly 0 and 1."""
    found = rows @ np.array(ica.signals)
    correlations = np.corrcoef(found, np.array(ica.sources))[:3, 3:]
    assert np.abs(np.sort(np.abs(correlations), axis=1) - [0, 0, 1]).max() < 0.05


def test_the_rows_are_stationary_for_the_sum_of_kurtoses(rows):
    """E[y^3 x^T] = (symmetric matrix) W, the fixed points of symmetric FastICA, from the samples."""
    signals = np.array(ica.signals)
    cubes = (rows @ signals) ** 3 @ signals.T / ica.SAMPLES
    product = cubes @ rows.T
    assert np.abs(product - product.T).max() < 1e-10
    # W is the nearest rotation to -(E[y^3 x^T] - 3 W): a step of FastICA returns W.
    left, _, right = np.linalg.svd(3 * rows - cubes)
    assert np.abs(left @ right - rows).max() < 1e-9


def test_the_signals_are_white_and_mixed():
    signals = np.array(ica.signals)
    assert np.abs(signals @ signals.T / ica.SAMPLES - np.eye(3)).max() < 1e-13
    correlations = np.abs(np.corrcoef(signals, np.array(ica.sources))[:3, 3:])
    assert np.sort(correlations, axis=1)[:, 1].max() > 0.3
