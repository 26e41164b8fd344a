"""The verifier: one rule broken at a time."""

from __future__ import annotations

from dataclasses import replace

import pytest

from codegen.ir.number import Number
from codegen.ir.program import ONE, Assign, Coefficient, Kind, Operation, Program, Solve, Var
from codegen.ir.verify import IllFormed, verify

H = Coefficient(Number.rational(1), 1)
y, y1, g = Var("y", Kind.POINT), Var("y1", Kind.POINT), Var("g", Kind.GROUP)
k, x, v, w = (Var(name, Kind.ALG) for name in "kxvw")
n = Var("n", Kind.DUAL)
FIELD = Assign((k,), Operation("field"), (y,))
LIN = Assign((x,), Operation("lin", (H,)), (k,))
TWO = Assign((x,), Operation("lin", (H, H)), (k, k))
EXP = Assign((g,), Operation("exp"), (x,))
ACT = Assign((y1,), Operation("act"), (g, y))
EULER = Program("euler", (y,), (FIELD, LIN, EXP, ACT), (("y", y1),))
ACT_V = Assign((y1,), Operation("actexp"), (v, y))
BLOCK = Solve("stage", (v,), (k,), (ACT_V, Assign((w,), Operation("field"), (y1,))), (w,))
EMPTY = replace(BLOCK, unknowns=(), starts=(), images=())
IMPLICIT = Program("implicit", (y,), (FIELD, BLOCK), (("y", y1),))


def body(*statements):
    return replace(EULER, body=statements)


@pytest.mark.parametrize("program", [EULER, IMPLICIT], ids=["explicit", "implicit"])
def test_a_well_formed_program_passes_unchanged(program):
    assert verify(program) is program


@pytest.mark.parametrize(
    ("program", "message"),
    [
        (body(FIELD, LIN, EXP, ACT, FIELD), "assigned twice"),
        (body(LIN, FIELD, EXP, ACT), "before it is defined"),
        (body(FIELD, LIN, EXP), "before it is defined, at output y"),
        (body(FIELD, replace(LIN, operation=Operation("exp")), EXP, ACT), "wrong types"),
        (body(FIELD, replace(LIN, operation=Operation("lin", ())), EXP, ACT), "wrong types"),
        (body(FIELD, replace(TWO, args=(k, k, k)), EXP, ACT), "wrong types"),
        (body(FIELD, replace(LIN, operation=Operation("lin", (H,)), args=(y,)), EXP, ACT), "wrong types"),
        (body(FIELD, replace(LIN, operation=Operation("twist")), EXP, ACT), "wrong types"),
        (body(FIELD, replace(LIN, operation=Operation("zero")), EXP, ACT), "wrong types"),
        (body(FIELD, LIN, EXP, replace(ACT, args=(y, g))), "wrong types"),
        (body(FIELD, LIN, EXP, ACT, Assign((n,), Operation("ad"), (k, k))), "wrong types"),
        (body(FIELD, LIN, EXP, ACT, Assign((w,), Operation("dexpinv"), (k, k))), "wrong types"),
        (body(FIELD, LIN, EXP, ACT, Assign((w,), Operation("ad", order=2), (k, k))), "wrong types"),
        (body(FIELD, LIN, EXP, ACT, Assign((w,), Operation("ad", (ONE,)), (k, k))), "wrong types"),
        (replace(EULER, outputs=(("z", y1),)), "replaces no input"),
        (replace(EULER, outputs=(("y", x),)), "replaces no input"),
        (replace(EULER, inputs=(y, y)), "assigned twice"),
        (replace(IMPLICIT, body=(BLOCK,)), "the starts of stage"),
        (replace(IMPLICIT, body=(FIELD, replace(BLOCK, images=(x,)))), "the images of stage"),
        (replace(IMPLICIT, body=(FIELD, EMPTY)), "differ in kind"),
        (replace(IMPLICIT, body=(FIELD, replace(BLOCK, unknowns=(n,)))), "differ in kind"),
        (replace(IMPLICIT, body=(FIELD, replace(BLOCK, starts=(k, k)))), "differ in kind"),
    ],
)
def test_each_broken_rule_is_named(program, message):
    with pytest.raises(IllFormed, match=message):
        verify(program)


def test_a_variable_of_the_same_name_but_another_kind_is_another():
    with pytest.raises(IllFormed, match="before it is defined"):
        verify(body(FIELD, replace(LIN, args=(Var("k", Kind.DUAL),)), EXP, ACT))
