"""``orderconds construct``: a file that reads back, and one message where there is none to write."""

from __future__ import annotations

import json
from pathlib import Path

from click.testing import CliRunner

from orderconds.cli import program
from orderconds.tableau import Tableau
from orderconds.tableau.collocation import construct


def run(*arguments: str) -> tuple[int, str, str]:
    done = CliRunner().invoke(program, ["construct", *arguments])
    return done.exit_code, done.stdout, done.stderr


def test_the_file_is_the_method() -> None:
    status, text, _ = run("radau2a", "--stages", "3")
    assert status == 0
    assert Tableau.loads(text).method == construct("radau2a", 3).method


def test_the_output_goes_to_the_file_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "lobatto.toml"
    assert run("lobatto3c", "-s", "4", "-o", str(path)) == (0, "", "")
    assert Tableau.load(path).name == "lobatto3c4"


def test_json_tells_kind_stages_and_order() -> None:
    status, text, _ = run("gauss", "--stages", "4", "--json")
    record = json.loads(text)
    assert (status, record["order"], record["stages"]) == (0, 8, 4)
    assert Tableau.loads(record["tableau"]).name == "gauss4"


def test_a_folder_that_is_not_there_is_one_message(tmp_path: Path) -> None:
    status, _, told = run("gauss", "-s", "2", "-o", str(tmp_path / "none" / "x.toml"))
    assert status == 2
    assert told.count("\n") == 1
