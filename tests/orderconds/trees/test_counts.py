"""Numbers of trees and words from generating functions, against published sequences."""

from orderconds.trees.counts import (
    lyndon_word_count,
    ordered_tree_count,
)


def test_lyndon_words_over_ordered_trees_are_counted_by_a022553():
    assert [lyndon_word_count(n, ordered_tree_count) for n in range(1, 10)] == [
        1, 1, 3, 8, 25, 75, 245, 800, 2700,
    ]  # fmt: skip
