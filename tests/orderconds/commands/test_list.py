"""``orderconds list``: names of this package and of others."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds import families
from orderconds.cli import program
from orderconds.tableau import available


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["list", *args])


def test_families_are_those_of_the_registry_each_with_a_description() -> None:
    pairs = json.loads(run("families", "--json").stdout)["families"]
    assert [pair["name"] for pair in pairs] == list(families.names())
    assert all(pair["about"] for pair in pairs)


def test_tableaux_are_those_of_the_library_each_with_its_source() -> None:
    pairs = json.loads(run("tableaux", "--json").stdout)["tableaux"]
    assert [pair["name"] for pair in pairs] == list(available())
    assert all(pair["about"] for pair in pairs)


def test_a_listing_of_another_package_is_found_by_its_entry_point(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "colours_package.py").write_text(
        "def listing():\n    yield {'name': 'red', 'about': 'a colour'}\n"
    )
    info = tmp_path / "colours_package-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: colours-package\nVersion: 1\n")
    (info / "entry_points.txt").write_text("[orderconds.listings]\ncolours = colours_package:listing\n")
    monkeypatch.syspath_prepend(tmp_path)
    assert "red" in run("colours").stdout
    assert json.loads(run("colours", "--json").stdout) == {"colours": [{"name": "red", "about": "a colour"}]}


def test_an_unknown_kind_exits_2_and_names_a_close_one() -> None:
    result = run("famlies")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "orderconds list families" in result.stderr
