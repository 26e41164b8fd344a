"""``orderconds converge``: exit statuses, JSON, and one message for bad input."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program

RAISES = "from sympy import Matrix\n\nscene = 1 / 0\n"


def run(*words: str) -> Result:
    return CliRunner().invoke(program, ["converge", *words])


def one_message(result: Result) -> str:
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert "Traceback" not in result.stderr
    return result.stderr


def test_the_stated_order_holds() -> None:
    result = run("free_rigid_body", "--method", "cg:cg3")
    assert result.exit_code == 0, result.output
    assert "holds: observed order 2.99, stated 3" in result.stdout


def test_json_is_a_list_with_one_object_a_method_and_nothing_else() -> None:
    words = ("free_rigid_body", "-m", "cg:cg3", "-m", "cf:cf4", "--target", "python", "--json")
    found: list[dict[str, Any]] = json.loads(run(*words).stdout)
    assert [f["method"] for f in found] == ["cg:cg3", "cf:cf4"]
    assert [f["stated_order"] for f in found] == [3, 4]
    assert {f["verdict"] for f in found} == {"holds"}


def test_too_few_runs_are_undecided_and_exit_1() -> None:
    result = run("free_rigid_body", "-m", "cg:cg3", "--steps", "20,40")
    assert result.exit_code == 1
    assert "undecided" in result.stdout


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nowhere", "-m", "cg3"), "unknown scene"),
        (("free_rigid_body", "-m", "cg33"), "cg33"),
        (("free_rigid_body", "-m", "vcg:gauss1"), "the family vcg cannot be used on free_rigid_body"),
        (("free_rigid_body", "-m", "cg3", "--target", "fortran"), "unknown target"),
        (("free_rigid_body", "-m", "cg3", "--digits", "40"), "--target interpreter"),
        (("free_rigid_body", "-m", "cg3", "--steps", "20,x"), "--steps"),
        (("free_rigid_body", "-m", "cg3", "--steps", "0"), "--steps"),
        (("free_rigid_body",), "--method"),
        (("--protocol", "strict", "-m", "cf4", "--steps", "20"), "cannot be used with --target, --st"),
        (
            ("--protocol", "strict", "-m", "cf4", "--target", "python"),
            "cannot be used with --target, --st",
        ),
        (("--protocol", "strict", "-m", "cf4", "--digits", "20"), "cannot be used with --target, --st"),
        (("dipole", "-m", "vcg:rk4", "--steps", "-3"), "--steps"),
    ],
)
def test_bad_input_is_one_message_and_exit_2(words: tuple[str, ...], said: str) -> None:
    assert said in one_message(run(*words))


def test_a_scene_that_raises_is_one_message_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text(RAISES)
    assert "mine.py:3" in one_message(run(str(path), "-m", "cg3"))
