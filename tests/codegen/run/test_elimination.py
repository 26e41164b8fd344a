"""The elimination of the interpreter of emitted statements."""

from __future__ import annotations

import math
from itertools import product

import pytest

from codegen.run.elimination import inverted


def test_the_inverse_replaces_the_matrix():
    matrix = [0.0, 2.0, 4.0, 1.0]
    assert inverted(2, matrix) == 1
    assert matrix == [-0.125, 0.25, 0.5, 0.0]


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_a_matrix_that_is_not_finite_has_no_inverse_and_stays_so(value):
    """The caller reports NOT_FINITE if the array contains an infinity or a NaN afterwards."""
    for entries in product((0.0, 1.0, value), repeat=4):
        matrix = list(entries)
        if not all(map(math.isfinite, entries)):
            assert inverted(2, matrix) == 0
            assert not all(map(math.isfinite, matrix))


def test_a_singular_matrix_has_no_inverse_and_stays_finite():
    matrix = [1.0, 2.0, 2.0, 4.0]
    assert inverted(2, matrix) == 0
    assert all(map(math.isfinite, matrix))
