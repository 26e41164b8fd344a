"""Numbers of trees and words from generating functions, against published sequences."""

from orderconds.trees.counts import (
    alternating_free_tree_count,
    directed_free_tree_count,
    essential_free_tree_count,
    euler_transform,
    free_tree_count,
    lyndon_word_count,
    ordered_forest_count,
    ordered_tree_count,
    rooted_tree_count,
)


def test_lyndon_words_over_ordered_trees_are_counted_by_a022553():
    assert [lyndon_word_count(n, ordered_tree_count) for n in range(1, 10)] == [
        1, 1, 3, 8, 25, 75, 245, 800, 2700,
    ]  # fmt: skip


def test_counts_are_the_published_sequences():
    rooted = [1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766, 12486, 32973]  # A000081
    assert [rooted_tree_count(n) for n in range(1, 15)] == rooted
    assert [rooted_tree_count(n, kinds=2) for n in range(1, 8)] == [1, 2, 7, 26, 107, 458, 2058]  # A000151
    assert [free_tree_count(n) for n in range(1, 13)] == [1, 1, 1, 2, 3, 6, 11, 23, 47, 106, 235, 551]
    assert [ordered_tree_count(n) for n in range(1, 9)] == [1, 1, 2, 5, 14, 42, 132, 429]  # A000108


def test_counts_of_conditions_are_those_of_hairer_lubich_and_wanner():
    # HLW VI.7, Tables 7.1 and 7.2: symplectic, symplectic partitioned, and separable methods.
    assert [essential_free_tree_count(n) for n in range(1, 11)] == [1, 0, 1, 1, 3, 4, 11, 19, 47, 97]
    assert [directed_free_tree_count(n) for n in range(1, 9)] == [1, 1, 3, 8, 27, 91, 350, 1376]
    assert [alternating_free_tree_count(n) for n in range(1, 9)] == [2, 1, 2, 3, 6, 10, 22, 42]
    assert [2 * rooted_tree_count(n, kinds=2) for n in range(1, 7)] == [2, 4, 14, 52, 214, 916]


def test_lyndon_words_of_two_letters_are_counted_by_witts_formula():
    def two_letters(weight):
        return 2 if weight == 1 else 0

    assert [lyndon_word_count(n, two_letters) for n in range(1, 11)] == [2, 1, 2, 3, 6, 9, 18, 30, 56, 99]
    assert [lyndon_word_count(n, lambda weight: 1) for n in range(1, 9)] == [1, 1, 2, 3, 6, 9, 18, 30]


def test_the_euler_transform_counts_multisets():
    # Multisets over two kinds of weight 1 and one of weight 2, listed by hand up to weight 3.
    assert euler_transform([2, 1, 0]) == (2, 4, 6)
    # Partitions of an integer, A000041.
    assert euler_transform([1] * 10) == (1, 2, 3, 5, 7, 11, 15, 22, 30, 42)


def test_nothing_has_no_trees():
    counts = (rooted_tree_count, ordered_tree_count, free_tree_count, directed_free_tree_count)
    assert [count(0) for count in counts] == [0, 0, 0, 0]
    assert ordered_forest_count(0) == 1
    assert lyndon_word_count(0, lambda weight: 1) == 0
