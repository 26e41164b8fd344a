from itertools import permutations
from math import factorial

import pytest

from orderconds.trees.counts import (
    directed_free_tree_count,
    lyndon_word_count,
    ordered_forest_count,
    ordered_tree_count,
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
from orderconds.trees.levels import canonical, children, density, rooted_at_new_vertex, symmetry
from orderconds.trees.ordered import ordered_forests, ordered_trees
from orderconds.trees.rooted import rooted_trees


def test_rooted_trees_are_as_many_as_their_generating_function_foretells():
    found = [sum(1 for _ in rooted_trees(n)) for n in range(1, 13)]
    assert found == [rooted_tree_count(n) for n in range(1, 13)]
    assert found == [1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766]


def test_ordered_trees_and_forests_are_counted_by_catalan_numbers():
    assert [len(list(ordered_trees(n))) for n in range(1, 11)] == [
        ordered_tree_count(n) for n in range(1, 11)
    ]
    assert [len(list(ordered_forests(n))) for n in range(9)] == [ordered_forest_count(n) for n in range(9)]
    assert [ordered_tree_count(n) for n in range(1, 9)] == [1, 1, 2, 5, 14, 42, 132, 429]


def test_directed_trees_are_as_many_as_their_generating_functions_foretell():
    assert [len(directed_rooted_trees(n)) for n in range(1, 8)] == [
        rooted_tree_count(n, kinds=2) for n in range(1, 8)
    ]
    assert [len(directed_free_trees(n)) for n in range(1, 8)] == [
        directed_free_tree_count(n) for n in range(1, 8)
    ]
    assert [directed_free_tree_count(n) for n in range(1, 9)] == [1, 1, 3, 8, 27, 91, 350, 1376]


def test_lyndon_words_over_ordered_trees_are_counted_by_a022553():
    assert [lyndon_word_count(n, ordered_tree_count) for n in range(1, 10)] == [
        1, 1, 3, 8, 25, 75, 245, 800, 2700,
    ]  # fmt: skip


@pytest.mark.parametrize("vertices", range(1, 9))
def test_no_tree_is_listed_twice(vertices):
    for trees in (rooted_trees, ordered_trees, ordered_forests, directed_rooted_trees, directed_free_trees):
        found = list(trees(vertices if trees is not directed_rooted_trees else min(vertices, 6)))
        assert len(set(found)) == len(found)


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


def test_adding_and_removing_a_root_are_inverse():
    for forest in ordered_forests(6):
        assert b"".join(children(rooted_at_new_vertex(forest))) == forest


def test_there_are_no_trees_without_vertices():
    assert list(rooted_trees(0)) == list(ordered_trees(0)) == []
    assert directed_free_trees(0) == directed_rooted_trees(0) == ()
    assert list(ordered_forests(0)) == [b""]
