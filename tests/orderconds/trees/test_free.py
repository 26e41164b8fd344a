"""Free trees: classes of rooted trees, and the moves of the root between them."""

import pytest

from orderconds.trees import free
from orderconds.trees.counts import essential_free_tree_count, free_tree_count
from orderconds.trees.grafting import butcher_product
from orderconds.trees.rooted import rooted_trees


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


@pytest.mark.parametrize("vertices", range(1, 11))
def test_free_trees_are_as_many_as_their_generating_functions_say(vertices):
    assert len(free.free_trees(vertices)) == free_tree_count(vertices)
    assert len(free.essential_free_trees(vertices)) == essential_free_tree_count(vertices)


@pytest.mark.parametrize("vertices", range(1, 9))
def test_a_tree_is_superfluous_when_one_of_its_rootings_is_a_square(vertices):
    halves = list(rooted_trees(vertices // 2)) if vertices % 2 == 0 else []
    squares = {butcher_product(half, half) for half in halves}
    for tree in rooted_trees(vertices):
        assert free.superfluous(tree) == any(rooting in squares for rooting, _ in free.rootings(tree))


@pytest.mark.parametrize("vertices", range(2, 8))
def test_the_moves_at_the_root_lead_to_its_neighbours(vertices):
    for tree in rooted_trees(vertices):
        neighbours = [rooting for rooting, moves in free.rootings(tree) if len(moves) == 1]
        assert [moved for _, _, moved in free.moves(tree)] == neighbours
