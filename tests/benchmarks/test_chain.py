"""Benchmark of chains: the fit of the exponent, and a step of each method."""

import pytest

from benchmarks import chain as measured


def test_the_exponent_of_a_power_is_fitted():
    numbers = [4, 16, 100]
    assert abs(measured.exponent(numbers, [3.0 * n**1.5 for n in numbers]) - 1.5) < 1e-12


@pytest.mark.slow
def test_each_method_makes_steps():
    for method, solver in measured.METHODS:
        assert measured.seconds_of_a_step(measured.lattice(method, solver), 3, 0.0) > 0
