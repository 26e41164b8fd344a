"""Trees with two colours of vertices: their number, their rootings."""

from fractions import Fraction
from math import factorial

import pytest

from orderconds.trees import bicoloured
from orderconds.trees.counts import alternating_free_tree_count, rooted_tree_count
from orderconds.trees.directed import density as directed_density
from orderconds.trees.levels import symmetry
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


@pytest.mark.parametrize("vertices", range(1, 9))
def test_alternating_trees_are_as_many_as_their_generating_function_says(vertices):
    trees = bicoloured.alternating_free_trees(vertices)
    assert len(set(trees)) == len(trees) == alternating_free_tree_count(vertices)


@pytest.mark.parametrize("vertices", range(1, 6))
def test_different_coloured_trees_have_different_texts(vertices):
    trees = list(bicoloured.bicoloured_rooted_trees(vertices))
    texts = [bicoloured.text(tree) for tree in trees]
    assert len(set(texts)) == len(trees)
    for tree, text in zip(trees, texts, strict=True):
        # Black vertices are dots and square brackets, white ones circles and round brackets.
        assert text.count(".") + text.count("[") == sum(1 for level in tree if level % 2 == 0)
        assert text.count("o") + text.count("(") == sum(1 for level in tree if level % 2 == 1)


@pytest.mark.parametrize("vertices", range(1, 6))
def test_rootings_keep_the_number_of_each_colour(vertices):
    for tree in bicoloured.bicoloured_rooted_trees(vertices):
        rootings = list(bicoloured.bicoloured_rootings(tree))
        assert len(rootings) == vertices
        assert {sum(level % 2 for level in rooting) for rooting in rootings} == {sum(x % 2 for x in tree)}
        assert all(bicoloured.canonical(rooting) == rooting for rooting in rootings)


def test_trees_of_one_colour_have_the_symmetries_of_uncoloured_trees():
    for tree in rooted_trees(6):
        black = bytes(2 * level for level in tree)
        assert bicoloured.symmetry(black) == symmetry(tree)
