"""Numbers of many digits as balls: the same values as mpmath numbers."""

from __future__ import annotations

from fractions import Fraction

import pytest

from codegen.ir.ball_domain import BallDomain
from codegen.ir.domain import NotConverged, PreciseDomain
from codegen.ir.elementary import MATHEMATICAL

BALLS, EXACT = BallDomain(Fraction(1, 3), 50), PreciseDomain(Fraction(1, 3), 60)
FUNCTIONS = [*MATHEMATICAL, *(f"stumpff{k}" for k in range(4)), *(f"slope{k}" for k in (1, 2, 3))]
POINTS = ("0", "1e-300", "1e-9", "0.3", "0.9999999999", "1", "1.0000000001", "7.5", "1000.5", "1e15")


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize("point", POINTS)
def test_a_function_has_the_value_of_mpmath(function: str, point: str) -> None:
    x = EXACT.context.mpf(point)
    expected = EXACT.call(function, x) if (function, point) != ("log", "0") else None
    with BALLS.precision():
        if not isinstance(expected, EXACT.context.mpf):
            with pytest.raises(ValueError, match="is not a finite real number"):
                BALLS.call(function, BALLS.scalar(x))
            return
        found = BALLS.mpf(BALLS.call(function, BALLS.scalar(x)), EXACT.context)
    assert abs(found - expected) <= abs(expected) * EXACT.context.mpf(10) ** -49


@pytest.mark.parametrize("x", [0.0, -2.5, 1e-300, 5e-324, 1.7e308, Fraction(-3, 8)])
def test_numbers_are_converted_exactly_and_back(x: float | Fraction) -> None:
    with BALLS.precision():
        back = BALLS.mpf(BALLS.scalar(x), EXACT.context)
        again = BALLS.mpf(BALLS.scalar(back), EXACT.context)
    assert Fraction(float(back)) == Fraction(x)
    assert again == back


def test_what_is_not_finite_ends_an_iteration_or_a_call() -> None:
    with BALLS.precision():
        infinite = BALLS.scalar(float("inf"))
        with pytest.raises(NotConverged, match="not finite"):
            BALLS.settled([infinite], [infinite], None)
        with pytest.raises(NotConverged, match="the argument of sin"):
            BALLS.call("sin", infinite)
        with pytest.raises(OverflowError, match="an argument of sin"):
            BALLS.call("sin", BALLS.scalar(EXACT.context.mpf(2) ** 20000))


def test_an_iteration_has_converged_when_small_changes_no_longer_decrease() -> None:
    with BALLS.precision():
        one, near = BALLS.rational(1), BALLS.rational(1) + BALLS.eps
        assert BALLS.settled([one], [one], None)[0]
        done, change = BALLS.settled([one], [near], None)
        assert not done
        assert BALLS.settled([one], [near], change)[0]
        assert not BALLS.settled([one], [BALLS.rational(2)], change)[0]


@pytest.mark.parametrize("function", ["expm3", "expm3_d1", "expm2_d2", "inverse4"])
@pytest.mark.parametrize("size", ["1e-9", "1", "30"])
def test_a_vector_function_has_the_value_of_mpmath(function: str, size: str) -> None:
    count = {"expm3": 9, "expm3_d1": 18}.get(function, 16)
    numbers = [EXACT.context.mpf(size) * (k % 7 + k % 5 - 4) for k in range(1, count + 1)]
    expected = EXACT.vector(function, numbers)
    with BALLS.precision():
        found = [BALLS.mpf(x, EXACT.context) for x in BALLS.vector(function, [*map(BALLS.scalar, numbers)])]
    scale = max(map(abs, expected))
    assert (
        max(abs(x - y) for x, y in zip(found, expected, strict=True)) <= scale * EXACT.context.mpf(10) ** -49
    )
