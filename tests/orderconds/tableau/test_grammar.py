"""Coefficients: what is written is what is meant, and nothing that is written runs."""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orderconds.errors import TableauError
from orderconds.ring import QQ, Balls, Element, Ring
from orderconds.ring.decimals import endpoints
from orderconds.tableau.evaluate import evaluate
from orderconds.tableau.grammar import parse


def value(text: str, **numbers: str) -> tuple[Ring, Element]:
    ring, values = evaluate({"x": parse(text)}, {k: parse(v) for k, v in numbers.items()}, "f")
    return ring, values["x"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1/2", "1/2"),
        ("0.5", "1/2"),
        (".125", "1/8"),
        ("2.", "2"),
        ("-2^2", "-4"),
        ("2^-2", "1/4"),
        ("2^(-2)", "1/4"),
        ("2*3^2", "18"),
        ("--1", "1"),
        ("1 - 2 - 3", "-4"),
        ("8/4/2", "1"),
        ("2/(-3)", "-2/3"),
        ("4^(1/2)", "2"),
        ("sqrt(9/4)", "3/2"),
        ("(-27)^(1/3)", "-3"),
        ("8^(-2/3)", "1/4"),
        ("0.1 + 0.2 - 0.3", "0"),
        ("sqrt(8) - 2*sqrt(2)", "0"),
        ("(2^(1/3))^3", "2"),
        ("a*b", "1/6"),
    ],
)
def test_arithmetic_means_what_it_says(text: str, expected: str) -> None:
    ring, x = value(text, a="1/2", b="a^2 + 1/12")
    spelled = ring.text(x)
    assert spelled == expected


def test_a_sum_of_radicals_that_vanishes_is_zero() -> None:
    ring, x = value("sqrt(2) + sqrt(3) - sqrt(5 + 2*sqrt(6))")
    assert ring.is_zero(x) is True


@given(p=st.integers(-(10**9), 10**9), q=st.integers(1, 10**9))
def test_fractions_round_trip(p: int, q: int) -> None:
    ring, x = value(f"{p}/{q}")
    assert ring is QQ
    assert value(QQ.text(x))[1] == x


@given(digits=st.text("0123456789", min_size=1, max_size=30), places=st.integers(0, 30))
def test_a_tilde_is_one_unit_in_the_last_digit(digits: str, places: int) -> None:
    text = digits.rjust(places + 1, "0")
    text = f"{text[: len(text) - places]}.{text[len(text) - places :]}"
    ring, x = value(text + "~")
    assert isinstance(ring, Balls)
    low, high = endpoints(x.value)
    centre, unit = Fraction(text), Fraction(1, 10**places)
    assert Fraction(int(low.p), int(low.q)) <= centre - unit
    assert Fraction(int(high.p), int(high.q)) >= centre + unit
    assert Fraction(int((high - low).p), int((high - low).q)) <= 2 * unit * Fraction(1001, 1000)


def test_one_tilde_makes_everything_balls_but_structural_zeros_stay() -> None:
    ring, values = evaluate({"x": parse("0.1~"), "y": parse("sqrt(2)"), "z": parse("0")}, {}, "f")
    assert isinstance(ring, Balls)
    assert [ring.is_zero(values[k]) for k in "xyz"] == [None, False, True]


def test_a_field_of_too_high_degree_becomes_balls() -> None:
    ring, x = value("sqrt(2) + sqrt(3) + sqrt(5) + sqrt(7) + sqrt(11)")
    assert isinstance(ring, Balls)
    assert ring.approximate(x, 15) == "11.3447084488618"


def test_equal_spellings_share_one_element() -> None:
    ring, values = evaluate({"x": parse("g"), "y": parse("g"), "z": parse("0.3~")}, {"g": parse("0.3~")}, "f")
    assert values["x"] is values["y"] is values["z"]
    assert ring.is_zero(values["x"]) is False


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("nan", "the name 'nan'"),
        ("inf", "the name 'inf'"),
        ("", "the end"),
        ("1 +", "the end"),
        ("1 2", "'2' at character 3"),
        ("1e5", "'e5'"),
        ("1//2", "'/'"),
        ("(1", "the end"),
        ("1)", "')'"),
        ("½", "'½'"),
        ("１", "'１'"),
        ("__import__('os').system('true')", '"\'"'),
        ("exp(1)", "'('"),
        ("[1]", "'['"),
        ("1/0", "division by zero"),
        ("1/(sqrt(2)*sqrt(3) - sqrt(6))", "division by zero"),
        ("0^-1", "division by zero"),
        ("2^(1/0)", "division by zero"),
        ("sqrt(-1)", "even root of a negative number"),
        ("sqrt(1 - sqrt(2))", "even root of a negative number"),
        ("9^9^9^9", "a power of a power"),
        ("9^999999999", "exponent 999999999"),
        ("2^(1/1000)", "exponent 1/1000"),
        ("((9^64)^64)^64", "is too large"),
        ("(((1 + sqrt(2))^64)^64)^64", "is too large"),
        ("2^sqrt(2)", "'sqrt'"),
        ("2^x", "'x'"),
        ("(" * 100 + "1" + ")" * 100, "more than 40 nested parentheses"),
        ("1+" * 2000 + "1", "a coefficient of 4001 characters"),
        ("0.5~~", "'~'"),
    ],
)
def test_what_is_no_coefficient_is_refused_with_its_place(text: str, complaint: str) -> None:
    with pytest.raises(TableauError) as caught:
        evaluate({"b[1]": parse(text, "f.toml: b[1]")}, {}, "f.toml")
    assert complaint in str(caught.value)
    assert str(caught.value).startswith("f.toml: b[1]: ")


def test_numbers_that_double_in_size_at_every_name_are_stopped() -> None:
    numbers = {"n0": "9^64", **{f"n{i}": f"n{i - 1}*n{i - 1}" for i in range(1, 30)}}
    with pytest.raises(TableauError, match="is too large"):
        value("n29", **numbers)


@pytest.mark.parametrize("text", ["(" * 39 + "1" + ")" * 39, "-" * 1999 + "1", "1" + "+1" * 999, "9" * 2000])
def test_long_but_bounded_coefficients_are_read(text: str) -> None:
    ring, _ = value(text)
    assert ring is QQ


@given(text=st.text(max_size=40))
def test_any_text_is_read_or_refused_and_nothing_else(text: str) -> None:
    with suppress(TableauError):
        value(text)


@given(text=st.text("0123456789.~+-*/^() sqrtx", max_size=25))
def test_any_near_coefficient_is_read_or_refused_and_nothing_else(text: str) -> None:
    with suppress(TableauError):
        value(text, x="1/3")
