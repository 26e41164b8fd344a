"""Balls as a ring of coefficients: roots, spellings, and what they refuse."""

from __future__ import annotations

import json
import operator
from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from orderconds import families
from orderconds.errors import InputError
from orderconds.ring import Ball, Balls
from orderconds.ring.balls import Enclosures
from orderconds.ring.decimals import endpoints, nearest_float
from orderconds.ring.precision import precision
from orderconds.ring.tower import Tower
from orderconds.tableau import RungeKutta, Tableau

RING = Balls(128)
SMALL = st.fractions(min_value=-9, max_value=9, max_denominator=12)


def test_roots_of_balls_contain_the_roots_of_their_points() -> None:
    for text, index in (("2", 2), ("2", 3), ("-2", 3), ("0", 2), ("0.3", 5)):
        x = RING.constant(Fraction(text))
        assert (RING.root(x, index) ** index - x).value.contains(0)
        assert RING.root(x, index).value.rel_accuracy_bits() > 100


@pytest.mark.parametrize(("text", "unit", "index"), [("-2", "0", 2), ("0.1", "1", 2), ("0.1", "1", 3)])
def test_roots_of_balls_of_wrong_or_unknown_sign_are_refused(text: str, unit: str, index: int) -> None:
    with pytest.raises(ValueError, match="root of a number"):
        RING.root(RING.constant(Fraction(text), Fraction(unit)), index)


def test_a_named_root_as_a_ball_is_the_one_near_its_decimal() -> None:
    minpoly = [Fraction(c) for c in (1, -3, 0, 1)]
    x = RING.named_root(minpoly, Fraction("0.35"), Fraction(1, 100), "x")
    assert (x**3 - 3 * x + 1).value.contains(0)
    assert float(x) == pytest.approx(0.347296355333860697, rel=1e-15)


def test_balls_are_equal_only_as_enclosures() -> None:
    third = RING.rational(1, 3)
    assert third == RING.rational(1, 3)
    assert hash(third) == hash(RING.rational(1, 3))
    assert third != 1 - RING.rational(2, 3)
    assert third != Fraction(1, 3)
    assert Balls(128) == RING
    assert Balls(64) != RING


def test_a_ball_tells_its_midpoint_and_radius() -> None:
    x = RING.constant(Fraction("0.25"), Fraction(1, 1000))
    assert RING.approximate(x) == "0.25"
    assert RING.radius(x) == "0.00100", "not exactly, since 1/1000 is no binary number"
    assert RING.nearest_float(x) == float(x) == 0.25
    assert RING.text(RING.constant(Fraction(12000), Fraction(30))) == "120~*10^2"


def test_balls_do_not_combine_with_what_is_no_number() -> None:
    x = RING.one
    for operation in (operator.add, operator.sub, operator.mul, operator.truediv):
        for other in ("1", 0.5):
            with pytest.raises(TypeError):
                operation(x, other)
            with pytest.raises(TypeError):
                operation(other, x)
    assert (fmpq(1, 2) - x).value.contains(fmpq(-1, 2))


def test_an_enclosure_is_refined_until_the_double_is_certain() -> None:
    asked = []

    def enclosure(bits: int) -> object:
        asked.append(bits)
        return (
            Balls(bits)
            .constant(1 + Fraction(1, 2**53) + Fraction(1, 2**200), Fraction(1, 2 ** (bits - 1)))
            .value
        )

    assert nearest_float(enclosure) == 1 + 2.0**-52, "just above the tie between two doubles"
    assert len(asked) > 1


def test_a_radicand_too_large_to_factor_keeps_its_size_but_loses_small_factors() -> None:
    tower = Tower()
    prime = 2**521 - 1
    x = tower.root(tower.rational(12 * prime), 2)
    assert x == 2 * tower.root(tower.rational(3 * prime), 2)
    assert tower.field.degree == 2
    low, high = endpoints(tower.field.ball(x, 64))
    assert low**2 <= 12 * prime <= high**2


@pytest.mark.parametrize("label", ["rk", "cg", "rkmk(2)", "vrkmk(2)"])
def test_bare_enclosures_give_the_same_balls(label: str) -> None:
    rows = [["0.5~"], ["0.2113248654~", "0.2886751345~"]]
    data = {"name": "balls", "family": "rk", "A": rows, "b": ["0.4999999999~", "0.5000000001~"]}
    tableau = Tableau.loads("\n".join(f"{key} = {json.dumps(value)}" for key, value in data.items()))
    family = families.get(label)
    conditions = family.conditions(3)
    values = family.evaluate(tableau.method, tableau.ring, conditions)
    exact = [families.in_ring(tableau.ring, condition.rhs) for condition in conditions]
    expected = tuple(x - y for x, y in zip(values, exact, strict=True))
    assert family.residuals(tableau.method, tableau.ring, conditions) == expected


def test_dividing_by_a_ball_around_zero_is_refused_where_a_block_is_bare() -> None:
    method = RungeKutta(((RING.zero,),), (RING.constant(Fraction(0), Fraction(1)),))
    with pytest.raises(InputError, match="may be zero"):
        families.get("sprk").residuals(method, RING, families.get("sprk").conditions(1))
    bare = Enclosures(128)
    with precision(128):
        assert not (bare.one / method.b[0].value).is_finite()
        assert bare.text(bare.rational(1, 3)) == RING.text(RING.rational(1, 3))
        assert bare.key(bare.one) == RING.key(RING.one)
        assert bare.approximate(bare.rational(1, 3)) == RING.approximate(RING.rational(1, 3))
        assert bare.is_zero(bare.rational(1, 3) - bare.rational(1, 3)) is None


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
