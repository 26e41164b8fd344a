"""Ordered trees and forests: their number and their listing."""

import pytest

from orderconds.trees.counts import (
    ordered_forest_count,
    ordered_tree_count,
)
from orderconds.trees.directed import (
    directed_free_trees,
    directed_rooted_trees,
)
from orderconds.trees.levels import branches
from orderconds.trees.ordered import ordered_forests, ordered_trees
from orderconds.trees.rooted import rooted_trees


def test_ordered_trees_and_forests_are_counted_by_catalan_numbers():
    assert [len(list(ordered_trees(n))) for n in range(1, 11)] == [
        ordered_tree_count(n) for n in range(1, 11)
    ]
    assert [len(list(ordered_forests(n))) for n in range(9)] == [ordered_forest_count(n) for n in range(9)]
    assert [ordered_tree_count(n) for n in range(1, 9)] == [1, 1, 2, 5, 14, 42, 132, 429]


@pytest.mark.parametrize("vertices", range(1, 9))
def test_no_tree_is_listed_twice(vertices):
    for trees in (rooted_trees, ordered_trees, ordered_forests, directed_rooted_trees, directed_free_trees):
        found = list(trees(vertices if trees is not directed_rooted_trees else min(vertices, 6)))
        assert len(set(found)) == len(found)


def test_there_are_no_trees_without_vertices():
    assert list(rooted_trees(0)) == list(ordered_trees(0)) == []
    assert directed_free_trees(0) == directed_rooted_trees(0) == ()
    assert list(ordered_forests(0)) == [b""]


@pytest.mark.parametrize("vertices", range(1, 8))
def test_forests_are_the_branches_of_trees_with_one_vertex_more(vertices):
    assert list(ordered_forests(vertices)) == [branches(tree) for tree in ordered_trees(vertices + 1)]


@pytest.mark.parametrize("vertices", range(1, 8))
def test_trees_are_the_forests_that_return_to_level_zero_nowhere(vertices):
    assert list(ordered_trees(vertices)) == [f for f in ordered_forests(vertices) if f.count(0) == 1]
