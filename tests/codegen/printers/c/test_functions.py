"""Functions in C: what is const, what is copied, and what is passed by its address."""

from __future__ import annotations

from codegen.ir.precision import DOUBLE
from codegen.printers.c.functions import FunctionPrinter
from codegen.run.identifiers import identify
from codegen.run.language import Array, Assign, Call, For, Function, If, Return, Table, Unit, While
from codegen.run.terms import Kind, count, number, real, whole

X, Y, N, INDEX = real("x"), real("y"), count("n"), count("i")
STATE, OUT = real("state", 3), real("out", 3)


def lines(*body: object, parameters: tuple = (X, N), returns: Kind | None = None, **more: bool) -> list[str]:
    function = Function("f", "", parameters, tuple(body), returns, **more)  # type: ignore[arg-type]
    callee = Function("two", "", (X,), (Return(X),), Kind.REAL)
    unit = Unit((), (), (), (callee, function))
    return FunctionPrinter(unit, identify(unit, ()), DOUBLE, "m_").definition(function)


def test_a_variable_is_const_if_it_is_assigned_once() -> None:
    once = lines(Assign(Y, X + 1.0), Return(Y), returns=Kind.REAL)
    twice = lines(Assign(Y, X + 1.0), Assign(Y, Y * X), Return(Y), returns=Kind.REAL)
    assert "    const double y = x + 1.0;" in once
    assert "    double y = x + 1.0;" in twice
    assert "    y *= x;" in twice


def test_an_array_parameter_is_const_unless_it_is_written() -> None:
    head = lines(Assign(OUT, STATE), parameters=(STATE, OUT))
    assert head[0] == "static void m_f(const double state[static 3], double out[static 3])"
    assert "    memcpy(out, state, 3 * sizeof *state);" in head


def test_a_local_array_is_copied_by_its_own_size() -> None:
    copy = real("copy", 3)
    assert "    memcpy(copy, state, sizeof copy);" in lines(
        Array(copy), Assign(copy, STATE), parameters=(STATE,)
    )


def test_every_function_has_the_prefix_and_public_ones_no_storage_class() -> None:
    assert lines(Return(X), returns=Kind.REAL, public=True)[0] == "double m_f(double x, size_t n)"
    assert (
        lines(Return(X), returns=Kind.REAL, often=True)[0] == "static inline double m_f(double x, size_t n)"
    )


def test_an_unread_parameter_is_cast_to_void() -> None:
    assert "    (void)n;" in lines(Return(X), returns=Kind.REAL)


def test_loops() -> None:
    add = Assign(Y, Y + X)
    text = lines(
        Assign(Y, number(0.0)),
        For(INDEX, N, (add,)),
        For(INDEX, N, (add,), reverse=True),
        While(Y < 9.0, (add,), at_least_once=True),
        Return(Y),
        returns=Kind.REAL,
    )
    assert "    for (size_t i = 0; i < n; i++) {" in text
    assert "    for (size_t i = n; i-- > 0;) {" in text
    assert "    } while (y < 9.0);" in text


def test_an_else_with_one_branch_is_an_else_if() -> None:
    inner = If(X < 2.0, (Assign(STATE[1], X),))
    text = lines(If(X < 1.0, (Assign(STATE[0], X),), (inner,)), parameters=(X, STATE))
    assert "    } else if (x < 2.0) {" in text


def test_a_result_is_assigned_and_several_are_written_through_pointers() -> None:
    text = lines(
        Call("two", (X,), (Y,)),
        Call("pair", (X,), (real("a"), real("b"))),
        Assign(STATE[0], Y),
        parameters=(X, STATE),
    )
    assert "    const double y = m_two(x);" in text
    assert "    m_pair(x, &a, &b);" in text


def test_a_table_leaves_zeros_at_the_ends_of_rows_to_c() -> None:
    printer = FunctionPrinter(Unit((), (), (), ()), {}, DOUBLE, "m_")
    table = Table(real("t", 2, 3), ((1.0, 0.0, 0.0), (0.0, 0.05, -0.0)), "about")
    assert printer.table(table)[1:] == [
        "static const double m_t[2][3] = {",
        "    {1.0},",
        "    {0.0, 0.05},",
        "};",
    ]
    assert whole(0).number == 0
