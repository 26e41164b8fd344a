"""The measure of the dipole (thesis Fig. 3.2) and of the sphere, by hand."""

from __future__ import annotations

import math

import pytest

from codegen.lab.distance import distance, spectral_norm
from codegen.scenes import load


def test_the_dipole_adds_the_spectral_norm_of_g_and_the_euclidean_norm_of_mu() -> None:
    state = [0.0] * 12
    exact = [1.0, 0, 0, 0, -3.0, 0, 0, 0, 2.0, 0, 3.0, 4.0]
    assert distance(load("dipole"), state, exact) == pytest.approx(3 + 5, rel=1e-15)


def test_the_sphere_takes_the_chord() -> None:
    assert distance(load("free_rigid_body"), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)) == math.sqrt(2)


def test_a_vector_of_four_numbers_is_no_matrix() -> None:
    exact = [0.0] * 8
    assert distance(load("linear_oscillator"), [1.0, 2, 2, 4, 0, 0, 0, 2], exact) == 5 + 2


def test_the_spectral_norm_of_a_rotation_is_one() -> None:
    c, s = math.cos(0.7), math.sin(0.7)
    assert spectral_norm([c, -s, 0, s, c, 0, 0, 0, 1]) == pytest.approx(1, abs=1e-15)


def test_a_state_that_is_not_finite_is_infinitely_far() -> None:
    assert distance(load("free_rigid_body"), (math.nan, 0.0, 0.0), (0.0, 1.0, 0.0)) == math.inf
