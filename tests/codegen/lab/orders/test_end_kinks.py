"""Verdicts on methods that evaluate the field before the start or after the end of a solution."""

from __future__ import annotations

import math

import pytest
from sympy import Abs, Expr, Matrix, Rational, Symbol, sin, sqrt, symbols

from codegen.emitter import compile_method
from codegen.groups import LeftMultiplication, Rn
from codegen.lab.orders.end_kinks import end_limits
from codegen.lab.orders.order_study import order_study
from codegen.lab.orders.scene_convergence import converge
from codegen.lab.reference import reference
from codegen.scene import FieldScene, table
from codegen.scene.problem import Problem

t = Symbol("t")
x, y = symbols("x y", real=True)
gain = table([0, 0.9, 2], [1, 1.3, 1.2], t)
BOTH, ABOVE, WITHIN = "ambient:cg4", "ambient:crouzeix4", "ambient:rk4"
"""Methods of order 4: abscissae from -0.35 to 1.5, from -0.07 to 1.07, and from 0 to 1."""


def planar(f: list[Expr], start: object = (1, 0.3), span: object = (0, 1)) -> Problem:
    return FieldScene(
        group=Rn(2), action=LeftMultiplication(), y=Matrix([x, y]), f=Matrix(f), y0=list(start), span=span
    )


@pytest.mark.parametrize("method", [BOTH, ABOVE])
@pytest.mark.parametrize(
    ("span", "name", "bounds"),
    [
        ((0, 1), "the start of the solution is a point where the field is not smooth", (2, math.inf)),
        ((1, 2), "the end of the solution is a point where the field is not smooth", (math.inf, 2)),
    ],
)
def test_a_kink_at_an_end_that_a_stage_crosses_leaves_the_order_undecided(
    span: tuple[int, int], name: str, bounds: tuple[float, float], method: str
) -> None:
    # The table is constant outside its points, so it has kinks at t = 0 and t = 2.
    scene = planar([y * gain, sin(y) - x], span=span)
    (found,) = converge(scene, method, target="interpreter", steps=[20, 40, 80])
    assert found.ends == bounds
    assert found.verdict == "undecided"
    assert name in found.sentence()
    assert "at most order 2;" in found.sentence()
    assert found.refinement.observed == pytest.approx(2, abs=0.3)


def test_stages_within_the_step_do_not_reach_a_kink_at_an_end() -> None:
    (found,) = converge(
        planar([y * gain, sin(y) - x], span=(0, 2)), WITHIN, target="interpreter", steps=[20, 40, 80, 160]
    )
    assert (found.ends, found.verdict) == ((math.inf, math.inf), "holds")


def test_a_kink_in_the_state_limits_the_order_as_a_kink_in_time() -> None:
    scene = planar([y + Abs(x), -x - x * y], (0, 1))
    exact = reference(scene)
    assert exact.kinks == ()
    assert end_limits(compile_method(scene, BOTH), exact.state) == (2, math.inf)
    assert end_limits(compile_method(scene, WITHIN), exact.state) == (math.inf, math.inf)


def test_a_solution_that_touches_a_kink_at_its_start_does_not_cross_it() -> None:
    (found,) = converge(planar([y, Abs(x) + 1 + t * y], (0, 0)), WITHIN, target="interpreter")
    assert (found.kinks, found.verdict) == ((), "holds")


@pytest.mark.parametrize(("time", "said"), [(t, "before the initial time"), (1 - t, "after the final time")])
def test_a_field_that_is_not_defined_outside_the_span_is_the_reason_of_failed_runs(
    time: Expr, said: str
) -> None:
    scene = planar([y * (1 + time**4 * sqrt(time)), -x])
    (found,) = converge(scene, BOTH, target="interpreter", steps=[5, 10])
    assert found.verdict == "undecided"
    assert f"evaluates the field {said}, where the field is not defined" in found.sentence()


def test_a_failure_at_every_time_is_not_attributed_to_the_ends() -> None:
    scene = planar([y, sqrt(Rational(101, 100) - x)], (1, 0), (0, Rational(1, 10)))
    (found,) = converge(scene, "ambient:euler", target="interpreter", steps=[1, 2])
    assert found.undefined == ""


def test_a_report_knows_the_kinks_at_the_ends() -> None:
    scene = planar([y * gain, sin(y) - x])
    study = order_study(compile_method(scene, BOTH), reference(scene), str)
    assert study.verdict == "undecided"
    assert study.main.ends == (2, math.inf)
