"""Numbers of action trees from generating functions."""

from orderconds.series.action_counts import tree_counts


def test_unrooted_trees_are_the_elementary_hamiltonians():
    assert tree_counts(6) == (1, 1, 6, 28, 174, 1096)
