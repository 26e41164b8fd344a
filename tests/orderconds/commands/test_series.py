"""``orderconds series``: Lie series as text and JSON, in both bases."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program
from orderconds.words.lie_series import SERIES


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["series", *args])


def test_bch_has_dynkins_terms() -> None:
    lines = run("bch", "--order", "4").stdout.splitlines()
    assert lines[0] == "bch: log(exp A exp B)"
    assert [line.split(maxsplit=2)[1:] for line in lines[2:]] == [
        ["1", "A"],
        ["1", "B"],
        ["1/2", "[A, B]"],
        ["1/12", "[A, [A, B]]"],
        ["1/12", "[[A, B], B]"],
        ["1/24", "[A, [[A, B], B]]"],
    ]


def test_json_names_series_order_and_basis() -> None:
    record = json.loads(run("bch", "--order", "4", "--basis", "hall", "--json").stdout)
    assert (record["series"], record["order"], record["basis"]) == ("bch", 4, "hall")
    assert record["terms"][-1] == {"weight": 4, "bracket": "[B, [A, [A, B]]]", "coefficient": "-1/24"}


@pytest.mark.parametrize("name", SERIES)
def test_the_help_names_every_series(name: str) -> None:
    assert f"\n  {name} " in run("--help").stdout
    assert run(name, "--order", "3").exit_code == 0


@pytest.mark.parametrize(
    "args",
    [["bhc", "--order", "3"], ["bch"], ["bch", "--order", "0"], ["bch", "--order", "3", "--basis", "x"]],
)
def test_bad_usage_exits_2_with_one_message(args: list[str]) -> None:
    result = run(*args)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
