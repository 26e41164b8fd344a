"""Independent action conditions: their number for VCG and VCF."""

from __future__ import annotations

from functools import partial

import pytest

from orderconds.families import get
from orderconds.series.action_counts import tree_counts
from orderconds.series.action_rank import independent_trees, sample
from orderconds.series.action_switching import classes


def random_series(name, order):
    return partial(get(name).random_series, order=order)


@pytest.mark.parametrize(("name", "numbers"), [("vcg", [1, 1, 6]), ("vcf", [1, 1, 6])])
def test_to_order_three_every_unrooted_tree_gives_a_condition(name, numbers):
    found = independent_trees(random_series(name, 3), 3)
    assert [len(trees) for trees in found] == numbers == list(tree_counts(3))


def test_vcg_loses_three_conditions_of_order_four_and_vcf_none():
    assert len(independent_trees(random_series("vcg", 4), 4)[-1]) == 25
    assert len(independent_trees(random_series("vcf", 4), 4)[-1]) == 28 == tree_counts(4)[-1]


def test_trees_of_one_class_have_equal_values_at_every_sample():
    for of_class in classes(3):
        values = sample(random_series("vcg", 3), 3, list(of_class), 10007)
        first, *others = values.values()
        assert all(other == first for other in others)
