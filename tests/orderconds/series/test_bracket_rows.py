"""Terms move between brackets; arguments and the number of brackets stay."""

from __future__ import annotations

import pytest

from orderconds.ring import QQ
from orderconds.series.bracket_rows import with_fewer_terms
from orderconds.series.bracketed_steps import BracketedSeries
from orderconds.series.brackets import BracketProgram, fewest_brackets
from orderconds.tableau import Tableau, find
from orderconds.trees.ordered import ordered_forests


def program_of(name, order):
    method = Tableau.load(find(name)).method
    return fewest_brackets(QQ, method.A, method.b, order)


def terms(program):
    rows = [*program.stages, program.update, *(row for pair in program.brackets for row in pair)]
    return sum(map(len, rows))


@pytest.mark.parametrize(("name", "order"), [("heun", 2), ("kutta3", 3), ("rk4", 4)])
def test_every_value_of_the_step_stays(name, order):
    before = program_of(name, order)
    after = with_fewer_terms(QQ, before)
    assert len(after.brackets) == len(before.brackets)
    assert terms(after) <= terms(before)
    series = [BracketedSeries(QQ, p) for p in (before, after)]
    for n in range(1, 7):
        assert all(series[0](w) == series[1](w) for w in ordered_forests(n))


def test_rk4_is_written_as_by_munthe_kaas_and_owren():
    # u3 = k2/2 - [k1, k2]/8, u = (k1 + 2 k2 + 2 k3 + k4)/6 - [k1, k4]/12.
    assert with_fewer_terms(QQ, program_of("rk4", 4)).text(QQ).splitlines() == [
        "B1 = [k1, -1/8 k2]",
        "B2 = [k1, -1/12 k4]",
        "u1 = 0",
        "u2 = 1/2 k1",
        "u3 = 1/2 k2 + B1",
        "u4 = k3",
        "u = 1/6 k1 + 1/3 k2 + 1/3 k3 + 1/6 k4 + B2",
    ]


def test_brackets_with_different_left_factors_are_left_alone():
    k = [("k", n) for n in range(3)]
    one = QQ.one
    brackets = (({k[0]: one}, {k[2]: one}), ({k[1]: one}, {k[2]: one}))
    program = BracketProgram(brackets, ({}, {}, {}), {("B", 0): one, ("B", 1): one}, 2, (1, 1, 1))
    assert with_fewer_terms(QQ, program) == program
