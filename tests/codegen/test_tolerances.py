"""Errors of runs with step control are proportional to their tolerance, on SO(3) and SE(3)."""

from __future__ import annotations

import math
from functools import cache

import pytest
from sympy import Matrix, Rational, Symbol

from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.groups import SE3, SO3, LeftMultiplication
from codegen.lab.reference import cached_reference
from codegen.loader import load
from codegen.scene import FieldScene
from codegen.scene.problem import Problem
from orderconds.errors import TableauError
from orderconds.tableau import Tableau

DECADES = range(4, 13)


@cache
def scene(name: str) -> Problem:
    """Return a field without symmetry that depends on state and time, on a group that acts on itself."""
    group = {"SO(3)": SO3, "SE(3)": SE3}[name]()
    y, t, half = list(group.point("y")), Symbol("t", real=True), Rational(1, 2)
    a, b = Rational(3, 5), Rational(4, 5)
    turn = [a, -b, 0, b, a, 0, 0, 0, 1]
    if name == "SO(3)":
        f = [y[1] * y[5] + t * y[6] + 1, y[4] - t + y[0] * y[8], y[7] + t**2 - half]
        return FieldScene(
            name=name,
            group=group,
            action=LeftMultiplication(),
            y=Matrix(y),
            f=Matrix(f),
            y0=turn,
            span=(0, 2),
        )
    f = [y[0] * y[9] + t, y[10] - y[4] * y[1], y[2] + half - t * y[11]]
    f += [y[11] * y[3] + 1, y[9] * y[7] - t, y[5] * y[10] + y[8]]
    y0 = [*turn, half, Rational(-1, 3), 1]
    return FieldScene(
        name=name, group=group, action=LeftMultiplication(), y=Matrix(y), f=Matrix(f), y0=y0, span=(0, 1)
    )


def errors(name: str, method: str) -> list[float]:
    """Return the errors at the end for the tolerances 1e-4, ..., 1e-12."""
    emission = emit_compiled(compile_method(scene(name), method, adaptive=True), "c", prefix="chosen_")
    integrator, reference = load(emission), cached_reference(scene(name)).state
    found = []
    for k in DECADES:
        first, last = integrator.span
        arrival = integrator.adaptive(integrator.initial, first, last, rtol=10.0**-k, atol=10.0**-k)
        found.append(max(abs(x - float(y)) for x, y in zip(arrival.state, reference, strict=True)))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", ["SO(3)", "SE(3)"])
@pytest.mark.parametrize("method", ["rkmk(3):dormand_prince5", "cf:cf43", "cf:cf5_2n_s10", "cg:cg43"])
def test_errors_are_proportional_to_the_tolerance_over_eight_decades(name: str, method: str) -> None:
    scaled = [e * 10.0**k for e, k in zip(errors(name, method), DECADES, strict=True)]
    assert max(scaled) < 25
    # The controller aims at errors per step near the tolerance, so the errors are not much smaller either.
    assert min(scaled) > 0.05
    assert max(scaled) / min(scaled) < 10
    slope = math.log10(scaled[-1] / scaled[0]) / len(DECADES)
    assert abs(slope) < 0.15


@pytest.mark.parametrize("cutoff", [0, 1])
@pytest.mark.parametrize("name", ["SO(3)", "SE(3)"])
def test_pairs_of_order_five_with_too_few_brackets_are_blind_and_refused(name: str, cutoff: int) -> None:
    with pytest.raises(MethodError, match="the same leading error") as refused:
        compile_method(scene(name), f"rkmk({cutoff}):dormand_prince5", adaptive=True)
    assert refused.value.hint == "write rkmk(2):dormand_prince5"


def test_an_embedded_row_equal_to_the_main_row_is_refused() -> None:
    with pytest.raises(TableauError, match="weights that differ from b"):
        Tableau.rk([[], ["1/2"]], [0, 1], bhat=[0, 1])
