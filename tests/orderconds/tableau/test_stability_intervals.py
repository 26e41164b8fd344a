"""Stability intervals: exact ends, multiple zeros, poles, balls, and samples of the stability function."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from orderconds.ring import QQ, Balls
from orderconds.ring.tower import Tower
from orderconds.tableau import RungeKutta, Tableau, find
from orderconds.tableau.stability import Limited, Undecided, determinants, product
from orderconds.tableau.stability_intervals import Intervals, _odd_part, stability_intervals


def rationals(*numbers: int | str | Fraction) -> list[fmpq]:
    return [QQ.rational(*Fraction(x).as_integer_ratio()) for x in numbers]


def of(name: str) -> Intervals:
    tableau = Tableau.load(find(name))
    return stability_intervals(*determinants(tableau.abelian(), tableau.ring), tableau.ring)


def times(*factors: list[Fraction | int]) -> list[Fraction | int]:
    result: list[Fraction | int] = [1]
    for factor in factors:
        longer: list[Fraction | int] = [0] * (len(result) + len(factor) - 1)
        for i, x in enumerate(result):
            for j, y in enumerate(factor):
                longer[i + j] += x * y
        result = longer
    return result


@pytest.mark.parametrize(
    ("name", "real", "imaginary"),
    [
        ("rk4", 2.785293563405282, 2 * math.sqrt(2)),
        ("euler", 2.0, 0.0),
        ("kutta3", 2.512745326618329, math.sqrt(3)),
        ("merson4", 3.548322344234674, 2 * math.sqrt(3)),
        ("gauss2", math.inf, math.inf),
        ("radau2a3", math.inf, math.inf),
        ("hammer_hollingsworth3", 6.0, 0.0),
        ("triple_jump", 1.1344240041075249, math.inf),
    ],
)
def test_known_intervals(name: str, real: float, imaginary: float) -> None:
    found = of(name)
    assert found.real == pytest.approx(real, rel=1e-14)
    assert found.imaginary == pytest.approx(imaginary, rel=1e-14)


EXCEEDING = [
    *("verner8_efficient", "verner7_efficient", "butcher6", "luther6", "cash_karp5", "lawson5", "cg43"),
    *("fehlberg5", "nystrom5", "england5", "ees25", "cg4", "explicit_midpoint"),
]


@pytest.mark.parametrize("name", EXCEEDING)
def test_a_small_excess_on_the_imaginary_axis_is_an_excess(name: str) -> None:
    """|R(iy)| exceeds 1 for all small y > 0, but by as little as 10^-18."""
    assert of(name).imaginary == 0.0


@pytest.mark.parametrize("distance", ["1/200", "1/1000000", "1/1000000000000000000000"])
def test_a_theta_method_that_is_almost_a_stable_is_bounded(distance: str) -> None:
    """R = (1 + (1 - a) z)/(1 - a z) with a = 1/2 - d: the real interval is [-1/d, 0]."""
    d = Fraction(distance)
    a = Fraction(1, 2) - d
    found = stability_intervals(rationals(1, 1 - a), rationals(1, -a), QQ)
    assert found == Intervals(float(1 / d), 0.0)
    a = Fraction(1, 2) + d
    assert stability_intervals(rationals(1, 1 - a), rationals(1, -a), QQ) == Intervals(math.inf, math.inf)


def test_equality_at_a_multiple_zero_does_not_end_an_interval() -> None:
    """R = 1 - x (1 - x/4)^2 (1 - x/9)/4 on x = -z: R = 1 at x = 4 without a change of sign, R > 1 after 9."""
    P = times([0, 1], [1, Fraction(1, 4)], [1, Fraction(1, 4)], [1, Fraction(1, 9)])
    scaled = [Fraction(x) / 4 for x in P]
    found = stability_intervals(rationals(1, *scaled[1:]), rationals(1), QQ)
    assert found.real == 9.0


def test_a_double_zero_in_a_number_field_does_not_end_an_interval() -> None:
    """R = 1 - x (1 - x/sqrt(2))^2 (1 - x/3)/4 on x = -z."""
    tower = Tower()
    root = tower.root(tower.rational(2), 2)
    field = tower.field
    P = [field.one, field.one / 4]
    for factor in (field.one / root, field.one / root, field.one / 3):
        tail = product([field.zero, *P[1:]], [field.one, factor], field)
        P = [field.one, *tail[1:]]
    assert stability_intervals(P, [field.one], field).real == 3.0


def test_an_interval_ends_before_a_pole() -> None:
    """Both functions have a pole at z = -1. The first one exceeds 1 from the start."""
    assert stability_intervals(rationals(1), rationals(*times([1, 1])), QQ).real == 0.0
    found = stability_intervals(rationals(1, 2), rationals(1, 1), QQ)
    # |1 - 2x| <= |1 - x| up to x = 2/3, before the pole.
    assert found.real == pytest.approx(2 / 3, rel=1e-15)


def test_common_factors_change_nothing() -> None:
    factor: list[Fraction | int] = [1, Fraction(1, 2), 3]
    P: list[Fraction | int] = [1, Fraction(1, 2)]
    Q: list[Fraction | int] = [1, Fraction(-1, 2), Fraction(1, 12)]
    plain = stability_intervals(rationals(*P), rationals(*Q), QQ)
    common = stability_intervals(rationals(*times(P, factor)), rationals(*times(Q, factor)), QQ)
    assert plain == common


def test_balls_decide_only_what_holds_for_all_their_numbers() -> None:
    ring = Balls(128)
    half = ring.around(fmpq(1, 2), fmpq(1, 10**20))
    P, Q = [ring.one, half], [ring.one, -half]
    assert stability_intervals(P, Q, ring) == Intervals(None, None)
    exact = [ring.one, ring.one, half, ring.rational(1, 6), ring.rational(1, 24)]
    assert stability_intervals(exact, [ring.one], ring).imaginary is None
    proved = stability_intervals(exact, [ring.one], ring, order=4)
    assert proved.real == pytest.approx(2.785293563405282, rel=1e-12)
    assert proved.imaginary == pytest.approx(math.sqrt(8), rel=1e-12)
    wide = ring.around(fmpq(1, 2), fmpq(1, 100))
    assert stability_intervals([ring.one, ring.one, wide], [ring.one], ring).real is None


def test_a_length_outside_the_range_of_doubles_is_undecided() -> None:
    large = Fraction(1, 10**400)
    a = Fraction(1, 2) - large
    assert stability_intervals(rationals(1, 1 - a), rationals(1, -a), QQ).real is None
    assert stability_intervals(rationals(1, 10**400), rationals(1), QQ).real is None


SMALL = st.fractions(min_value=-2, max_value=2, max_denominator=6)


@given(st.lists(SMALL, min_size=6, max_size=6))
def test_the_ends_agree_with_samples(entries: list[Fraction]) -> None:
    a, b, c, d, e, f = rationals(*entries)
    P, Q = determinants(RungeKutta(((a, b), (c, d)), (e, f)), QQ)
    found = stability_intervals(P, Q, QQ)
    for length, unit in ((found.real, -1.0), (found.imaginary, 1j)):
        assert length is not None
        top = 1000.0 if math.isinf(length) else length
        samples = [top * k / 20 for k in range(1, 20)] if length else []
        assert all(size(P, x * unit) <= size(Q, x * unit) * (1 + 1e-9) for x in samples)
        if math.isfinite(length):
            # The interval is the largest one: close behind its end, the modulus is above 1.
            beyond = [Fraction(length) + Fraction(1, 10**k) for k in (9, 10, 11)]
            assert any(exceeds(P, Q, x, unit == 1j) for x in beyond)


def size(p: list[fmpq], z: complex) -> float:
    return abs(sum(float(Fraction(int(c.p), int(c.q))) * z**k for k, c in enumerate(p)))


def exceeds(P: list[fmpq], Q: list[fmpq], x: Fraction, on_axis: bool) -> bool:
    def square(p: list[fmpq]) -> Fraction:
        c = [Fraction(int(a.p), int(a.q)) for a in p]
        if not on_axis:
            return sum((a * (-x) ** k for k, a in enumerate(c)), Fraction(0)) ** 2
        real = sum((a * x**k * (-1) ** (k // 2) for k, a in enumerate(c) if k % 2 == 0), Fraction(0))
        imaginary = sum((a * x**k * (-1) ** (k // 2) for k, a in enumerate(c) if k % 2), Fraction(0))
        return real**2 + imaginary**2

    return square(P) > square(Q)


def test_an_unknown_sign_at_zero_is_undecided() -> None:
    # The signs of both coefficients are known, but the ball of their quotient contains zero.
    ring = Balls(128)
    wide, narrow = ring.around(fmpq(1), fmpq(99, 100)), ring.around(fmpq(1), fmpq(1, 10))
    with pytest.raises(Undecided):
        _odd_part([wide, narrow], Limited(ring))
