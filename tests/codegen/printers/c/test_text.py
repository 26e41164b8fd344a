"""Text of C: no text ends a comment, breaks keep every segment, and maxima are balanced trees."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from codegen.printers.c.text import WIDTH, block_comment, closed_call, comment, fill, greatest, together

WORDS = st.lists(st.text("ab*/", min_size=1, max_size=30), min_size=1, max_size=12)
NAMES = st.lists(st.integers(1, 26).map(lambda n: "x" * n), min_size=1, max_size=20)


@given(st.text("*/ x"))
def test_no_text_begins_or_ends_a_comment(text: str) -> None:
    safe = comment(text)
    assert "*/" not in safe
    assert "/*" not in safe
    assert safe.replace(" ", "") == text.replace(" ", "")


@given(WORDS)
def test_a_block_comment_is_one_comment_with_every_word(words: list[str]) -> None:
    lines = block_comment(" ".join(words))
    text = "\n".join(lines)
    assert text.startswith("/*")
    assert text.index("*/", 2) == len(text) - 2
    assert all(len(line) <= WIDTH + 6 for line in lines)
    inside = " ".join(line.removeprefix(" *") if len(lines) > 1 else line for line in lines)
    for word in words:
        assert comment(word).replace(" ", "") in inside.replace(" ", "")


def test_an_empty_text_is_no_comment() -> None:
    assert block_comment("") == []


@given(NAMES, st.integers(20, 110))
def test_filled_lines_keep_all_segments_and_break_only_where_one_does_not_fit(
    segments: list[str], width: int
) -> None:
    first, *more = fill("x =", tuple(segments), ";", width)
    assert all(line.startswith("    ") for line in more)
    parts = [line.split() for line in (first, *more)]
    assert [x for line in parts for x in line] == f"x = {' '.join(segments)};".split()
    own = [2, *(0 for _ in more)]
    for line, words, start in zip((first, *more), parts, own, strict=True):
        assert len(line) <= width - 8 or len(words) == start + 1
    for line, (following, *_) in zip((first, *more), parts[1:], strict=False):
        assert len(line) + 1 + len(following) > width - 8


@given(NAMES, st.integers(20, 110))
def test_statements_share_a_line_exactly_if_they_fit(names: list[str], width: int) -> None:
    statements = [f"{name} = 1;" for name in names]
    lines = together(statements, width)
    assert " ".join(lines) == " ".join(statements)
    for line, following in pairwise(lines):
        assert len(line) <= width - 8 or line.count(";") == 1
        assert len(line) + 1 + len(following.partition(";")[0]) + 1 > width - 8


def evaluated(segments: tuple[str, ...], **functions: Callable[..., object]) -> object:
    return eval(" ".join(segments), functions)


@given(st.lists(st.integers(-99, 99), min_size=1, max_size=33))
def test_a_maximum_is_a_tree_of_logarithmic_depth(numbers: list[int]) -> None:
    segments = greatest([f"value({x})" for x in numbers])

    def greater(a: tuple[int, int], b: tuple[int, int]) -> tuple[int, int]:
        return max(a[0], b[0]), 1 + max(a[1], b[1])

    found = evaluated(segments, greater=greater, value=lambda x: (x, 0))
    assert found == (max(numbers), math.ceil(math.log2(len(numbers))))
    assert all(segment.endswith(",") for segment in segments[:-1])


@given(st.lists(st.integers(0, 99), max_size=9))
def test_a_call_has_all_its_arguments(numbers: list[int]) -> None:
    segments = closed_call("f", [str(x) for x in numbers])
    assert evaluated(segments, f=lambda *x: list(x)) == numbers
    assert len(segments) == max(1, len(numbers))
