"""Unordered rooted trees: their number, their order, their labellings."""

from math import factorial

import pytest

from orderconds.trees.counts import (
    rooted_tree_count,
)
from orderconds.trees.levels import canonical, children, density, symmetry
from orderconds.trees.ordered import ordered_trees
from orderconds.trees.rooted import rooted_trees


def test_rooted_trees_are_as_many_as_their_generating_function_foretells():
    found = [sum(1 for _ in rooted_trees(n)) for n in range(1, 13)]
    assert found == [rooted_tree_count(n) for n in range(1, 13)]
    assert found == [1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766]


@pytest.mark.parametrize("vertices", range(1, 9))
def test_rooted_trees_are_the_canonical_forms_of_ordered_trees(vertices):
    assert set(map(canonical, ordered_trees(vertices))) == set(rooted_trees(vertices))


@pytest.mark.parametrize("vertices", range(1, 10))
def test_heap_orderings_of_rooted_trees_number_the_factorial(vertices):
    # alpha(t) = n!/(sigma gamma) monotonic labellings, (n - 1)! in all (HLW III.1, Ex. 3 and (1.26)).
    labellings = [factorial(vertices) // (symmetry(t) * density(t)) for t in rooted_trees(vertices)]
    assert sum(labellings) == factorial(vertices - 1)


@pytest.mark.parametrize("vertices", range(1, 8))
def test_orderings_of_a_rooted_tree_times_its_symmetries_are_all_permutations_of_branches(vertices):
    def arrangements(tree):
        result = factorial(len(children(tree)))
        for child in children(tree):
            result *= arrangements(child)
        return result

    for tree in rooted_trees(vertices):
        drawings = sum(1 for ordered in ordered_trees(vertices) if canonical(ordered) == tree)
        assert drawings * symmetry(tree) == arrangements(tree)


@pytest.mark.parametrize("vertices", range(1, 9))
def test_rooted_trees_are_canonical_and_fall_in_lexicographic_order(vertices):
    trees = list(rooted_trees(vertices))
    assert all(canonical(tree) == tree for tree in trees)
    assert trees == sorted(trees, reverse=True)
    assert trees[0] == bytes(range(vertices))
    assert trees[-1] == bytes([0] + [1] * (vertices - 1))
