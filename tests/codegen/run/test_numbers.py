"""The number of scalars on the stack: functions that may be active at the same time all count."""

from __future__ import annotations

from codegen.run.language import Array, Assign, Call, Function, Return, Statement, Unit
from codegen.run.numbers import numbers_held
from codegen.run.terms import Kind, number, own, real

TOTAL = real("total")


def function(name: str, size: int, *body: Statement, public: bool) -> Function:
    """Return a function with an array of ``size`` numbers."""
    array = Array(own(f"{name}_array", size))
    return Function(name, "A probe.", (), (array, *body, Return(number(0.0))), Kind.REAL, public=public)


def held(*functions: Function) -> int:
    """Return the bound for a unit."""
    return numbers_held(Unit((), (), (), functions))


def test_only_the_largest_of_separate_public_functions_counts() -> None:
    assert held(function("first", 5, public=True), function("second", 3, public=True)) == 5


def test_private_functions_always_count() -> None:
    inner = function("inner", 7, public=False)
    outer = function("outer", 5, Assign(TOTAL, number(1.0)), Call("inner", (), (TOTAL,)), public=True)
    # ``outer`` has five array entries and one scalar. The call passes its result in a register.
    assert held(inner, outer) == 7 + 5 + 1


def test_a_public_function_counts_together_with_the_public_function_that_it_calls() -> None:
    run = function("run", 7, public=True)
    step = function("step", 5, Call("run", (), (TOTAL,)), public=True)
    other = function("other", 9, public=True)
    assert held(run, step, other) == 7 + 5 + 1
