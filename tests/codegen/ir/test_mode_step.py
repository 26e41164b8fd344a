"""The formulas that explain a step of the modes. A long formula has one line for each term."""

from __future__ import annotations

from types import SimpleNamespace

from codegen.ir.mode_step import STATE, WIDTH, ModeStep, Term

STEP = SimpleNamespace(tables=())


def shown(terms, remark=""):
    return ModeStep._sum(STEP, "y", terms, remark)


def test_a_short_sum_is_one_line():
    assert shown((Term(STATE, None), Term(0, None)), ", the state") == ["y = u + N1, the state"]
    assert shown(()) == ["y = 0"]


def test_a_long_sum_has_one_term_on_each_line_and_the_remark_on_the_last():
    long = "," * WIDTH
    assert shown((Term(STATE, None), Term(0, None), Term(1, None)), long) == ["y = u", "+ N1", f"+ N2{long}"]
    assert shown((Term(STATE, None),), long) == [f"y = u{long}"]
