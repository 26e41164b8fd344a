"""Trees with two colours of vertices: their number, their rootings."""

from fractions import Fraction
from math import factorial

import pytest

from orderconds.trees import bicoloured
from orderconds.trees.counts import rooted_tree_count
from orderconds.trees.directed import density as directed_density
from orderconds.trees.rooted import rooted_trees


@pytest.mark.parametrize("vertices", range(1, 7))
def test_heap_orderings_of_coloured_trees_number_the_factorial_times_colourings(vertices):
    # Increasing labellings of trees with labelled colours: (n - 1)! shapes times 2^n colourings.
    trees = list(bicoloured.bicoloured_rooted_trees(vertices))
    assert len(set(trees)) == len(trees) == 2 * rooted_tree_count(vertices, kinds=2)
    total = sum(
        Fraction(
            factorial(vertices), bicoloured.symmetry(tree) * directed_density(bicoloured.coloured(0, tree))
        )
        for tree in trees
    )
    assert total == factorial(vertices - 1) * 2**vertices


@pytest.mark.parametrize("vertices", range(1, 8))
def test_alternating_trees_are_the_classes_of_coloured_rootings(vertices):
    everything = {bicoloured.alternating(c, tree) for c in (0, 1) for tree in rooted_trees(vertices)}
    classes = [
        set(bicoloured.bicoloured_rootings(tree)) for tree in bicoloured.alternating_free_trees(vertices)
    ]
    assert sum(map(len, classes)) == len(everything)
    assert set().union(*classes) == everything
