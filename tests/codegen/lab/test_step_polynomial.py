"""Taylor polynomials of solutions, and the signs of functions along solutions."""

from __future__ import annotations

import pytest
from flint import arb, arb_series

from codegen.ir.elementary import ANGLE
from codegen.lab.ambient_field import FUNCTIONS
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.step_polynomial import SERIES, StepPolynomial, Undecided
from orderconds.ring.precision import precision

BITS = 200


def oscillator(y: Vector, t: Scalar) -> Vector:
    return y[1], -y[0]


def polynomial() -> StepPolynomial:
    return StepPolynomial(oscillator, (arb(1), arb(0)), arb(0))


def test_the_polynomial_of_an_oscillator_is_that_of_cosine_and_sine() -> None:
    with precision(BITS):
        x, y = polynomial().at(arb("0.5"))
        assert abs(x - arb("0.5").cos()) < 1e-44
        assert abs(y + arb("0.5").sin()) < 1e-44


@pytest.mark.parametrize("width", [1e-2, 1e-5, 1e-9])
def test_a_short_interval_with_a_negative_value_is_bracketed(width: float) -> None:
    # The function is negative while |x - 9/10| < width.
    def dip(y: Vector, t: Scalar) -> Vector:
        return ((y[0] - arb("0.9")) * (y[0] - arb("0.9")) - arb(width) * arb(width),)

    with precision(BITS):
        bracket = polynomial().first_exit(dip, dip, arb("0.8"))
        assert bracket is not None
        a, b = bracket
        first, last = ((arb("0.9") + s * arb(width)).acos() for s in (1, -1))
        assert a < first < b < last


def test_a_function_that_touches_zero_does_not_become_negative() -> None:
    def touching(y: Vector, t: Scalar) -> Vector:
        return ((y[0] - arb("0.9")) * (y[0] - arb("0.9")),)

    with precision(BITS):
        assert polynomial().first_exit(touching, touching, arb("0.8")) is None


@pytest.mark.parametrize("radius", [1e-29, 1e-20, 1e-10, float("nan")])
def test_a_value_of_uncertain_sign_at_the_end_is_not_proved_to_be_non_negative(radius: float) -> None:
    # The ball of the value at the end of the step contains numbers of both signs.
    def uncertain(y: Vector, t: Scalar) -> Vector:
        return (y[0] - arb("0.8").cos() + arb(0, radius),)

    with precision(BITS), pytest.raises(Undecided):
        polynomial().first_exit(uncertain, uncertain, arb("0.8"))


def test_a_change_of_sign_before_an_uncertain_end_is_found() -> None:
    # The function is negative from t = acos(0.9) on, and its error bound at the end of the step is 1.
    def uncertain(y: Vector, t: Scalar) -> Vector:
        ends = not isinstance(t, arb_series) and t.contains(arb("0.8"))
        return (y[0] - arb("0.9") + arb(0, 1 if ends else 0),)

    with precision(BITS):
        bracket = polynomial().first_exit(uncertain, uncertain, arb("0.8"))
        assert bracket is not None
        a, b = bracket
        assert a < arb("0.9").acos() < b < arb("0.8")


def test_a_function_that_oscillates_without_end_is_undecided() -> None:
    def wild(y: Vector, t: Scalar) -> Vector:
        z = t - arb(1) / 3
        return (z * z * (1 + (SERIES if isinstance(t, arb_series) else FUNCTIONS)["sin"](1 / z)),)

    with precision(BITS), pytest.raises(Undecided):
        polynomial().first_exit(wild, wild, arb("0.8"))


@pytest.mark.parametrize("name", sorted(n for n in SERIES if n != ANGLE))
def test_functions_of_series_agree_with_functions_of_balls(name: str) -> None:
    with precision(BITS):
        series = SERIES[name](arb_series([arb("0.4"), arb("0.01")]))
        value = sum((series[k] for k in range(8)), arb(0))
        assert abs(value - FUNCTIONS[name](arb("0.41"))) < 1e-10
        assert abs(SERIES[name](arb("0.4"))[0] - FUNCTIONS[name](arb("0.4"))) < 1e-50


def test_the_angle_of_series_agrees_with_the_angle_of_balls() -> None:
    with precision(BITS):
        series = SERIES[ANGLE](arb_series([arb(1), arb("0.01")]), arb_series([arb(-2), arb("0.02")]))
        value = sum((series[k] for k in range(8)), arb(0))
        assert abs(value - FUNCTIONS[ANGLE](arb("1.01"), arb("-1.98"))) < 1e-14
