"""A tape over doubles: values and Jacobians are those of exact arithmetic, for every point at once."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from flint import arb

from orderconds.ring.jets import Jets
from orderconds.ring.precision import precision
from orderconds.ring.traces import Traces, evaluate
from orderconds.solve.problem import find_problem
from orderconds.solve.spec import Spec
from orderconds.solve.tape import Tape

PROBLEMS = [
    ("rk", 4, Spec(3, explicit=True), "full"),
    ("vcg", 3, Spec(2), "full"),
    ("vcg", 4, Spec(3), "abscissae"),
    ("vcf", 3, Spec(2), "abscissae"),
    ("vcf", 3, Spec(2), "symmetric"),
    ("vrkmk(1)", 3, Spec(2), "full"),
    ("composition", 4, Spec(5), "full"),
    ("splitting", 3, Spec(3), "full"),
]


@pytest.mark.parametrize("case", PROBLEMS, ids=[f"{c[0]}-{c[3]}" for c in PROBLEMS])
def test_values_and_jacobians_are_those_of_certified_arithmetic(case) -> None:
    problem = find_problem(*case)
    points = problem.starts(np.random.default_rng(5), 3)
    values, slopes = problem.tape.jacobians(points)
    np.testing.assert_array_equal(values, problem.tape.values(points))
    trace = problem.trace()
    places = [x.placed() for x in trace]
    for point, at, gradients in zip(points, values, slopes, strict=True):
        with precision(200):
            ring = Jets(len(point))
            inputs = [ring.variable(i, arb(float(x))) for i, x in enumerate(point)]
            found = evaluate(trace[0].ring.operations, inputs, ring)
            jets = [found[place] for place in places]
            for jet, value, gradient in zip(jets, at, gradients, strict=True):
                assert float(jet.value) == pytest.approx(value, rel=1e-9, abs=1e-11)
                assert [float(g) for g in jet.gradient] == pytest.approx(list(gradient), rel=1e-8, abs=1e-10)


def test_what_no_output_needs_is_left_out() -> None:
    R = Traces(2)
    x, y = R.inputs
    _ = (x + y) * (x - y) / y
    assert Tape([x * y], 2).length == 3


def test_a_constant_output_has_no_slope() -> None:
    R = Traces(1)
    values, slopes = Tape([R.rational(1, 2), R.inputs[0]], 1).jacobians(np.array([[3.0]]))
    assert values.tolist() == [[0.5, 3.0]]
    assert slopes.tolist() == [[[0.0], [1.0]]]


def test_points_that_are_evaluated_in_parts_have_the_values_of_all_points_together(monkeypatch) -> None:
    x, y = Traces(2).inputs
    outputs = [x * y - 1, x / y, x * x * y]
    points = np.random.default_rng(0).standard_normal((7, 2))
    together = Tape(outputs, 2).jacobians(points)
    tape = Tape(outputs, 2)
    monkeypatch.setattr(sys.modules[Tape.__module__], "MOST_SLOPES", 2 * tape.length * tape.width)
    sizes = []
    forward = tape._forward
    monkeypatch.setattr(tape, "_forward", lambda p: sizes.append(len(p)) or forward(p))
    parts = tape.jacobians(points)
    assert sizes == [2, 2, 2, 1]
    assert [a.tobytes() for a in parts] == [a.tobytes() for a in together]
