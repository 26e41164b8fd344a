"""Rounding errors are relative to the size of each coordinate, and the rounding of the time is named."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from sympy import Integer, Matrix, Rational, cos, sin, symbols

from codegen.certify import CertifiedOrder
from codegen.groups import LeftMultiplication, Rn
from codegen.lab.orders.convergence import Convergence, converge
from codegen.lab.orders.run_noise import LATE, Noise
from codegen.lab.reference import reference
from codegen.lab.runner import runner
from codegen.method import parse
from codegen.scene import FieldScene
from codegen.scene.problem import Problem

t, x, y = (symbols(name, real=True) for name in "txy")


def scene(field: Sequence[object], start: Sequence[object], first: int = 0) -> Problem:
    return FieldScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=Matrix([x, y]),
        f=Matrix(field),
        y0=Matrix(start),
        span=(first, first + 2),
        name="s",
    )


def measured(problem: Problem, digits: int = 16) -> Convergence:
    stated, target = CertifiedOrder(4, "exact"), "c" if digits == 16 else "interpreter"
    method = parse("rkmk:rk4", ("rkmk",))
    return converge(runner(problem, method, target, digits, stated), stated, reference(problem))


@pytest.mark.parametrize("exponent", [12, 30])
def test_a_small_state_is_measured_like_a_large_one(exponent: int) -> None:
    small = Rational(1, 10**exponent)
    found = measured(scene([y, -sin(x / small) * small], [small, 0]))
    assert found.verdict == "holds", found.sentence()
    assert all(not run.excluded for run in found.refinement.runs)


def test_a_large_coordinate_does_not_hide_the_errors_of_a_small_one() -> None:
    found = measured(scene([10**12 + 0 * x, -(y**2) * (1 + t)], [0, 1]))
    assert found.verdict == "holds", found.sentence()


def test_rounding_errors_of_a_large_coordinate_are_still_rounding_errors() -> None:
    """The large coordinate is inexact in every run, so the distance to the reference is rounding."""
    found = measured(scene([10**12 * cos(t) / 7, -(y**2) * Rational(1, 10**9)], [10**12, 1]))
    assert found.verdict == "holds", found.sentence()
    found = measured(scene([10**12 * cos(t) / 7 - x / 3, -(y**2) / 10**9], [10**12, 1]))
    assert found.verdict == "holds", found.sentence()


@pytest.mark.parametrize("first", [10**12, 10**15])
def test_a_late_start_is_named_as_the_reason_and_more_digits_decide(first: int) -> None:
    problem = scene([y, -sin(x) + cos(t)], [1, 0], first)
    found = measured(problem)
    assert found.verdict == "undecided"
    assert f"{LATE}: near t = {first:g}" in found.sentence()
    assert "finer steps" not in found.sentence()
    assert "--digits 40" in found.sentence()
    assert measured(problem, 40).verdict == "holds"


def test_a_late_start_does_not_matter_if_the_field_does_not_depend_on_the_time() -> None:
    found = measured(scene([y, -sin(x)], [1, 0], 10**12))
    assert found.verdict == "holds", found.sentence()


def test_a_coordinate_that_vanishes_at_both_ends_has_the_size_of_its_motion() -> None:
    problem = scene([Integer(1) - t, -y], [0, 1])
    noise = Noise.of(problem, reference(problem), 2.0**-52)
    assert noise.sizes[0] == pytest.approx(2.0)
    assert noise.of_state(10, [1.0, 0.0]) == pytest.approx(20 * 2.0**-52)


def test_rounding_errors_of_a_coordinate_that_rests_at_zero_at_both_ends_are_rounding_errors() -> None:
    """x = 10^12 (t (2 - t)/2)^2 and its velocity vanish at both ends."""
    problem = scene([10**12 * t * (2 - t) * (1 - t), -y / 1000], [0, 1])
    exact = reference(problem)
    noise = Noise.of(problem, exact, 2.0**-52)
    assert noise.sizes[0] == pytest.approx(0.25e12, rel=0.3)
    assert noise.speeds[0] == pytest.approx(0.385e12, rel=0.3)
    found = measured(problem)
    assert found.verdict == "undecided"
    assert all(run.excluded for run in found.refinement.runs)
