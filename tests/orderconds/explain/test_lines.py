"""Drawings as text."""

from __future__ import annotations

import re

import pytest

from orderconds.explain import kinds
from orderconds.explain.diagram import action, plain, with_directions
from orderconds.explain.lines import ASCII, UNICODE, draw
from orderconds.series.action_trees import Velocity
from orderconds.trees.directed import directed_rooted_trees
from orderconds.trees.ordered import ordered_trees


def test_the_place_of_a_force_in_a_word_is_drawn() -> None:
    def notes(tree: Velocity) -> list[str]:
        return [line for line in draw(action(tree), ASCII) if "*" in line]

    trees = {str(tree): tree for tree in kinds.get("action").members(3)}
    assert notes(trees["o(|f(o *))"]) == ["+<o (>*)"]
    assert notes(trees["o(|f(* o))"]) == ["+<o (*>)"]


def levels(lines: list[str]) -> list[int]:
    """How deep each vertex is, by the column in which it is drawn."""
    return [len(re.match(r"[ |+\-<>]*", line).group()) // 2 for line in lines]  # type: ignore[union-attr]


@pytest.mark.parametrize("order", range(1, 7))
def test_trees_are_read_back_from_their_drawings(order: int) -> None:
    for tree in ordered_trees(order):
        assert bytes(levels(draw(plain(tree), ASCII))) == tree


@pytest.mark.parametrize("order", range(1, 6))
def test_both_styles_draw_the_same_picture_in_different_signs(order: int) -> None:
    signs = str.maketrans({"●": "o", "├": "+", "└": "+", "│": "|", "─": "-", "▸": ">", "◂": "<"})
    for tree in directed_rooted_trees(order):
        ascii_lines, unicode_lines = (draw(with_directions(tree), style) for style in (ASCII, UNICODE))
        assert [line.translate(signs) for line in unicode_lines] == ascii_lines
