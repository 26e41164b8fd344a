"""Reports of passes: sentences that say what a step does not need, and why."""

from __future__ import annotations

from collections import Counter

from codegen.ir.operations import Exp
from codegen.ir.program import Assign, Builder, Program
from codegen.ir.values import Kind, Var
from codegen.passes import optimise, summaries
from codegen.passes.reports import PassReport
from tests.strategies import field_scene, lowered

y, x = Var("y", Kind.POINT), Var("x", Kind.ALG)


def program(exponentials):
    """A program with some equal exponentials."""
    builder = Builder({"y", "x"})
    for _ in range(exponentials):
        builder.exp("g", x)
    return Program("p", (y, x), builder.take(), (("y", y),))


def report(before, after, because="they are equal"):
    return PassReport("some pass", because, program(before), program(after))


def test_a_summary_counts_what_is_saved_and_says_why():
    assert summaries([report(3, 1)]) == ("2 exponentials: they are equal",)
    assert summaries([report(2, 1)]) == ("1 exponential: they are equal",)


def test_reports_with_one_reason_are_added():
    assert summaries([report(3, 2), report(2, 1), report(1, 0, "nothing reads them")]) == (
        "2 exponentials: they are equal",
        "1 exponential: nothing reads them",
    )


def test_what_a_pass_adds_is_no_saving():
    assert summaries([report(1, 3)]) == ()
    assert report(1, 3).removed == {"exp": -2}


def test_operations_that_cost_nothing_are_not_counted():
    before = Program("p", (y,), (Assign((Var("g", Kind.GROUP),), Exp(), (x,)),), (("y", y),))
    builder = Builder({"y"})
    builder.identity("e")
    after = Program("p", (y,), builder.take(), (("y", y),))
    assert PassReport("some pass", "", after, before).savings == Counter()
    assert PassReport("some pass", "", before, after).savings == Counter({"exponential{s}": 1})


def test_brackets_vanish_on_an_abelian_group_and_the_header_says_so():
    scene, before = lowered("rkmk", "rk4", field_scene("R^3"), 2)
    _, reports = optimise(before, scene)
    assert summaries(reports)[0] == "4 evaluations of dexpinv: the group is abelian"


def test_on_another_group_the_reason_is_the_cut():
    scene, before = lowered("rkmk", "rk4", field_scene("S^2"), 0)
    _, reports = optimise(before, scene)
    assert summaries(reports)[0] == "4 evaluations of dexpinv: dexpinv is the identity at truncation order 0"
