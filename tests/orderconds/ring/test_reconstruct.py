"""Fractions from residues modulo two primes."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orderconds.ring.reconstruct import rational_number
from orderconds.ring.residues import PRIMES

SIZE = 2**30


@given(st.integers(-SIZE, SIZE), st.integers(1, SIZE))
def test_a_fraction_comes_back_from_its_residues(p, q):
    assert rational_number([p * pow(q, -1, m) % m for m in PRIMES], PRIMES) == Fraction(p, q)


def test_residues_of_no_small_fraction_are_refused():
    # Modulo 11 the fractions with |p|, q <= 2 are 0, 1, 2, -1, -2, 6 = 1/2 and 5 = -1/2.
    found = {x: rational_number([x], [11]) for x in (0, 1, 2, 5, 6, 9, 10)}
    assert list(found.values()) == [0, 1, 2, Fraction(-1, 2), Fraction(1, 2), -2, -1]
    with pytest.raises(ArithmeticError):
        rational_number([3], [11])
