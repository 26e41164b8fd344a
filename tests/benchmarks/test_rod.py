"""Benchmark of rods: the emitted rod converges with the number of steps and with the number of pieces."""

import math

import pytest

from benchmarks import rod as measured


@pytest.mark.slow
def test_the_best_number_of_steps_has_the_required_error():
    program = measured.Emitted("splitting:strang")
    steps, error, _, fine = measured.best(program, 10, 1)
    assert error < measured.ERROR
    fewer, _ = program.run(10, int(steps / measured.RATIO**2))
    assert not math.dist(fewer, fine) < measured.ERROR


@pytest.mark.slow
def test_the_tip_converges_with_order_two_in_the_number_of_pieces():
    program = measured.Emitted("splitting:strang")
    tips = [program.run(n, 4000)[0] for n in (16, 32, 64)]
    ratio = math.dist(tips[0], tips[1]) / math.dist(tips[1], tips[2])
    # N pieces have the length 1/(N + 1/2), so the ratio is not exactly 4.
    assert 3.6 < ratio < 4.2


def test_the_slope_is_that_of_a_line():
    assert measured._slope([0.0, 1.0, 2.0], [1.0, 3.0, 5.0]) == 2
