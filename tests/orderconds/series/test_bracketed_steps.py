"""The series of steps with explicit brackets, against methods written in another way."""

from __future__ import annotations

from itertools import product

from orderconds.ring import QQ
from orderconds.series.bracketed_steps import BracketedSeries
from orderconds.series.brackets import BracketProgram
from orderconds.series.dexpinv import DexpinvSeries
from orderconds.trees.levels import trees_of
from orderconds.trees.ordered import ordered_forests
from orderconds.words.shuffle import shuffle

ORDER = 5


def without_brackets(method):
    """The program of RKMK(0): every argument is a combination of stage values."""
    rows = [{("k", j): a for j, a in enumerate(row) if a} for row in (*method.A, method.b)]
    return BracketProgram((), tuple(rows[:-1]), rows[-1], 0, (1,) * method.s)


def values(series):
    return [series(forest) for n in range(1, ORDER + 1) for forest in ordered_forests(n)]


def test_without_brackets_the_step_is_rkmk_without_commutators(tableaux):
    method = tableaux["rk4"]
    cut = DexpinvSeries(QQ, method.A, method.b, cutoff=0)
    assert values(BracketedSeries(QQ, without_brackets(method))) == values(cut)


def test_brackets_written_by_hand_are_those_of_rkmk_cut_after_the_first_power(tableaux):
    # u2 = k1, so that u = k1/2 + (k2 - [k1, k2]/2)/2.
    method = tableaux["heun"]
    half, k1, k2 = QQ.rational(1, 2), ("k", 0), ("k", 1)
    brackets = (({k1: QQ.one}, {k2: QQ.one}),)
    update = {k1: half, k2: half, ("B", 0): -half * half}
    program = BracketProgram(brackets, ({}, {k1: QQ.one}), update, 1, (1, 1))
    cut = DexpinvSeries(QQ, method.A, method.b, cutoff=1)
    assert values(BracketedSeries(QQ, program)) == values(cut)


def test_the_step_is_group_like(tableaux):
    half, k1, k2 = QQ.rational(1, 2), ("k", 0), ("k", 1)
    program = BracketProgram(
        (({k1: QQ.one}, {k2: half}), ({k1: half}, {("B", 0): QQ.one})),
        ({}, {k1: QQ.one, ("B", 0): half}),
        {k1: half, k2: half, ("B", 1): QQ.rational(3)},
        2,
        (1, 1),
    )
    series = BracketedSeries(QQ, program)
    for u, v in product(ordered_forests(2), ordered_forests(3)):
        words = shuffle(trees_of(u), trees_of(v))
        shuffled = sum((n * series(b"".join(word)) for word, n in words.items()), QQ.zero)
        assert shuffled == series(u) * series(v)
