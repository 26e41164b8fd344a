"""The verifier: one rule broken at a time."""

from __future__ import annotations

from dataclasses import replace

import pytest

from codegen.ir.number import Number
from codegen.ir.operations import Act, ActExp, AdSeries, Bracket, Exp, InverseDexp, Linear, Zero
from codegen.ir.program import Assign, Program, Solve
from codegen.ir.scene_operations import Field
from codegen.ir.values import Coefficient, Kind, Var
from codegen.ir.verify import IllFormed, verify

H = Coefficient(Number.rational(1), 1)
y, y1, g = Var("y", Kind.POINT), Var("y1", Kind.POINT), Var("g", Kind.GROUP)
k, x, v, w = (Var(name, Kind.ALG) for name in "kxvw")
n = Var("n", Kind.DUAL)
FIELD = Assign((k,), Field(), (y,))
LIN = Assign((x,), Linear((H,)), (k,))
TWO = Assign((x,), Linear((H, H)), (k, k))
EXP = Assign((g,), Exp(), (x,))
ACT = Assign((y1,), Act(), (g, y))
EULER = Program("euler", (y,), (FIELD, LIN, EXP, ACT), (("y", y1),))
ACT_V = Assign((y1,), ActExp(), (v, y))
BLOCK = Solve("stage", (v,), (k,), (ACT_V, Assign((w,), Field(), (y1,))), (w,))
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
        (body(FIELD, replace(LIN, operation=Exp()), EXP, ACT), "wrong kinds"),
        (body(FIELD, replace(LIN, operation=Linear(())), EXP, ACT), "wrong kinds"),
        (body(FIELD, replace(TWO, args=(k, k, k)), EXP, ACT), "wrong kinds"),
        (body(FIELD, replace(LIN, operation=Linear((H,)), args=(y,)), EXP, ACT), "wrong kinds"),
        (body(FIELD, replace(LIN, operation=Zero(Kind.POINT)), EXP, ACT), "wrong kinds"),
        (body(FIELD, LIN, EXP, replace(ACT, args=(y, g))), "wrong kinds"),
        (body(FIELD, LIN, EXP, ACT, Assign((n,), Bracket(), (k, k))), "wrong kinds"),
        (body(FIELD, LIN, EXP, ACT, Assign((w,), InverseDexp(2, dual=True), (k, k))), "wrong kinds"),
        (body(FIELD, LIN, EXP, ACT, Assign((w,), Bracket(dual=True), (k, k))), "wrong kinds"),
        (body(FIELD, LIN, EXP, ACT, Assign((w,), AdSeries(()), (k, k))), "wrong kinds"),
        (replace(EULER, outputs=(("z", y1),)), "requires an input of kind"),
        (replace(EULER, outputs=(("y", x),)), "requires an input of kind"),
        (replace(EULER, inputs=(y, y)), "assigned twice"),
        (replace(IMPLICIT, body=(BLOCK,)), "the starts of stage"),
        (replace(IMPLICIT, body=(FIELD, replace(BLOCK, images=(x,)))), "the images of stage"),
        (replace(IMPLICIT, body=(FIELD, EMPTY)), "needs unknowns. Each unknown"),
        (replace(IMPLICIT, body=(FIELD, replace(BLOCK, unknowns=(n,)))), "needs unknowns. Each unknown"),
        (replace(IMPLICIT, body=(FIELD, replace(BLOCK, starts=(k, k)))), "needs unknowns. Each unknown"),
    ],
)
def test_each_broken_rule_is_named(program, message):
    with pytest.raises(IllFormed, match=message):
        verify(program)


def test_a_variable_of_the_same_name_but_another_kind_is_another():
    with pytest.raises(IllFormed, match="before it is defined"):
        verify(body(FIELD, replace(LIN, args=(Var("k", Kind.DUAL),)), EXP, ACT))
