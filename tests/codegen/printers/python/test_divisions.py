"""Divisions by zero in a part of a formula: C and Python agree, and other divisions stay plain."""

from __future__ import annotations

import pytest
import sympy
from sympy import Integer, Max, Min, Piecewise, atan, exp, sqrt, symbols

import codegen
from codegen.emitter import compile_method
from codegen.groups import LeftMultiplication, Rn
from codegen.ir.domain import FloatDomain
from codegen.ir.precision import DOUBLE
from codegen.run.execute import Machine
from codegen.run.plan import Plan
from codegen.run.unit import unit_of
from codegen.scene import FieldScene
from codegen.scene.problem import Problem

x = sympy.Symbol("x", real=True)

FINITE = (
    exp(-1 / x**2),
    atan(1 / x),
    1 / (1 + 1 / x**2),
    Piecewise((1, 1 / x > 2), (0, True)),
    Min(1 / x, 2),
    exp(-1 / sqrt(x)),
)
"""Formulas that are finite at x = 0 in IEEE arithmetic. The first four are also finite at x = -0."""

INFINITE = (1 / x, 0 * x + sqrt(1 + 1 / x), Max(1 / x, 2), x * (1 / x**2))
"""Formulas that are infinite or NaN at x = 0."""


def problem(*formulas: sympy.Expr) -> Problem:
    """The equations y_k' = f_k(x), x' = 0."""
    y = symbols(f"y0:{len(formulas)}", real=True)
    start = [*(Integer(0) for _ in y), sympy.Rational(3, 4)]
    return FieldScene(
        name="quotients",
        title="Quotients",
        group=Rn(len(start)),
        action=LeftMultiplication(),
        y=[*y, x],
        f=[*formulas, 0],
        y0=start,
        span=(0, 1),
    )


@pytest.mark.parametrize(("zero", "formulas"), [(0.0, FINITE), (-0.0, FINITE[:4])])
def test_c_python_and_the_interpreter_agree_if_a_hidden_quotient_is_infinite(
    zero: float, formulas: tuple[sympy.Expr, ...]
) -> None:
    scene, start = problem(*formulas), [0.0] * len(formulas) + [zero]
    found = [codegen.load(codegen.emit(scene, "rk4", target=t)).run(start, 0.5, 2) for t in ("c", "python")]
    assert list(found[0]) == list(found[1])
    unit = unit_of(Plan(compile_method(scene, "rk4").kernel, DOUBLE))
    state = list(start)
    for _ in range(2):
        Machine(unit, FloatDomain(0.0)).call("advance", state, 0.5)
    assert state == list(found[0])


@pytest.mark.parametrize("formula", INFINITE, ids=str)
def test_a_quotient_that_makes_the_state_infinite_stays_a_plain_division(formula: sympy.Expr) -> None:
    module = codegen.emit(problem(formula), "rk4", target="python")
    (text,) = (text for name, text in module.files.items() if name.endswith(".py"))
    assert ("_divided(" in text) == formula.has(Max)
    with pytest.raises(ArithmeticError):
        codegen.load(module).run([0.0, 0.0], 0.5, 1)
