"""Decimals and doubles of exact numbers, rounded once and correctly."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from orderconds.ring import QQ


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
