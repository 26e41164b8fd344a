"""Scenes in files go through all commands of the lab, without an internal error."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds.cli import program

SCENES = sorted((Path(__file__).parents[2] / "valid" / "scenes").glob("*.py"))
COMMANDS = {
    "converge": ["--method", "ambient:rk4", "--method", "cf:cf4"],
    "localerror": ["--method", "ambient:rk4"],
    "longrun": ["--method", "ambient:rk4", "--steps", "2000", "--h", "0.01"],
    "stability": ["--method", "ambient:rk4", "--quick"],
    "bench": ["--method", "ambient:rk4", "--budget", "0.01"],
    "recommend": ["--error", "1e-4", "--tableau", "rk4", "--budget", "5"],
}


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_scene_of_a_user_is_measured(command: str, scene: Path) -> None:
    result = CliRunner().invoke(program, [command, *COMMANDS[command], "--json", "--", str(scene)])
    assert result.exit_code in (0, 1), result.stderr
    assert json.loads(result.stdout)


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_a_report_on_a_scene_of_a_user_is_complete(scene: Path, tmp_path: Path) -> None:
    words = ["report", str(scene), "--quick", "--method", "ambient:rk4", "-o", str(tmp_path)]
    result = CliRunner().invoke(program, words)
    assert result.exit_code in (0, 1), result.stderr
    assert {"index.html", f"{scene.stem}.html"} <= {path.name for path in tmp_path.iterdir()}
