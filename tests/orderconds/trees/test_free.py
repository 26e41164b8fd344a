"""Free trees: classes of rooted trees, and the moves of the root between them."""

import pytest

from orderconds.trees import free
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
