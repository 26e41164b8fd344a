"""Drawings as text."""

from __future__ import annotations

from orderconds.explain import kinds
from orderconds.explain.diagram import action
from orderconds.explain.lines import ASCII, draw
from orderconds.series.action_trees import Velocity


def test_the_place_of_a_force_in_a_word_is_drawn() -> None:
    def notes(tree: Velocity) -> list[str]:
        return [line for line in draw(action(tree), ASCII) if "*" in line]

    trees = {str(tree): tree for tree in kinds.get("action").members(3)}
    assert notes(trees["o(|f(o *))"]) == ["+<o (>*)"]
    assert notes(trees["o(|f(* o))"]) == ["+<o (*>)"]
