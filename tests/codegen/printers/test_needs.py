"""A module contains the helpers that its unit calls, and no others."""

from __future__ import annotations

from codegen.ir.expr import Space
from codegen.printers.needs import functions_of
from codegen.run.language import Assign, Call, Function, If, Return, Unit
from codegen.run.terms import own, real, value

S = Space()
X = S.sym("x")


def unit(*body: object) -> Unit:
    inner = Function("inner", "", (real("y"),), (Return(real("y")),))
    return Unit((), (), (), (inner, Function("f", "", (own("x"),), tuple(body))))  # type: ignore[arg-type]


def test_functions_in_expressions_are_needed_also_within_branches() -> None:
    term = value(S.mul(S.call("cos", X), S.call("sqrt", S.call("exp", X))))
    branch = If(own("x") < 1.0, (Assign(real("z"), term),))
    assert functions_of(unit(branch)) == ("cos", "exp", "sqrt")


def test_called_helpers_are_needed() -> None:
    called = Call("stumpff_12", (own("x"),), (real("c"), real("s")))
    assert functions_of(unit(called)) == ("stumpff_12",)


def test_functions_of_the_unit_and_inputs_of_the_caller_are_no_helpers() -> None:
    assert functions_of(unit(Call("inner", (own("x"),)), Call("sample", (own("x"),)))) == ()
