"""The run representation: programs in it mean the same to the executor, to C and to Python."""

from __future__ import annotations

import math
from importlib.resources import files

import pytest

from codegen.build import build
from codegen.emitter import compile_method
from codegen.ir.domain import FloatDomain
from codegen.ir.kernel import NEWTON
from codegen.ir.precision import DOUBLE, SINGLE
from codegen.printers.c.functions import FunctionPrinter as InC
from codegen.printers.c.words import RESERVED as WORDS_OF_C
from codegen.printers.python.functions import FunctionPrinter as InPython
from codegen.printers.python.terms import Constants
from codegen.printers.python.words import RESERVED as WORDS_OF_PYTHON
from codegen.run.execute import Machine
from codegen.run.identifiers import identify
from codegen.run.language import (
    RAISES_NAN,
    Array,
    Assign,
    Call,
    For,
    Function,
    If,
    Return,
    Unit,
    While,
    statements,
)
from codegen.run.plan import Plan
from codegen.run.scope import declarations
from codegen.run.terms import (
    NOT_FINITE,
    OK,
    STATUSES,
    Kind,
    Term,
    both,
    call,
    code,
    count,
    either,
    flag,
    negated,
    number,
    own,
    real,
    select,
    size,
    truth,
    whole,
)
from codegen.run.unit import unit_of
from tests.compilations import compiled

X, N, TOTAL, K = real("x"), count("n"), real("total"), count("k")


def one(*body, name="probe", parameters=(X,), **more):
    return Unit((), (), (), (Function(name, "A probe.", parameters, body, Kind.REAL, **more),))


def in_python(unit, *arguments):
    printer = InPython(unit, identify(unit, WORDS_OF_PYTHON), Constants(DOUBLE, frozenset()))
    namespace = {"nan": math.nan, "isfinite": math.isfinite, "sqrt": math.sqrt, "inf": math.inf}
    namespace |= {name: k for k, name in enumerate(STATUSES)}
    exec((files("codegen") / "snippets/python/power.j2").read_text(encoding="utf-8"), namespace)
    for function in unit.functions:
        exec("\n".join(printer.definition(function)), namespace)
    return namespace[f"_{unit.functions[-1].name}"](*arguments)


def in_c(unit, *arguments):
    from cffi import FFI

    printer = InC(unit, identify(unit, WORDS_OF_C), DOUBLE, "")
    lines = [line for function in unit.functions for line in (*printer.definition(function), "")]
    name = unit.functions[-1].name
    passed = ", ".join(f"x{k}" for k in range(len(arguments)))
    typed = ", ".join(f"double x{k}" for k in range(len(arguments)))
    head = f"double entry({typed})"
    entry = [f"{head};", f"{head} {{ return {name}({passed}); }}"]
    source = "\n".join(["#include <math.h>", "#include <string.h>", *lines, *entry])
    ffi = FFI()
    ffi.cdef(f"{head};")
    return ffi.dlopen(str(build({"probe.c": source}))).entry(*arguments)


def by_executor(unit, *arguments):
    return Machine(unit, FloatDomain(0.0)).call(unit.functions[-1].name, *arguments)


EVERYWHERE = pytest.mark.parametrize("carried_out", [by_executor, in_python, in_c])

EIGHTHS = one(
    Assign(TOTAL, number(0.0)),
    Assign(N, whole(0)),
    While(both(TOTAL < X, N < 1000), (Assign(N, N + 1), Assign(TOTAL, TOTAL + X / 8.0))),
    Return(TOTAL),
)

ROW = real("row", 4)

SIGNED = one(
    Array(ROW, zero=True),
    For(K, whole(4), (Assign(ROW[K], X),)),
    For(
        K,
        whole(4),
        (If(K > 1, (Assign(ROW[K], -ROW[K]),), (If(K.equals(0), (Assign(ROW[K], 2.0 * ROW[K]),)),)),),
        reverse=True,
    ),
    Assign(TOTAL, number(0.0)),
    For(K, whole(4), (Assign(TOTAL, 3.0 * TOTAL + ROW[K]),)),
    Return(TOTAL),
)

AT_LEAST_ONCE = one(
    Assign(TOTAL, X),
    While(TOTAL > 100.0, (Assign(TOTAL, TOTAL + 1.0),), at_least_once=True),
    Return(TOTAL),
)

GUARDED = one(
    If(negated(X > 0.0), (Return(number(-1.0)),)),
    Assign(flag("large"), either(X > 3.0, both(X > 1.0, X < 2.0))),
    Return(select(flag("large"), size(-X), 0.5 * X - (1.0 - (X - 2.0)))),
)


@EVERYWHERE
@pytest.mark.parametrize(
    ("unit", "meaning"),
    [
        (EIGHTHS, lambda x: x),
        (SIGNED, lambda x: 27 * 2 * x + 9 * x - 3 * x - x),
        (AT_LEAST_ONCE, lambda x: x + 1.0),
        (GUARDED, lambda x: -1.0 if x <= 0 else x if x > 3 or 1 < x < 2 else 0.5 * x - (1.0 - (x - 2.0))),
    ],
    ids=["while", "for and if", "at least once", "guard and select"],
)
def test_a_program_means_the_same_everywhere(carried_out, unit, meaning):
    for x in (0.25, 1.5, 2.5, 4.0):
        assert carried_out(unit, x) == meaning(x)


