"""Nested arrays in source text."""

from __future__ import annotations

import pytest

from orderconds.errors import TableauError
from orderconds.exchange.nested import MAX_DEPTH, Cells, nested


def written(cells: Cells) -> str:
    return cells if isinstance(cells, str) else "{" + ", ".join(map(written, cells)) + "}"


@pytest.mark.parametrize("cells", [[], ["1"], [[]], [["1", "2"], [], ["f(3, 4)"]], [[["a"], ["b"]]]])
def test_arrays_read_back_as_they_are_written(cells: Cells) -> None:
    assert nested(written(cells), "{", "}", "x") == cells


def test_commas_and_brackets_within_parentheses_belong_to_a_cell() -> None:
    assert nested("[f(1, [2]), g((3), 4)]", "[", "]", "x") == ["f(1, [2])", "g((3), 4)"]


def test_a_comma_after_the_last_cell_is_ignored() -> None:
    assert nested("{1, 2,}", "{", "}", "x") == ["1", "2"]


@pytest.mark.parametrize("text", ["[1", "1]", "[1]]", "[1] 2", "1", "", "[1][2]"])
def test_brackets_that_do_not_pair_are_refused(text: str) -> None:
    with pytest.raises(TableauError, match="rows of numbers"):
        nested(text, "[", "]", "x")


def test_deep_nesting_is_refused() -> None:
    depth = MAX_DEPTH + 1
    with pytest.raises(TableauError, match="too deep"):
        nested("[" * depth + "1" + "]" * depth, "[", "]", "x")
