"""Every ring satisfies the axioms of a commutative ring over Q, and of a field where it says so."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from flint import ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from orderconds.ring import QQ, Ball, Balls, Polynomials, PowerSeries, Residues, Ring
from orderconds.ring.decimals import endpoints

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


def encloses(x: Ball, exact: Any) -> bool:
    low, high = endpoints(x.value)
    return bool(low <= fmpq(exact.numerator, exact.denominator) <= high)


@given(f=SMALL, g=SMALL)
def test_ball_arithmetic_contains_the_exact_result(f: Any, g: Any) -> None:
    ring = Balls(60)
    p, q = (ring.rational(x.numerator, x.denominator) for x in (f, g))
    for found, exact in ((p + q, f + g), (p - q, f - g), (p * q, f * g)):
        assert encloses(found, exact)
    if g:
        assert encloses(p / q, f / g)


def test_a_ball_never_proves_zero_but_structural_zero_stays() -> None:
    ring = Balls(100)
    third = ring.rational(1, 3)
    assert ring.is_zero(third * 3 - 1) is None
    assert ring.is_zero(ring.zero * third) is True
    assert ring.is_zero(third) is False


def test_dividing_by_a_ball_that_contains_zero_is_refused() -> None:
    ring = Balls(100)
    with pytest.raises(ZeroDivisionError):
        ring.one / ring.around(fmpq(0), fmpq(1, 10))


def test_working_precision_belongs_to_the_ring_and_is_given_back() -> None:
    before = ctx.prec
    fine, coarse = Balls(500), Balls(40)
    assert (fine.one / 3).value.rel_accuracy_bits() > 480
    assert (coarse.one / 3).value.rel_accuracy_bits() < 45
    assert ctx.prec == before


@given(
    f=st.fractions(min_value=-100, max_value=100),
    digits=st.integers(3, 30),
    part=st.fractions(min_value=Fraction(1, 20), max_value=1, max_denominator=20),
)
def test_the_spelling_of_a_ball_encloses_it(f: Any, digits: int, part: Any) -> None:
    ring = Balls(200)
    x = ring.constant(f, part / 10**digits)
    text = ring.text(x)
    assert text.endswith("~")
    places = len(text.split(".")[1]) - 1 if "." in text else 0
    centre, unit = fmpq(int(text[:-1].replace(".", ""))) / fmpq(10) ** places, fmpq(1, 10**places)
    low, high = endpoints(x.value)
    assert centre - unit <= low <= high <= centre + unit


def test_a_geometric_series_sums_to_its_reciprocal() -> None:
    ring = PowerSeries(QQ, 6)
    assert (1 / (1 - 2 * ring.h)).coefficients == tuple(fmpq(2) ** k for k in range(7))
    assert ring.valuation(ring.h**3 * 5) == 3
    with pytest.raises(ZeroDivisionError):
        ring.one / ring.h


def test_series_of_series_and_series_of_polynomials_work_alike() -> None:
    ring = PowerSeries(POLYNOMIALS, 2)
    x, _ = POLYNOMIALS.generators
    assert ring.text((ring.constant(x) + ring.h) ** 2) == "x^2 + 2*x*h + h^2"


@given(p=st.integers(-(10**40), 10**40), q=st.integers(1, 10**40), digits=st.integers(1, 30))
def test_decimals_of_rationals_are_within_half_a_unit(p: int, q: int, digits: int) -> None:
    x = Fraction(p, q)
    text = QQ.approximate(fmpq(p, q), digits)
    spelled = Fraction(text)
    figures = text.lstrip("-").split("e")[0].replace(".", "").lstrip("0")
    assert len(figures.rstrip("0")) <= digits
    if x:
        exponent = len(str(abs(x.numerator))) - len(str(x.denominator))
        if abs(x) < Fraction(10) ** exponent:
            exponent -= 1
        assert 2 * abs(spelled - x) <= Fraction(10) ** (exponent - digits + 1)


def test_decimals_round_ties_to_even_and_carry() -> None:
    halves = [QQ.approximate(fmpq(n, 2), 1) for n in (1, 3, 5, 7, -5)]
    assert halves == ["0.5", "2", "2", "4", "-2"]
    assert QQ.approximate(fmpq(19999, 2), 4) == "10000"
    assert QQ.approximate(fmpq(1, 10**7), 3) == "1e-07"


@given(p=st.integers(-(10**25), 10**25), q=st.integers(1, 10**25))
def test_doubles_of_rationals_are_correctly_rounded(p: int, q: int) -> None:
    assert QQ.nearest_float(fmpq(p, q)) == float(Fraction(p, q))
