"""Text of expressions: few parentheses, and the value that the expression has."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codegen.ir.expr import Expr, Space, evaluate
from codegen.ir.kernel import Field, Kernel
from codegen.ir.number import Number
from codegen.kernel.schedule import Assignment, arrange
from codegen.printers.expression import number, render
from orderconds.errors import InputError

S = Space()
X, Y, Z = (S.sym(n) for n in "xyz")
HALF = S.const(Number.rational(1, 2))
VALUES = {"x": 1.1, "y": -0.7, "z": 2.3}


class Doubles:
    def number(self, value: Number) -> float:
        return float(value)

    def call(self, function: str, x: float) -> float:
        return float(getattr(math, function)(x))


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (X + Y * Z, "x + y * z"),
        ((X + Y) * Z, "z * (x + y)"),
        (X - (Y - Z), "x - (y - z)"),
        (X + (Y + Z), "y + z + x"),
        (X / (Y * Z), "x / (y * z)"),
        (X / Y / Z, "x / y / z"),
        (-X + Y, "y - x"),
        (-X - Y, "-(x + y)"),
        (-(X * Y), "-x * y"),
        (X - HALF * -3 * Y, "x + 1.5 * y"),
        (HALF * X, "0.5 * x"),
        (S.const(Number.rational(-1, 3)) - X, "-0.3333333333333333 - x"),
        (X**2, "x * x"),
        (X**3 / Y, "x * x * x / y"),
        (S.call("sin", X + Y), "sin(x + y)"),
        (2 + X, "x + 2.0"),
    ],
    ids=str,
)
def test_parentheses_stand_only_where_they_are_needed(expression, text):
    assert " ".join(render(expression, {})) == text


@pytest.mark.parametrize("value", [(1, 3), (2, 1), (1, 10), (10**25, 3), (1, 3 * 10**25), (-7, 5)])
def test_constants_are_rounded_once(value):
    spelled = number(Number.rational(*value))
    assert float(spelled) == value[0] / value[1]
    assert "." in spelled or "e" in spelled


def test_a_constant_beyond_double_is_bad_input():
    with pytest.raises(InputError, match="is too large for the type double"):
        number(Number.rational(10**400))


def expressions() -> st.SearchStrategy[Expr]:
    leaves = st.sampled_from([X, Y, Z, HALF, S.const(Number.rational(-2, 3)), S.const(Number.rational(5))])

    def more(inner: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
        pair = st.tuples(inner, inner)
        return st.one_of(
            pair.map(lambda p: p[0] + p[1]),
            pair.map(lambda p: p[0] - p[1]),
            pair.map(lambda p: p[0] * p[1]),
            pair.map(lambda p: p[0] / (p[1] * p[1] + 1)),
            inner.map(lambda e: -e),
            st.tuples(inner, st.integers(2, 9)).map(lambda p: p[0] ** p[1]),
            inner.map(lambda e: S.call("cos", e)),
        )

    return st.recursive(leaves, more, max_leaves=12)


@given(expressions())
@settings(max_examples=300, deadline=None)
def test_the_text_has_the_value_of_the_expression_to_the_last_bit(expression):
    kernel = Kernel("k", (Field("s", ("x", "y", "z"), ""),), (), (), (expression,))
    arrangement = arrange(kernel)
    known = {**VALUES, "cos": math.cos}
    try:
        (expected,) = evaluate([expression], Doubles(), VALUES)
    except (OverflowError, ValueError):
        return
    for statement in arrangement.statements:
        assert isinstance(statement, Assignment)
        known[statement.name] = eval(" ".join(render(statement.value, {})), {}, known)
    found = eval(" ".join(render(arrangement.outputs[0], {})), {}, known)
    assert found == expected or (math.isnan(found) and math.isnan(expected))
