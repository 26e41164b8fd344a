"""A header has every fact of its recipe, in order, on lines that are not too long."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from codegen.printers.recipe import Recipe, entry, header

WORDS = st.lists(st.text("abcdef", min_size=1, max_size=12), min_size=1, max_size=40).map(" ".join)


@given(WORDS, st.integers(40, 100))
def test_wrapping_keeps_all_words_within_the_width(sentence: str, width: int) -> None:
    lines = entry("method", [sentence], width)
    assert " ".join(lines).split() == ["method:", *sentence.split()]
    assert max(map(len, lines)) <= width


@given(st.lists(WORDS, min_size=1, max_size=4))
def test_each_sentence_begins_a_line(sentences: list[str]) -> None:
    lines = entry("left out", sentences, 96)
    assert lines[0].startswith("left out:   ")
    assert all(line.startswith(" " * 12) for line in lines[1:])


def test_entries_without_content_are_absent() -> None:
    lines = header(Recipe("Step", (), (1.0,)), [], [], 80)
    assert lines == ["Step", ""]


def test_the_command_and_the_version_come_last() -> None:
    recipe = Recipe("Step", (("method", "m"),), (1.0,), left_out=("a", "b"), command="emit", version="1")
    words = [line.partition(":")[0].strip() for line in header(recipe, ["s"], ["2 add"], 80, "9 bytes")]
    assert words == [
        "Step",
        "",
        "method",
        "state",
        "left out",
        "b",
        "operations",
        "stack",
        "command",
        "version",
    ]


def test_a_quoted_file_name_in_the_command_is_not_broken() -> None:
    name = "'my  scene with a long name.py'"
    recipe = Recipe("t", (), (1.0,), command=f"orderconds emit {name} --method rk4")
    lines = header(recipe, ["s"], [], 40)
    assert any(name in line for line in lines)
    assert [line.strip() for line in lines[-3:]] == ["command:    orderconds emit", name, "--method rk4"]
