"""``orderconds convert``: what stands on stdout, and the record of --json."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds import Tableau
from orderconds.cli import program
from orderconds.tableau import find


def run(*words: str) -> Result:
    return CliRunner().invoke(program, ["convert", *words])


@pytest.mark.parametrize("to", ["toml", "json", "csv", "sympy", "latex", "c"])
def test_the_record_holds_the_text_that_is_written_without_it(to: str) -> None:
    record = json.loads(run("rk4", "--to", to, "--json").stdout)
    assert (record["name"], record["from"], record["to"], record["path"]) == ("rk4", "toml", to, None)
    assert record["tableau"] == run("rk4", "--to", to).stdout


def test_the_record_says_what_was_left_out_and_stderr_says_nothing() -> None:
    result = run("yoshida6", "--to", "csv", "--json")
    assert json.loads(result.stdout)["left_out"] == ["proof"]
    assert result.stderr == ""
    assert "its proof is left out" in run("yoshida6", "--to", "csv").stderr


def test_an_archive_is_no_text_and_needs_a_file(tmp_path: Path) -> None:
    assert "give -o FILE" in run("rk4", "--to", "numpy", "--json").stderr
    path = tmp_path / "rk4.npz"
    record = json.loads(run("rk4", "-o", str(path), "--json").stdout)
    assert (record["path"], record["tableau"]) == (str(path), None)
    again = Tableau.loads(run(str(path)).stdout)
    assert again.method == Tableau.load(find("rk4")).method


def test_a_spreadsheet_s_byte_order_mark_is_no_part_of_the_first_cell(tmp_path: Path) -> None:
    path = tmp_path / "euler.csv"
    path.write_bytes(b"\xef\xbb\xbf0,0\n,1\n")
    assert str(Tableau.loads(run(str(path)).stdout).method) == "RungeKutta(A=((0,),), b=(1,))"
