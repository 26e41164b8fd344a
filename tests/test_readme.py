"""What the README shows is what the program prints."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds.cli import program

ROOT = Path(__file__).parents[1]
SESSIONS = re.findall(
    r"^\$ orderconds ((?:derive|check|solve|trees) [^\n;]*)(; echo \$\?)?\n(.*?)^```",
    (ROOT / "README.md").read_text(encoding="utf-8"),
    re.MULTILINE | re.DOTALL,
)


@pytest.mark.parametrize(("command", "with_status", "shown"), SESSIONS)
def test_sessions_of_the_readme(
    command: str, with_status: str, shown: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(ROOT / "tableaux", tmp_path / "tableaux")
    cg3 = (tmp_path / "tableaux/cg/cg3.toml").read_text(encoding="utf-8")
    exchanged = cg3.replace('"119/216", "17/108"', '"17/108", "119/216"')
    (tmp_path / "exchanged.toml").write_text(exchanged, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(program, shlex.split(command))
    # A session leaves out the empty line that ends a report.
    status = f"{result.exit_code}\n" if with_status else ""
    assert result.stdout.rstrip("\n") + "\n" + status == shown


def test_the_readme_shows_sessions() -> None:
    assert len(SESSIONS) == 6
