"""Trees with directed edges: rootings, representatives, canonical order."""

from itertools import permutations

import pytest

from orderconds.trees.counts import (
    directed_free_tree_count,
    rooted_tree_count,
)
from orderconds.trees.directed import (
    branches,
    directed_free_trees,
    directed_rooted_trees,
    joined,
    representative,
    rootings,
)
from orderconds.trees.directed import density as directed_density
from orderconds.trees.levels import children, density
from orderconds.trees.rooted import rooted_trees


def test_directed_trees_are_as_many_as_their_generating_functions_foretell():
    assert [len(directed_rooted_trees(n)) for n in range(1, 8)] == [
        rooted_tree_count(n, kinds=2) for n in range(1, 8)
    ]
    assert [len(directed_free_trees(n)) for n in range(1, 8)] == [
        directed_free_tree_count(n) for n in range(1, 8)
    ]
    assert [directed_free_tree_count(n) for n in range(1, 9)] == [1, 1, 3, 8, 27, 91, 350, 1376]


def test_density_is_the_product_over_subtrees_for_directed_trees_too():
    for tree in rooted_trees(7):

        def directed(t):
            return joined([(len(child) % 2, directed(child)) for child in children(t)])

        assert directed_density(directed(tree)) == density(tree)


@pytest.mark.parametrize("vertices", range(1, 7))
def test_each_rooted_directed_tree_belongs_to_one_listed_free_tree(vertices):
    free = directed_free_trees(vertices)
    classes = {tree: frozenset(rootings(tree)) for tree in free}
    everything = directed_rooted_trees(vertices)
    assert sum(len(rootings_of) for rootings_of in classes.values()) == len(everything)
    for tree in everything:
        assert representative(tree) in classes
        assert tree in classes[representative(tree)]


@pytest.mark.parametrize("vertices", range(1, 7))
def test_a_representative_is_the_simplest_of_all_rootings(vertices):
    def simplicity(tree):
        hats = sum(level % 2 for level in tree[1:])
        return min(hats, vertices - 1 - hats), max(tree) // 2, hats, tree

    for tree in directed_rooted_trees(vertices):
        assert representative(tree) == min(rootings(tree), key=simplicity)


def test_branches_in_any_order_join_to_the_same_tree():
    below = [(0, b"\0\2"), (1, b"\0"), (1, b"\0\3\2")]
    assert len({joined(list(order)) for order in permutations(below)}) == 1
    assert sorted(branches(joined(below))) == sorted(below)
