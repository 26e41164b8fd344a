"""Admissible cuts: their number, and what they leave."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

import pytest

from orderconds.series.cuts import left_cuts, tree_cuts
from orderconds.trees.levels import children, density, parse
from orderconds.trees.ordered import ordered_forests
from orderconds.trees.rooted import rooted_trees


def number_of_cuts(tree: bytes) -> int:
    """Cut everything off, or cut each branch on its own."""
    result = 1
    for child in children(tree):
        result *= number_of_cuts(child)
    return result + 1


@pytest.mark.parametrize("vertices", range(1, 8))
def test_a_tree_has_a_cut_for_each_choice_at_every_branch(vertices: int) -> None:
    for tree in rooted_trees(vertices):
        assert len(tree_cuts(tree)) == number_of_cuts(tree)


@pytest.mark.parametrize(("cuts", "members"), [(tree_cuts, rooted_trees), (left_cuts, ordered_forests)])
def test_pieces_and_rest_have_all_vertices(cuts: object, members: object) -> None:
    for n in range(1, 7):
        for tree in members(n):  # type: ignore[operator]
            for pieces, rest in cuts(tree):  # type: ignore[operator]
                assert sum(map(len, pieces)) + len(rest) == n
            assert cuts(tree)[0] == ((), tree)  # type: ignore[operator]
            assert cuts(tree)[-1] == ((tree,), b"")  # type: ignore[operator]


def test_cuts_of_a_tall_tree_take_its_top() -> None:
    tree = parse("[[[.]]]")
    assert Counter((len(rest), len(pieces)) for pieces, rest in tree_cuts(tree)) == Counter(
        {(4, 0): 1, (3, 1): 1, (2, 1): 1, (1, 1): 1, (0, 1): 1}
    )


def test_branches_cut_off_an_ordered_forest_are_leftmost() -> None:
    assert [(pieces, rest) for pieces, rest in left_cuts(parse(". [.]"))] == [
        ((), b"\0\0\1"),
        ((b"\0",), b"\0\0"),
        ((b"\0",), b"\0\1"),
        ((b"\0", b"\0"), b"\0"),
        ((b"\0\0\1",), b""),
    ]


def test_the_exact_flow_over_two_steps_is_the_sum_over_cuts() -> None:
    # The flow over a time 2 has 2^n/gamma on a tree with n vertices, and 1/gamma on every piece and rest.
    for n in range(1, 7):
        for tree in rooted_trees(n):
            total = Fraction(0)
            for pieces, rest in tree_cuts(tree):
                term = Fraction(1, density(rest))
                for piece in pieces:
                    term /= density(piece)
                total += term
            assert total == Fraction(2**n, density(tree))
