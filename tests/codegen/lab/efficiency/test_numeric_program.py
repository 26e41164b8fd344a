"""Step programs of Python functions of doubles: the same results as the operations that they replace."""

from __future__ import annotations

import pytest

from codegen.groups import GL
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Space
from codegen.ir.interpret import interpret
from codegen.ir.matrix_functions import MatrixExponential
from codegen.lab.efficiency.numeric_program import NumericPrograms
from codegen.lab.efficiency.prediction import Predictor, amounts, widths_of_inputs
from codegen.lab.straight_line_field import straight_line
from tests.promises import ulps
from tests.strategies import field_scene, hamiltonian_scene, lowered, starting


@pytest.mark.parametrize(
    ("scene", "family", "tableau"),
    [
        (field_scene("GL(2)"), "cf", "cf4"),
        (field_scene("SO(3)"), "rkmk", "rk4"),
        (hamiltonian_scene("GL(2)"), "cg", "cg3"),
    ],
    ids=lambda x: getattr(x, "name", x),
)
def test_the_functions_of_doubles_make_the_same_step(scene, family, tableau):
    problem, program = lowered(family, tableau, scene)
    widths = widths_of_inputs(program, problem)
    Predictor(None, None).cost(program, problem, widths)  # type: ignore[arg-type]
    numeric = NumericPrograms().of(program, problem, widths)
    domain = FloatDomain(1 / 64)
    steps = [interpret(p, problem, domain, starting(problem, domain)) for p in (program, numeric)]
    for name, value in steps[0].items():
        assert ulps(steps[1][name], value) <= 4


def test_a_vector_function_is_called_once_and_counted_once():
    space, function = Space(), MatrixExponential(2)
    results = space.vector(function.name, [space.sym(f"y{k}") for k in range(4)])
    code = straight_line("test", [f"y{k}" for k in range(4)], results)
    assert [text for _, text in code.lines] == ["expm2(y[0], y[1], y[2], y[3])"]
    domain = FloatDomain(0.1)
    y = (0.1, 0.2, -0.3, 0.4)
    evaluate = code.python(float, {"expm2": lambda *args: domain.vector("expm2", args)})
    assert evaluate(y, 0.0) == GL(2).exp(domain, y)
    assert amounts(results).arithmetic == sum(function.operations.values())
