"""Functions in Python do what their statements say: copies, guards, loops with the test at the end."""

from __future__ import annotations

import math
from collections.abc import Callable

from codegen.ir.precision import DOUBLE
from codegen.printers.python.functions import FunctionPrinter
from codegen.printers.python.terms import Constants
from codegen.run.identifiers import identify
from codegen.run.language import RAISES_NAN, RAISES_STATUS, Array, Assign, Call, Function, Return, Unit, While
from codegen.run.terms import OK, Kind, code, number, real

X, Y = real("x"), real("y")
STATE, OUT = real("state", 4), real("out", 4)


def lines(function: Function) -> list[str]:
    unit = Unit((), (), (), (function,))
    return FunctionPrinter(unit, identify(unit, ()), Constants(DOUBLE, frozenset())).definition(function)


def compiled(function: Function) -> Callable[..., object]:
    scope = {"OK": 0, "NOT_FINITE": 2, "nan": math.nan}
    exec("\n".join(lines(function)), scope)
    return scope[f"_{function.name}"]  # type: ignore[return-value]


def test_neighbouring_entries_are_read_by_one_statement() -> None:
    body = [Assign(real(f"a{k}"), STATE[k]) for k in range(4)]
    assert "    a0, a1, a2, a3 = state" in lines(Function("f", "", (STATE,), tuple(body)))


def test_entries_that_depend_on_one_another_are_written_one_by_one() -> None:
    body = [Assign(OUT[0], X), *(Assign(OUT[k], OUT[k - 1] + 1.0) for k in (1, 2, 3))]
    out = [0.0] * 4
    compiled(Function("f", "", (OUT, X), tuple(body)))(out, 5.0)
    assert out == [5.0, 6.0, 7.0, 8.0]


def test_an_array_is_copied_and_not_shared() -> None:
    copy = Function("f", "", (STATE, OUT), (Assign(OUT, STATE), Assign(OUT[0], number(9.0))))
    state, out = [1.0, 2.0, 3.0, 4.0], [0.0] * 4
    compiled(copy)(state, out)
    assert (state, out) == ([1.0, 2.0, 3.0, 4.0], [9.0, 2.0, 3.0, 4.0])


def test_a_loop_with_its_test_at_the_end_runs_at_least_once() -> None:
    for once, expected in ((True, 1.0), (False, 0.0)):
        body = (Assign(Y, number(0.0)), While(Y > 5.0, (Assign(Y, Y + 1.0),), at_least_once=once), Return(Y))
        assert compiled(Function("f", "", (X,), body, Kind.REAL))(0.0) == expected


def test_an_arithmetic_error_is_a_status_or_a_nan() -> None:
    divided = (Assign(Y, 1.0 / X), Return(code(OK)))
    assert compiled(Function("f", "", (X,), divided, Kind.STATUS, RAISES_STATUS))(0.0) == 2
    value = compiled(Function("f", "", (X,), (Return(1.0 / X),), Kind.REAL, RAISES_NAN))(0.0)
    assert isinstance(value, float)
    assert math.isnan(value)
    out = [1.0] * 4
    compiled(Function("f", "", (OUT, X), (Assign(OUT[0], 1.0 / X),), None, RAISES_NAN))(out, 0.0)
    assert all(map(math.isnan, out))


def test_arrays_have_their_shape() -> None:
    body = (Array(real("a", 2, 3), zero=True), Return(real("a", 2, 3)[1][2]))
    assert compiled(Function("f", "", (X,), body, Kind.REAL))(0.0) == 0.0


def test_a_guard_does_not_catch_errors_of_the_callers_function() -> None:
    body = (Call("sample", (X, Y), (STATE,)), Return(1.0 / STATE[0]))
    printed = lines(Function("f", "", (X, Y), body, Kind.REAL, RAISES_NAN))
    assert printed[1:3] == ["    state = _sampled(x, y)", "    try:"]
