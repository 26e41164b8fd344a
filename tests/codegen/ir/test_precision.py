"""Constants are rounded once, to the nearest number of the format, and printed with the fewest digits."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from codegen.ir.number import Number
from codegen.ir.precision import DOUBLE, SINGLE, precision
from orderconds.errors import InputError, UnknownName
from tests.strategies import shipped

FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(FINITE)
def test_doubles_stay_and_are_spelled_by_repr(x):
    assert DOUBLE.round(x) == x
    assert float(DOUBLE.text(x)) == x


@given(st.floats(min_value=-3e38, max_value=3e38))
def test_singles_are_those_of_numpy(x):
    rounded = SINGLE.round(x)
    assert rounded == float(np.float32(x))
    assert np.float32(SINGLE.text(rounded)) == np.float32(x)
    assert len(SINGLE.text(rounded)) <= len(repr(rounded))


@given(st.fractions(max_denominator=10**30))
def test_both_formats_round_fractions_to_the_nearest(q):
    for p in (SINGLE, DOUBLE):
        unit = Fraction(2) ** max(math.frexp(float(q))[1] - p.bits, -149)
        assert abs(Fraction(p.round(q)) - q) <= unit / 2


def test_a_constant_is_not_rounded_to_a_double_first():
    """1 + 2^-24 is halfway; a little more, which a double cannot see, rounds up."""
    q = 1 + Fraction(1, 2**24) + Fraction(1, 2**80)
    assert np.float32(float(q)) == 1
    assert SINGLE.round(Number.rational(*q.as_integer_ratio())) == 1 + 2.0**-23


def test_algebraic_constants_are_rounded_once():
    field = shipped("gauss2")
    number = Number(field.ring, field.method.A[0][1])
    assert SINGLE.text(SINGLE.round(number)) == "-0.038675133"
    assert DOUBLE.text(DOUBLE.round(number)) == "-0.03867513459481288"


@pytest.mark.parametrize(("name", "largest"), [("single", 3.5e38), ("double", Fraction(10) ** 309)])
def test_a_constant_that_is_too_large_is_refused(name, largest):
    with pytest.raises(InputError, match="is too large for the type"):
        precision(name).round(largest)


def test_another_precision_is_refused():
    with pytest.raises(UnknownName, match="unknown precision half; expected double or single"):
        precision("half")
