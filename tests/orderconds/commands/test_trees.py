"""``orderconds trees``: what is enumerated is as many as its generating function says."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program
from orderconds.explain.kinds import KINDS


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["trees", *args])


@pytest.mark.parametrize(
    ("kind", "numbers"),
    [
        ("rooted", [1, 1, 2, 4, 9, 20, 48]),
        ("ordered", [1, 1, 2, 5, 14, 42]),
        ("directed", [1, 1, 3, 8, 27, 91]),
        ("forests", [1, 2, 5, 14, 42]),
        ("lyndon", [1, 1, 3, 8, 25, 75]),
    ],
)
def test_enumerated_and_counted_numbers_agree(kind: str, numbers: list[int]) -> None:
    for order, number in enumerate(numbers, start=1):
        assert run(kind, "--order", str(order), "--count").stdout == f"{number}\n"
        listed = run(kind, "--order", str(order)).stdout.splitlines()
        assert len(listed) == len(set(listed)) == number


def test_json_is_one_record() -> None:
    record = json.loads(run("rooted", "--order", "3", "--json").stdout)
    assert (record["kind"], record["order"], record["count"], sorted(record["trees"])) == (
        "rooted",
        3,
        2,
        ["[..]", "[[.]]"],
    )
    assert "trees" not in json.loads(run("rooted", "--order", "30", "--count", "--json").stdout)


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in ("graded", "letters")])
def test_drawings_have_one_line_a_vertex(kind: str) -> None:
    lines = run(kind, "--order", "4", "--draw").stdout.splitlines()
    drawn = [line for line in lines if line.startswith("    ") and "◇" not in line]
    assert len(drawn) == 4 * int(run(kind, "--order", "4", "--count").stdout)


@pytest.mark.parametrize("kind", KINDS)
def test_explanations_give_a_name_and_a_condition(kind: str) -> None:
    result = run(kind, "--order", "3", "--explain")
    assert result.exit_code == 0
    number = int(run(kind, "--order", "3", "--count").stdout)
    assert result.stdout.count("    names      ") == result.stdout.count("    condition  ") == number
    record = json.loads(run(kind, "--order", "3", "--explain", "--draw", "--json").stdout)
    assert [len(record[key]) for key in ("trees", "drawings", "names", "conditions")] == [number] * 4


def test_ascii_drawings_are_ascii() -> None:
    for kind in KINDS:
        assert run(kind, "--order", "4", "--draw", "--ascii").stdout.isascii()


def test_a_stream_that_cannot_carry_unicode_gets_ascii() -> None:
    runner = CliRunner(charset="ascii")
    assert "    +-o\n" in runner.invoke(program, ["trees", "rooted", "--order", "2", "--draw"]).stdout


def test_svg_goes_to_a_file(tmp_path: Path) -> None:
    target = tmp_path / "trees.svg"
    result = run("bicoloured", "--order", "3", "--svg", str(target))
    assert (result.exit_code, result.stdout) == (0, "")
    assert target.read_text(encoding="utf-8").count("<circle") == 14 * 3
    missing = run("rooted", "--order", "3", "--svg", str(tmp_path / "none" / "trees.svg"))
    assert (missing.exit_code, missing.stderr.count("\n")) == (2, 1)


def test_the_drawing_of_a_rooted_tree() -> None:
    out = run("rooted", "--order", "4", "--draw", "--ascii").stdout
    assert "    o\n    +-o\n    | +-o\n    +-o\n" in out


@pytest.mark.parametrize(
    "args",
    [
        ["roted", "--order", "3"],
        ["rooted"],
        ["rooted", "--order", "-1"],
        ["rooted", "--order", "3", "--svg", ""],
        ["rooted", "--order", "3", "--count", "--draw"],
        ["rooted", "--order", "3", "--count", "--explain"],
        ["rooted", "--order", "3", "--ascii"],
        ["rooted", "--order", "3", "--ascii", "--count"],
        ["rooted", "--order", "3", "--ascii", "--draw", "--svg", "/nowhere/trees.svg"],
    ],
)
def test_bad_usage_exits_2_with_one_message(args: list[str]) -> None:
    result = run(*args)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)


def test_ascii_is_refused_exactly_if_no_text_drawing_is_printed() -> None:
    for drawn in (["--draw"], ["--explain"], ["--draw", "--json"]):
        assert run("rooted", "--order", "3", "--ascii", *drawn).exit_code == 0
    for undrawn in ([], ["--json"], ["--explain", "--json"]):
        assert "--ascii has no effect" in run("rooted", "--order", "3", "--ascii", *undrawn).stderr


def test_a_misspelt_kind_is_told_the_right_one() -> None:
    assert "orderconds trees rooted" in run("roted", "--order", "3").stderr


@pytest.mark.parametrize("words", [[], ["--json"], ["--svg", "trees.svg"], ["--count", "--svg", "trees.svg"]])
def test_more_trees_than_anyone_reads_are_refused_before_the_first(words: list[str]) -> None:
    result = run("graded", "--order", "40", *words)
    assert result.exit_code == 2
    assert (
        "trees graded: there are 27487764474 trees or words of order 40; expected at most 100000"
        in result.stderr
    )


def test_their_number_has_no_such_bound() -> None:
    assert run("graded", "--order", "40", "--count").stdout == "27487764474\n"
