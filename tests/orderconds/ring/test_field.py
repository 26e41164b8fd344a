"""Number fields: radicals collapse where they should, zero is decided, spellings and decimals are right."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import mpmath
import pytest
from flint import fmpq, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from orderconds.ring import QQ, Algebraic, Balls, PowerSeries
from orderconds.ring.embed import embedding
from orderconds.ring.tower import DegreeError, Tower

SMALL = st.integers(-6, 6)


def sqrt(tower: Tower, n: int, index: int = 2) -> Algebraic:
    return tower.root(tower.rational(n), index)


def test_sqrt_8_is_twice_sqrt_2_and_nothing_new_is_adjoined() -> None:
    tower = Tower()
    root = sqrt(tower, 2)
    field = tower.field
    assert sqrt(tower, 8) == 2 * root
    assert tower.field is field


def test_a_root_that_already_lies_in_the_field_is_recognised_there() -> None:
    tower = Tower()
    r, s = sqrt(tower, 2), sqrt(tower, 3)
    field = tower.field
    assert sqrt(tower, 6) == r * s
    assert tower.root(5 + 2 * r * s, 2) == r + s, "sqrt(5 + 2 sqrt(6)) denests"
    assert tower.root(7 + 5 * r, 3) == 1 + r
    assert tower.field is field


def test_the_sign_of_a_root_in_the_field_is_the_positive_one() -> None:
    tower = Tower()
    r = sqrt(tower, 2)
    assert tower.root(3 - 2 * r, 2) == r - 1, "not 1 - sqrt(2), whose square is the same"


def test_sqrt_2_plus_sqrt_3_has_minimal_polynomial_x4_10x2_1() -> None:
    tower = Tower()
    x = sqrt(tower, 2) + sqrt(tower, 3)
    assert x.minimal_polynomial == fmpq_poly([1, 0, -10, 0, 1])


def test_radicals_of_different_index_share_a_field() -> None:
    tower = Tower()
    sixth = sqrt(tower, 2, 6)
    assert sqrt(tower, 2) == sixth**3
    assert sqrt(tower, 2, 3) == sixth**2
    assert sqrt(tower, 4, 4) == sqrt(tower, 2)
    assert tower.field.degree == 6


def test_triple_nested_radicals() -> None:
    tower = Tower()
    inner = 1 + sqrt(tower, 2)
    middle = 1 + tower.root(inner, 2)
    outer = tower.root(middle, 2)
    assert ((outer**2 - 1) ** 2 - 1) ** 2 == 2
    assert tower.field.degree == 8
    assert float(outer) == pytest.approx((1 + (1 + 2**0.5) ** 0.5) ** 0.5, rel=1e-15)


def test_numbers_made_before_a_field_grew_stay_valid() -> None:
    tower = Tower()
    r = sqrt(tower, 2)
    s = sqrt(tower, 3)
    assert (r + s) * (s - r) == 1
    assert r * r * s == 2 * s


def test_the_theta_of_owren_and_marthinsen_solves_its_quadratic_equation() -> None:
    tower = Tower()
    T = sqrt(tower, 2, 3)
    u = 1 + T + T * T
    theta = (u + tower.root(105 + 88 * T + 71 * T * T, 2)) / 18
    assert tower.field.degree == 6
    assert tower.field.is_zero((18 * theta - u) ** 2 - (105 + 88 * T + 71 * T * T))
    assert tower.field.approximate(theta, 20) == "1.2207809582563879444"


def test_cube_roots_of_negative_numbers_are_real_and_square_roots_are_refused() -> None:
    tower = Tower()
    assert sqrt(tower, -8, 3) == -2
    assert sqrt(tower, -2, 3) == -sqrt(tower, 2, 3)
    with pytest.raises(ValueError, match="even root"):
        sqrt(tower, -2)
    with pytest.raises(ValueError, match="even root"):
        tower.root(sqrt(tower, 2) - 2, 4)


def test_a_named_root_keeps_its_name_and_real_embedding() -> None:
    minpoly = [Fraction(c) for c in (1, -3, 0, 1)]  # three real roots
    values = []
    for near in ("-1.88", "0.35", "1.53"):
        tower = Tower()
        x = tower.named_root(minpoly, Fraction(near), Fraction(1, 100), "x")
        assert x**3 - 3 * x + 1 == 0
        assert tower.field.text(x * x / 2) == "x^2/2"
        values.append(float(x))
    assert values == pytest.approx(sorted(float(r) for r in mpmath.polyroots([1, 0, -3, 1])), rel=1e-14)


@pytest.mark.parametrize("near", ["0.5", "9"])
def test_a_named_root_must_be_isolated(near: str) -> None:
    with pytest.raises(ValueError, match="real roots within"):
        Tower().named_root([Fraction(c) for c in (1, -3, 0, 1)], Fraction(near), Fraction(2), "x")


def test_fields_of_high_degree_are_refused() -> None:
    tower = Tower()
    for n in (2, 3, 5, 7):
        sqrt(tower, n)
    with pytest.raises(DegreeError):
        sqrt(tower, 11)


def test_balls_are_as_narrow_as_asked_even_where_digits_cancel() -> None:
    tower = Tower()
    x = (sqrt(tower, 2) - 1) ** 60
    assert x.field.ball(x, 200).rel_accuracy_bits() >= 200
    assert float(x) == pytest.approx((2**0.5 - 1) ** 60, rel=1e-13)


def test_division_by_zero_is_refused_even_when_zero_is_disguised() -> None:
    tower = Tower()
    r, s = sqrt(tower, 2), sqrt(tower, 3)
    with pytest.raises(ZeroDivisionError):
        1 / (sqrt(tower, 6) - r * s)


@st.composite
def numbers(draw: st.DrawFn) -> tuple[Algebraic, Any]:
    """An element of Q(2^(1/3), sqrt(1 + 2^(1/3))) and its value to 60 digits."""
    tower = Tower()
    T = sqrt(tower, 2, 3)
    r = tower.root(1 + T, 2)
    with mpmath.workdps(60):
        t = mpmath.cbrt(2)
        q = mpmath.sqrt(1 + t)
        c = [draw(SMALL) for _ in range(6)]
        d = draw(st.integers(1, 7))
        exact = (c[0] + c[1] * T + c[2] * T * T + (c[3] + c[4] * T + c[5] * T * T) * r) / d
        return exact, (c[0] + c[1] * t + c[2] * t * t + (c[3] + c[4] * t + c[5] * t * t) * q) / d


@settings(max_examples=40)
@given(pair=numbers(), other=numbers())
def test_field_axioms_hold_and_the_embedding_is_a_ring_map(pair: Any, other: Any) -> None:
    (x, fx), (y, fy) = pair, other
    assert (x + y) * (x - y) == x * x - y * y
    if x != 0:
        assert x / x == 1
        assert y / x * x == y
    with mpmath.workdps(60):
        for exact, value in ((x + y, fx + fy), (x * y, fx * fy), (x - y, fx - fy)):
            assert (
                abs(mpmath.mpf(exact.field.approximate(exact, 40)) - value)
                <= abs(value) * mpmath.mpf(10) ** -39
            )
            assert float(exact) == float(value)


@settings(max_examples=40)
@given(pair=numbers(), other=numbers())
def test_equality_hash_key_and_order_agree(pair: Any, other: Any) -> None:
    (x, fx), (y, fy) = pair, other
    assert (x == y) == (x.field.key(x) == y.field.key(y)) == x.field.is_zero(x - y)
    assert hash(x) == hash(x + y - y)
    if x != y:
        assert (x < y) == (fx < fy)
        assert x.field.sign(x - y) == (1 if fx > fy else -1)


def test_equal_radicals_of_different_towers_name_one_field() -> None:
    first, second = sqrt(Tower(), 2), sqrt(Tower(), 2)
    assert first + second == 2 * first
    assert first != sqrt(Tower(), 3)


def test_spelling_uses_the_generators() -> None:
    tower = Tower()
    r, T = sqrt(tower, 3), sqrt(tower, 2, 3)
    text = tower.field.text
    assert text(tower.field.lift(fmpq(1, 4) - r / 6)) == "1/4 - sqrt(3)/6"
    assert text(-T * T * 5 / 3) == "-5*2^(2/3)/3"
    assert text(tower.field.zero) == "0"
    x = tower.root(1 + T, 2)
    assert x.field.text(x) == "sqrt(1 + 2^(1/3))"
    with pytest.raises(TypeError):
        text(x)


def test_numbers_embed_in_balls_that_contain_them_and_in_series() -> None:
    tower = Tower()
    x = sqrt(tower, 2)
    for bits in (53, 300):
        balls = Balls(bits)
        y = embedding(tower.field, balls)(x)
        assert balls.is_zero(y * y - 2) is None
        assert y.value.rel_accuracy_bits() >= bits - 2
    series = PowerSeries(tower.field, 2)
    assert series.text(embedding(tower.field, series)(x) * series.h) == "sqrt(2)*h"
    assert series.is_zero(embedding(QQ, series)(fmpq(1, 2)) * 2 - 1)
    with pytest.raises(TypeError):
        embedding(balls, QQ)


def test_both_ways_to_divide_give_the_reciprocal() -> None:
    tower = Tower()
    x = tower.root(tower.rational(2), 5) + tower.root(tower.rational(3), 2) + 1
    assert x.field.degree == 10
    assert x._solved() == x._by_euclid() == x.reciprocal().polynomial
    assert x * x.reciprocal() == 1
    assert x.reciprocal() is x.reciprocal(), "remembered"
