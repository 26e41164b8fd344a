"""Butcher's product and grafting, by their algebraic laws."""

from collections import Counter
from fractions import Fraction
from itertools import product

from orderconds.trees.grafting import butcher_product, deshuffles, graft, left_graft
from orderconds.trees.levels import canonical, density, rooted_at_new_vertex, symmetry, trees_of
from orderconds.trees.ordered import ordered_forests
from orderconds.trees.rooted import rooted_trees


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
