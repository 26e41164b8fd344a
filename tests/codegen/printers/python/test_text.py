"""Text of Python: broken lines mean the same as one line, and no line is longer than a limit."""

from __future__ import annotations

import ast
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from codegen.printers.python.text import WIDTH, filled, indented, listed, packed, quoted, unpacked

NAMES = st.lists(st.integers(1, 40).map(lambda n: "x" * n), min_size=2, max_size=30)
DEPTH = st.integers(0, 4)


def tree(lines: list[str], depth: int) -> str:
    """Return the syntax tree of lines that are indented by ``depth``, as text."""
    blocks = "".join(f"{'    ' * k}if 1:\n" for k in range(depth))
    return ast.dump(ast.parse(blocks + "\n".join(lines)))


def fits(lines: list[str]) -> bool:
    return all(len(line) <= WIDTH for line in lines)


@given(st.text())
def test_a_quoted_text_is_a_literal_of_the_text(text: str) -> None:
    literal = quoted(text)
    assert ast.literal_eval(literal) == text
    assert literal.startswith('"')


@given(NAMES, DEPTH)
def test_a_call_is_the_same_on_one_line_and_on_several(names: list[str], depth: int) -> None:
    lines = filled("y = f(", names, ")", depth)
    assert tree(lines, depth) == tree([f"{'    ' * depth}y = f({', '.join(names)})"], depth)
    assert fits(lines)


@given(NAMES, DEPTH)
def test_a_sum_is_the_same_on_one_line_and_on_several(names: list[str], depth: int) -> None:
    segments = (names[0], *(f"+ {name}" for name in names[1:]))
    lines = indented("y = ", segments, depth)
    assert tree(lines, depth) == tree([f"{'    ' * depth}y = {' '.join(segments)}"], depth)
    assert fits(lines)


@given(NAMES, DEPTH)
def test_a_tuple_and_its_unpacking_are_the_same_on_one_line_and_on_several(
    names: list[str], depth: int
) -> None:
    space, several = "    " * depth, ", ".join(names)
    for lines, line in (
        (listed("y = ", names, depth), f"{space}y = {several}"),
        (unpacked(names, "state", depth), f"{space}{several} = state"),
    ):
        assert tree(lines, depth) == tree([line], depth)
        assert fits(lines)


def test_a_single_term_is_a_tuple() -> None:
    assert listed("y = ", ["x"], 0) == ["y = x,"]
    assert unpacked(["x"], "state", 0) == ["x, = state"]


@given(NAMES, DEPTH)
def test_a_line_breaks_only_before_a_segment_that_does_not_fit(names: list[str], depth: int) -> None:
    lines = packed(names, depth)
    assert [x for line in lines for x in line.split()] == names
    for line, following in pairwise(lines):
        assert len(line) + 1 + len(following.split()[0]) > WIDTH


def test_short_statements_stay_on_one_line() -> None:
    assert filled("f(", ["a", "b"], ")", 1) == ["    f(a, b)"]
    assert indented("return ", ("a", "+ b"), 2) == ["        return a + b"]
    assert unpacked(["a", "b"], "x[:]", 0) == ["a, b = x[:]"]
