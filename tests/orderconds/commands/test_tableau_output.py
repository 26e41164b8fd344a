"""The suffix of an output file determines the format, in every command that writes a tableau."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program
from orderconds.commands import solve, tableau_output
from orderconds.commands.tableau_output import output_format
from orderconds.errors import InputError
from orderconds.exchange import FORMATS
from orderconds.tableau import Tableau, find

SUFFIXES = [suffix for _, suffix in FORMATS.values()]
COMMANDS = {
    "construct": "construct gauss --stages 2",
    "convert": "convert gauss2",
    "extend": "extend ralston3",
    "refine": "refine yoshida6 --digits 20",
    "solve": "solve rk --stages 2 --order 2 --explicit --processes 1",
}


def run(words: str, *more: str) -> Result:
    return CliRunner().invoke(program, [*words.split(), *more])


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("name", ["construct", "solve"])
def test_the_file_has_the_format_of_its_suffix(name: str, suffix: str, tmp_path: Path) -> None:
    whole, other = tmp_path / "whole.toml", tmp_path / f"other{suffix}"
    assert run(COMMANDS[name], "-o", str(whole)).exit_code == 0
    assert run(COMMANDS[name], "-o", str(other)).exit_code == 0
    assert Tableau.load(other).method == Tableau.load(whole).method
    assert Tableau.load(other).claims == Tableau.load(whole).claims


def test_a_json_file_gets_its_extension_in_place(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    assert run("convert ralston3", "-o", str(path)).exit_code == 0
    assert run(f"extend {path}", "-o", str(path)).exit_code == 0
    extension = Tableau.load(path).extension
    assert extension is not None
    assert extension.order == 2


@pytest.mark.parametrize("suffix", [suffix for suffix in SUFFIXES if suffix not in (".toml", ".json")])
def test_an_extension_is_not_written_to_a_file_that_cannot_contain_it(suffix: str, tmp_path: Path) -> None:
    result = run(COMMANDS["extend"], "-o", str(tmp_path / f"x{suffix}"))
    assert (result.exit_code, os.listdir(tmp_path)) == (2, [])
    assert "cannot contain a continuous extension" in result.stderr


@pytest.mark.parametrize("file", ["x.xyz", "x", "x.toml.txt"])
@pytest.mark.parametrize("name", COMMANDS)
def test_an_unknown_suffix_is_refused_before_any_work(name: str, file: str, tmp_path: Path) -> None:
    result = run(f"{COMMANDS[name]} --json -o {tmp_path / file}")
    assert (result.exit_code, os.listdir(tmp_path)) == (2, [])
    assert "a file with an unknown suffix" in result.stderr
    if name != "convert":
        source = "nowhere.toml" if name in ("extend", "refine") else "nothing"
        command, _, *options = COMMANDS[name].split()
        assert "unknown suffix" in run(" ".join([command, source, *options]), "-o", "x.xyz").stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_says_that_the_suffix_determines_the_format(name: str) -> None:
    text = " ".join(run(f"{name} --help").stdout.split())
    assert "uffix of --output indicates the format" in text or "suffix of FILE determines the format" in text


@pytest.mark.skipif(os.name != "posix", reason="devices")
def test_a_device_without_a_suffix_gets_toml(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    assert [output_format(x) for x in (os.devnull, str(pipe), None)] == ["toml"] * 3
    with pytest.raises(InputError, match="unknown suffix"):
        output_format(str(tmp_path))


def test_a_search_is_refused_if_no_method_of_the_family_fits_the_format(tmp_path: Path) -> None:
    words = "solve splitting --stages 2 --order 2 --processes 1"
    result = run(words, "-o", str(tmp_path / "x.csv"))
    assert (result.exit_code, os.listdir(tmp_path)) == (2, [])
    assert "the format csv cannot represent methods of the family splitting" in result.stderr
    assert run(words, "-o", str(tmp_path / "x.json")).exit_code == 0
    assert Tableau.load(tmp_path / "x.json").family == "splitting"


def test_a_method_that_does_not_fit_the_format_is_not_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object) -> None:
        raise InputError("too long")

    monkeypatch.setattr(solve, "put_tableau", refused)
    result = run(COMMANDS["solve"], "-o", str(tmp_path / "x.csv"))
    assert (result.exit_code, os.listdir(tmp_path)) == (2, ["x.csv.toml"])
    assert "the method was written to the file" in result.stderr
    assert Tableau.load(tmp_path / "x.csv.toml").s == 2


def test_a_note_names_each_key_that_the_file_omits(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from orderconds.tableau.write import as_data

    data = as_data(Tableau.load(find("rk4")))
    tableau_output.put_tableau(str(tmp_path / "x.csv"), "csv", data)
    assert capsys.readouterr().err.startswith("note: the output does not contain the key dense")
    tableau_output.put_tableau(str(tmp_path / "x.json"), "json", data)
    assert capsys.readouterr().err == ""
