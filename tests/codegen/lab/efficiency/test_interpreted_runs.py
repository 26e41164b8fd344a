"""Interpreted runs with step-size control: the numbers of steps of emitted code, also on a stiff scene."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from codegen import emit, load, scenes
from codegen.error_estimate import order_of_estimate
from codegen.ir.domain import FloatDomain
from codegen.lab.efficiency import prediction
from codegen.lab.efficiency.equations import Equations
from codegen.lab.efficiency.interpreted_runs import controlled_run, run
from codegen.lab.efficiency.numeric_program import NumericPrograms
from codegen.lab.efficiency.prediction import Bar, Predictor, widths_of_inputs
from codegen.lab.number_types import Vector
from codegen.lab.reference import Reference, cached_reference
from codegen.lower import families_for, lower, problem_for
from codegen.method import Method, parse
from codegen.passes import plain_passes
from codegen.scene.problem import Problem


def method_for(scene: Problem, label: str) -> Method:
    return replace(parse(label, families_for(scene)), adaptive=True)


def controlled(scene: Problem, label: str, tolerance: float) -> tuple[Vector, int]:
    """Return the final state and the number of tried steps."""
    method = method_for(scene, label)
    problem, program = problem_for(scene, method), lower(scene, method)
    for each in plain_passes(problem):
        program = each.run(program)
    widths = widths_of_inputs(program, problem)
    Predictor(Equations(scene), Reference(scene.name, (), 0.0)).cost(program, problem, widths)
    numeric = NumericPrograms().of(program, problem, widths)
    state, tried, sweeps = controlled_run(numeric, problem, order_of_estimate(method, scene), tolerance)
    assert (sweeps > 0) == (label != "ambient:dormand_prince5")
    return state, tried


def test_the_number_of_tried_steps_is_nearly_that_of_emitted_code() -> None:
    scene = scenes.load("driven_spin")
    label, tolerance = "ambient:dormand_prince5", 1e-7
    state, tried = controlled(scene, label, tolerance)
    integrator = load(emit("driven_spin", label, "python", adaptive=True))
    first, last = map(float, scene.span)
    initial = list(scene.initial(FloatDomain(0.0)))
    end = integrator.adaptive(initial, first, last, rtol=tolerance, atol=tolerance)
    assert 1 / 1.25 < tried / (end.accepted + end.rejected) < 1.25
    assert math.dist(state, end.state) < 1e-5


def test_an_implicit_method_makes_long_steps_on_a_stiff_scene() -> None:
    """Equal steps would need about 1000 steps for the fast motion at the beginning alone."""
    scene = scenes.load("stiff_driven_spin")
    runs = [controlled(scene, "ambient:lobatto3a3", tolerance) for tolerance in (1e-2, 1e-4)]
    assert all(tried < 200 for _, tried in runs)
    assert math.dist(runs[0][0], runs[1][0]) < 1e-2


def test_a_run_with_step_size_control_ends_at_its_time_limit() -> None:
    scene = scenes.load("driven_spin")
    method = method_for(scene, "ambient:dormand_prince5")
    problem = problem_for(scene, method)
    with pytest.raises(ArithmeticError, match="takes too long"):
        controlled_run(lower(scene, method), problem, 5, 1e-7, end=0.0)
    with pytest.raises(ArithmeticError, match="takes too long"):
        run(lower(scene, replace(method, adaptive=False)), problem, 8, end=0.0)


@pytest.mark.parametrize("limit", [8, 1024])
def test_step_size_control_is_predicted_only_if_equal_steps_have_large_errors(
    monkeypatch: pytest.MonkeyPatch, limit: int
) -> None:
    """A limit of 8 steps makes the errors of equal steps large."""
    monkeypatch.setattr(prediction, "MANY_STEPS", limit)
    scene = scenes.load("driven_spin")
    method = method_for(scene, "ambient:dormand_prince5")
    equal, predictor = replace(method, adaptive=False), Predictor(Equations(scene), cached_reference(scene))
    known = predictor.predict(equal, 5, Bar(1e-6), controlled=method)
    assert known.rough == (limit == 8)
    assert (known.controlled is not None) == known.rough
    assert predictor.predict(equal, 5, Bar(1e-6)).controlled is None
    if known.controlled is not None:
        assert known.controlled.error < known.error
