"""Coloured and free trees, Butcher's product and grafting, by their algebraic laws."""

from collections import Counter
from fractions import Fraction
from itertools import product
from math import factorial

import pytest

from orderconds.trees import bicoloured, free
from orderconds.trees.counts import rooted_tree_count
from orderconds.trees.directed import density as directed_density
from orderconds.trees.grafting import butcher_product, deshuffles, graft, left_graft
from orderconds.trees.levels import canonical, density, rooted_at_new_vertex, symmetry, trees_of
from orderconds.trees.ordered import ordered_forests
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


@pytest.mark.parametrize("vertices", range(1, 9))
def test_each_rooted_tree_belongs_to_one_free_tree(vertices):
    classes = {tree: {rooting for rooting, _ in free.rootings(tree)} for tree in free.free_trees(vertices)}
    everything = list(rooted_trees(vertices))
    assert sum(map(len, classes.values())) == len(everything)
    assert all(tree in classes[free.representative(tree)] for tree in everything)
    # A000055
    assert len(classes) == [1, 1, 1, 2, 3, 6, 11, 23][vertices - 1]


@pytest.mark.parametrize("vertices", range(2, 8))
def test_moves_of_the_root_are_butcher_products(vertices):
    for tree in rooted_trees(vertices):
        for rooting, moves in free.rootings(tree):
            before = tree
            for u, v in moves:
                assert butcher_product(u, v) == before
                before = butcher_product(v, u)
            assert before == rooting


@pytest.mark.parametrize("vertices", range(1, 8))
def test_alternating_trees_are_the_classes_of_coloured_rootings(vertices):
    everything = {bicoloured.alternating(c, tree) for c in (0, 1) for tree in rooted_trees(vertices)}
    classes = [
        set(bicoloured.bicoloured_rootings(tree)) for tree in bicoloured.alternating_free_trees(vertices)
    ]
    assert sum(map(len, classes)) == len(everything)
    assert set().union(*classes) == everything


def test_exact_weights_obey_the_law_by_which_the_root_moves():
    for u, v in product(rooted_trees(3), rooted_trees(4)):
        both = Fraction(1, density(butcher_product(u, v))) + Fraction(1, density(butcher_product(v, u)))
        assert both == Fraction(1, density(u) * density(v))


def test_grafting_is_pre_lie():
    def twice(u, v, w):
        found = Counter()
        for tree, times in graft(v, w).items():
            for grown, more in graft(u, tree).items():
                found[grown] += times * more
        for tree, times in graft(u, v).items():
            for grown, more in graft(tree, w).items():
                found[grown] -= times * more
        return {tree: times for tree, times in found.items() if times}

    small = [tree for n in range(1, 4) for tree in rooted_trees(n)]
    for u, v, w in product(small, repeat=3):
        assert twice(u, v, w) == twice(v, u, w)


def test_grafting_a_tree_on_every_vertex_keeps_count():
    for u, v in product(rooted_trees(3), rooted_trees(5)):
        assert sum(graft(u, v).values()) == len(v)


def test_left_grafting_forgets_to_grafting_on_unordered_trees():
    for u, v in product(rooted_trees(2), rooted_trees(4)):
        assert Counter(map(canonical, left_graft(u, v))) == graft(u, v)


def test_left_grafting_a_word_counts_all_maps_of_letters_to_vertices():
    for word in ordered_forests(3):
        for onto in ordered_forests(3):
            assert len(left_graft(word, onto)) == 3 ** len(trees_of(word))
    assert left_graft(b"\0", b"") == ()


def test_subwords_are_parted_in_all_ways():
    assert [len(deshuffles(forest)) for forest in (b"", b"\0", b"\0\0", b"\0\1\0")] == [1, 2, 4, 4]
    assert symmetry(rooted_at_new_vertex(b"\0\0")) == 2
