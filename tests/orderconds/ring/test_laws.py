"""Every ring satisfies the axioms of a commutative ring over Q, and of a field where it says so."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orderconds.ring import QQ, Polynomials, PowerSeries, Residues, Ring

SMALL = st.fractions(min_value=-9, max_value=9, max_denominator=12)
SERIES = PowerSeries(QQ, 4)
POLYNOMIALS = Polynomials(["x", "y"])
RESIDUES = Residues(10007, 3)


def elements(ring: Ring) -> st.SearchStrategy[Any]:
    numbers = SMALL.map(lambda f: ring.rational(f.numerator, f.denominator))
    if ring is SERIES:
        return st.lists(numbers, min_size=5, max_size=5).map(
            lambda cs: sum((c * SERIES.h**k for k, c in enumerate(cs)), SERIES.zero)
        )
    if ring is POLYNOMIALS:
        x, y = POLYNOMIALS.generators
        return st.tuples(numbers, numbers, numbers).map(lambda c: c[0] + c[1] * x + c[2] * x * y)
    return numbers


EXACT = [QQ, SERIES, POLYNOMIALS, RESIDUES]
RINGS = pytest.mark.parametrize("ring", EXACT, ids=lambda r: r.name)


@RINGS
@given(data=st.data())
def test_addition_and_multiplication_are_associative_commutative_and_distributive(
    ring: Ring, data: st.DataObject
) -> None:
    x, y, z = (data.draw(elements(ring)) for _ in range(3))
    assert ring.is_zero((x + y) + z - (x + (y + z)))
    assert ring.is_zero((x * y) * z - x * (y * z))
    assert ring.is_zero(x * y - y * x)
    assert ring.is_zero(x * (y + z) - (x * y + x * z))


@RINGS
@given(data=st.data())
def test_zero_one_and_integers_act_as_they_should(ring: Ring, data: st.DataObject) -> None:
    x = data.draw(elements(ring))
    assert ring.is_zero(x + ring.zero - x)
    assert ring.is_zero(x * ring.one - x)
    assert ring.is_zero(3 * x - x - x - x)
    assert ring.is_zero((2 - x) + (x - 2))
    assert ring.is_zero(-x + x)
    assert not ring.is_zero(ring.one)


@RINGS
@given(data=st.data())
def test_equal_elements_have_equal_keys(ring: Ring, data: st.DataObject) -> None:
    x, y = data.draw(elements(ring)), data.draw(elements(ring))
    assert ring.key((x + y) - y) == ring.key(x)
    assert (ring.key(x) == ring.key(y)) == ring.is_zero(x - y)


@pytest.mark.parametrize("ring", [QQ, SERIES, RESIDUES], ids=lambda r: r.name)
@given(f=SMALL.filter(bool), data=st.data())
def test_division_inverts_multiplication(ring: Ring, f: Any, data: st.DataObject) -> None:
    x, unit = data.draw(elements(ring)), ring.rational(f.numerator, f.denominator)
    if ring is SERIES:
        unit = unit + SERIES.h
    assert ring.is_zero(x / unit * unit - x)
    assert ring.is_zero(1 / unit * unit - ring.one)
