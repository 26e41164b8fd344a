"""Outlined functions: one result is returned, however long its expression; several fill an array."""

from __future__ import annotations

import pytest

from codegen.emitter import emit_kernel
from codegen.ir.expr import Space
from codegen.ir.kernel import Field, Function, Kernel
from codegen.ir.number import Number
from codegen.loader import load
from codegen.printers.recipe import Recipe


def kernel(results):
    """A step that calls a function of one or two results, the first too long for one line."""
    s = Space()
    x, h = s.sym("x"), s.sym("h")
    given = [f"summed.a{k}" for k in range(12)]
    a = [s.sym(name) for name in given]
    long = s.zero
    for k, term in enumerate(a):
        long = long + s.const(Number.rational(k + 1, 7)) * (term * term + term)
    outputs = (long, a[0] - a[11])[:results]
    function = Function("summed", tuple(given), (), outputs, "a long sum")
    arguments = tuple(x + s.const(Number.rational(k)) for k in range(12))
    calls = [s._make("call", arguments, f"summed.{k}") for k in range(results)]
    total = calls[0] if results == 1 else calls[0] + calls[1]
    state = (Field("x", ("x",), "a number"),)
    return Kernel("calling", state, ("t", "h"), (), (x + h * total,), outlined=(function,))


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("results", [1, 2])
def test_a_function_returns_what_its_expressions_say(target, results):
    recipe = Recipe("calling", (), (0.5,), steps=1)
    found = load(emit_kernel(kernel(results), recipe, target, "calling_")).step([0.5], 0.25)
    a = [0.5 + k for k in range(12)]
    total = sum((k + 1) / 7 * (x * x + x) for k, x in enumerate(a)) + (a[0] - a[11]) * (results == 2)
    assert found == pytest.approx([0.5 + 0.25 * total], rel=1e-15)
