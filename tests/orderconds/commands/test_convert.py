"""``orderconds convert``: what stands on stdout, and the record of --json."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds import Tableau
from orderconds.cli import program
from orderconds.exchange import FORMATS
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
    assert "the output does not contain the key proof" in run("yoshida6", "--to", "csv").stderr


def test_an_extension_that_a_format_has_no_place_for_is_announced() -> None:
    for to in FORMATS:
        result = run("bogacki_shampine3", "--to", to)
        announced = "the output does not contain the key dense" in result.stderr
        assert (result.exit_code, announced) == (0, to not in ("toml", "json"))
    record = json.loads(run("bogacki_shampine3", "--to", "csv", "--json").stdout)
    assert record["left_out"] == ["dense"]


@pytest.mark.parametrize("to", ["toml", "json", "csv", "sympy", "latex", "c"])
def test_name_sets_the_name_of_the_new_tableau(to: str, tmp_path: Path) -> None:
    record = json.loads(run("rk4", "--to", to, "--name", "other", "--json").stdout)
    path = tmp_path / f"m{FORMATS[to][1]}"
    path.write_text(record["tableau"])
    assert (record["name"], Tableau.load(path).name) == ("other", "other")
    unnamed = tmp_path / "unnamed.csv"
    unnamed.write_text("A,0\nb,1\n")
    assert json.loads(run(str(unnamed), "--json").stdout)["name"] == "unnamed"


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


def test_a_name_of_the_library_to_every_format_and_back(tmp_path: Path) -> None:
    for _, suffix in FORMATS.values():
        there, back = tmp_path / f"x{suffix}", tmp_path / "back.toml"
        assert run("gauss2", "-o", str(there)).exit_code == 0
        assert run(str(there), "-o", str(back)).exit_code == 0
        assert Tableau.load(back).method == Tableau.load(find("gauss2")).method


def test_json_on_stdout() -> None:
    result = run("rk4", "--to", "json")
    assert result.exit_code == 0
    assert json.loads(result.output)["b"] == ["1/6", "1/3", "1/3", "1/6"]


def test_a_proof_that_a_format_has_no_place_for_is_left_out_with_a_word() -> None:
    for to in FORMATS:
        result = run("cg4a", "--to", to)
        assert result.exit_code == 0
        assert ("the output does not contain the key proof" in result.stderr) is (to not in ("toml", "json"))
        assert "does not contain" not in run("cg3", "--to", to).stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ["nothing"],
        ["rk4", "--to", "yaml"],
        ["rk4", "-o", "x.yaml"],
        ["/nowhere/x.csv"],
        ["strang", "--to", "c"],
    ],
)
def test_bad_usage_ends_with_2(arguments: list[str]) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert "Traceback" not in result.output