INNER = Function("inner", "Fill.", (X, ROW), tuple(Assign(ROW[k], X * float(k)) for k in range(4)))
CALLER = Function(
    "caller",
    "",
    (X,),
    (Array(ROW), Call("inner", (X, ROW)), Return(ROW[3] - ROW[1])),
    Kind.REAL,
)


@EVERYWHERE
@pytest.mark.parametrize("x", [0.0, 2.0])
def test_powers_mean_the_same_everywhere_also_those_of_zero(carried_out, x):
    power = one(Return(call("power", X, real("exponent"))), parameters=(X, real("exponent")))
    assert [carried_out(power, x, exponent) for exponent in (0.0, 0.5, 2.0)] == [1.0, x**0.5, x**2]


@EVERYWHERE
def test_arrays_are_filled_by_what_they_are_passed_to(carried_out):
    assert carried_out(Unit((), (), (), (INNER, CALLER)), 1.25) == 2.5


def test_an_arithmetic_error_is_what_the_guard_says():
    unit = one(Return(1.0 / X), guard=RAISES_NAN)
    assert math.isnan(by_executor(unit, 0.0))
    assert math.isnan(in_python(unit, 0.0))
    assert math.isinf(in_c(unit, 0.0))  # C computes on


def test_an_arithmetic_error_ends_a_loop_with_a_guard():
    status = Term("name", (), Kind.STATUS, "status")
    body = (Assign(TOTAL, TOTAL + 1.0 / (X - TOTAL)),)
    loop = While(status.equals(code(OK)), body, guard=status)
    ended = select(status.equals(code(NOT_FINITE)), TOTAL, number(-1.0))
    unit = one(Assign(status, code(OK)), Assign(TOTAL, X - 1.0), loop, Return(ended))
    assert by_executor(unit, 3.0) == in_python(unit, 3.0) == 3.0


def test_what_side_by_side_loops_assign_first_belongs_to_each_and_is_constant():
    body = tuple(
        For(K, whole(2), (Assign(real("change"), X * float(k)), Assign(TOTAL, TOTAL + real("change"))))
        for k in range(2)
    )
    unit = one(Assign(TOTAL, number(0.0)), *body, Return(TOTAL))
    text = "\n".join(InC(unit, identify(unit, ()), DOUBLE, "").definition(unit.functions[0]))
    assert text.count("const double change =") == 2
    assert in_c(unit, 3.0) == 6.0


def test_a_value_that_is_read_after_a_loop_is_declared_before_it():
    loop = While(N < 3, (Assign(N, N + 1), Assign(TOTAL, X + 1.0)), at_least_once=True)
    unit = one(Assign(N, whole(0)), loop, Return(TOTAL))
    identifiers = identify(unit, ())
    found = declarations(unit.functions[0], identifiers["probe"])
    assert [name for name, _ in found.before[id(loop)]] == ["total"]
    assert in_c(unit, 1.0) == 2.0


def test_a_variable_that_a_loop_without_iterations_may_leave_unassigned_keeps_its_earlier_value():
    change = real("change")
    blocks = [
        If(bound < X, (For(K, N, (Assign(change, X),)), Assign(TOTAL, TOTAL + change)))
        for bound in (0.0, 1.0)
    ]
    unit = one(Assign(TOTAL, number(0.0)), *blocks, Return(TOTAL), parameters=(X, N))
    found = declarations(unit.functions[0], identify(unit, ())["probe"])
    # Both blocks read the value of the first block, so the declaration is outside of the blocks.
    assert [name for name, _ in found.before[id(blocks[0])]] == ["change"]


def test_names_of_a_kernel_give_way_to_those_of_the_representation():
    unit = one(Assign(TOTAL, own("total") + X), Return(TOTAL), parameters=(X, own("total")))
    assert identify(unit, {"x_"})["probe"].of(own("total")) == "total_"
    assert [carried_out(unit, 1.0, 2.0) for carried_out in (by_executor, in_python, in_c)] == [3.0] * 3


def test_no_loop_of_a_solver_is_left_from_its_middle():
    """Return is the end of a function or a guard of its outermost block: what array languages can select."""
    for scene, method, solver in (
        ("heavy_top", "vcg:alexander2", NEWTON),
        ("dipole", "vcg:triple_jump", "auto"),
        ("fast_heavy_top", "splitting:strang", "auto"),
    ):
        made = compiled(scene, method, solver)
        for function in unit_of(Plan(made.kernel, DOUBLE)).functions:
            for statement in function.body:
                inner = list(statements([statement]))
                returns = [s for s in inner if isinstance(s, Return)]
                guard = isinstance(statement, If) and inner[1:] == returns and not statement.orelse
                assert not returns or inner == returns or guard


def test_single_precision_scales_the_rule_and_nothing_else():
    made = compile_method("heavy_top", "vcg:midpoint", solver=NEWTON)
    double, single = (unit_of(Plan(made.kernel, form)) for form in (DOUBLE, SINGLE))
    assert [f.name for f in double.functions] == [f.name for f in single.functions]
    counts = [[type(s) for f in unit.functions for s in statements(f.body)] for unit in (double, single)]
    assert counts[0] == counts[1]


def test_truth_is_spelled_by_each_target():
    unit = one(Assign(flag("yes"), truth(True)), Return(select(flag("yes"), X, -X)))
    assert [carried_out(unit, 2.0) for carried_out in (by_executor, in_python, in_c)] == [2.0] * 3
