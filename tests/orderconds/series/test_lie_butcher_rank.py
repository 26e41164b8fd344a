"""Independent values on forests: their number, and the part that the exact flow plays."""

from __future__ import annotations

import pytest

from orderconds.families.ordered_forests import lyndon_forests
from orderconds.series.dexpinv import DexpinvSeries
from orderconds.series.lie_butcher import ExponentialsSeries
from orderconds.series.lie_butcher_rank import independent_forests
from orderconds.trees.ordered import ordered_forests

STAGES = 4


def crouch_grossman(ring, generator):
    rows = [[ring.random(generator) for _ in range(STAGES)] for _ in range(STAGES + 1)]
    single = [[((j, x),) for j, x in enumerate(row)] for row in rows]
    return ExponentialsSeries(ring, single[:-1], single[-1])


def munthe_kaas(cutoff):
    def series(ring, generator):
        rows = [[ring.random(generator) for _ in range(STAGES)] for _ in range(STAGES + 1)]
        return DexpinvSeries(ring, rows[:-1], rows[-1], cutoff)

    return series


def numbers(family, candidates, **options):
    return [len(forests) for forests in independent_forests(family, candidates, **options)]


@pytest.mark.parametrize("order", [4])
def test_crouch_grossman_methods_have_a_condition_for_each_lyndon_word(order):
    # A022553: 1, 1, 3, 8; thirteen conditions for order 4 (HLW IV.8.1).
    every = [list(ordered_forests(n)) for n in range(1, order + 1)]
    assert numbers(crouch_grossman, every) == [1, 1, 3, 8]
    lyndon = [lyndon_forests(n) for n in range(1, order + 1)]
    assert numbers(crouch_grossman, lyndon) == [1, 1, 3, 8]


def test_munthe_kaas_methods_have_a_condition_for_each_rooted_tree():
    lyndon = [lyndon_forests(n) for n in range(1, 5)]
    assert numbers(munthe_kaas(None), lyndon) == [1, 1, 2, 4]


def test_where_dexpinv_is_cut_too_early_one_condition_more_cannot_be_met():
    lyndon = [lyndon_forests(n) for n in range(1, 4)]
    assert numbers(munthe_kaas(0), lyndon) == [1, 1, 3]
    # Among the methods alone that condition depends on the others; the exact flow breaks the relation.
    assert numbers(munthe_kaas(0), lyndon, with_exact_flow=False) == [1, 1, 2]
