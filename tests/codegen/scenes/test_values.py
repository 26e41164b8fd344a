"""The name of a scene may contain values of parameters."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from codegen import scenes
from codegen.errors import SceneError
from codegen.lab.reference import cached_reference
from orderconds.cli import program


def test_values_change_the_field_and_the_reference_but_not_the_gallery() -> None:
    usual = scenes.load("driven_spin")
    changed = scenes.load("driven_spin[nu=3/5,alpha=1/4]")
    assert changed.name == "driven_spin[alpha=1/4,nu=3/5]"
    assert changed.parameters["nu"].text() == "3/5"
    assert scenes.load("driven_spin").parameters["nu"].text() == usual.parameters["nu"].text()
    assert cached_reference(changed).digits(8) != cached_reference(usual).digits(8)


def test_a_value_equal_to_the_default_changes_nothing_but_the_name() -> None:
    default = scenes.load("driven_spin").parameters["nu"].text()
    same = scenes.load(f"driven_spin[nu={default}]")
    assert cached_reference(same).digits() == cached_reference(scenes.load("driven_spin")).digits()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("driven_spin[beta=1]", "unknown parameter 'beta'"),
        ("driven_spin[nu=1,nu=2]", "two values of the parameter nu"),
        ("driven_spin[nu=x]", "the value 'x' of the parameter nu"),
        ("driven_spin[]", "unknown parameter ''"),
    ],
)
def test_a_value_that_cannot_be_used_is_named(name: str, message: str) -> None:
    with pytest.raises(SceneError, match=re.escape(message)):
        scenes.load(name)


def test_the_option_and_the_name_give_the_same_measurement(tmp_path: Path) -> None:
    words = ["converge", "--method", "ambient:rk4", "--target", "python", "--steps", "20,40,80", "--json"]
    by_option = CliRunner().invoke(program, [*words, "-P", "nu=3/5", "--", "driven_spin"])
    by_name = CliRunner().invoke(program, [*words, "--", "driven_spin[nu=3/5]"])
    assert json.loads(by_option.stdout)[0]["scene"] == "driven_spin[nu=3/5]"
    assert by_option.stdout == by_name.stdout
    refused = CliRunner().invoke(program, [*words, "-P", "nu", "--", "driven_spin"])
    assert refused.exit_code == 2
    assert "expected NAME=VALUE" in refused.stderr


def test_file_names_contain_no_slash() -> None:
    assert "/" not in scenes.file_stem(scenes.load("driven_spin[nu=3/5]"))
