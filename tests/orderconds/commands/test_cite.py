"""``orderconds cite``: every tableau of the library has a source that can be cited."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program
from orderconds.commands.cite import bibliography
from orderconds.tableau import available


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["cite", *args])


@pytest.mark.parametrize("name", available())
def test_every_tableau_of_the_library_can_be_cited(name: str) -> None:
    result = run(name)
    assert result.exit_code == 0, result.stderr
    assert "@" in result.stdout


def test_a_key_is_cited_as_the_tableau_that_names_it_is() -> None:
    record = json.loads(run("cg3", "--json").stdout)
    assert record["bibtex"] == json.loads(run(record["key"], "--json").stdout)["bibtex"]
    assert record["bibtex"].startswith("@")
    assert record["key"] in record["bibtex"]


def test_keys_are_unique_and_entries_are_balanced() -> None:
    entries = bibliography()
    assert len(entries) == len({key.lower() for key in entries})
    assert all(entry.count("{") == entry.count("}") for entry in entries.values())


def test_an_unknown_name_exits_2_with_one_message() -> None:
    result = run("nobody1999")
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
