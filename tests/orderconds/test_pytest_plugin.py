"""``pytest --orderconds DIR``: a folder of tableaux is a gate."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

EULER = 'name = "euler"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n[claims]\nrk = {}\n'


def run(folder: Path, *flags: str, target: str = ".") -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pytest", "-p", "orderconds.pytest_plugin", "-p", "no:cacheprovider"]
    root = Path(__file__).parents[2]
    return subprocess.run(
        [
            *command,
            "-q",
            "--rootdir",
            str(folder),
            "-c",
            str(folder / "none.ini"),
            *flags,
            str(folder / target),
        ],
        capture_output=True,
        text=True,
        cwd=root,
        check=False,
    )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "none.ini").write_text("[pytest]\n", encoding="utf-8")
    (tmp_path / "euler.toml").write_text(EULER.format(1), encoding="utf-8")
    (tmp_path / "pyproject.toml").write_text("[project]\n", encoding="utf-8")
    return tmp_path


def test_a_folder_of_sound_tableaux_passes(folder: Path) -> None:
    result = run(folder, "--orderconds")
    assert result.returncode == 0, result.stdout + result.stderr
    assert "1 passed" in result.stdout


def test_a_wrong_claim_fails_with_the_condition_and_no_traceback(folder: Path) -> None:
    (folder / "wrong.toml").write_text(EULER.format(2), encoding="utf-8")
    result = run(folder, "--orderconds")
    assert result.returncode == 1
    assert "rk: order 1, claimed 2" in result.stdout
    assert "sum_i b_i c_i = 1/2, residual -1/2" in result.stdout
    assert "Traceback" not in result.stdout + result.stderr
    assert "1 failed, 1 passed" in result.stdout


def test_a_file_that_cannot_be_read_fails_with_its_message(folder: Path) -> None:
    (folder / "broken.toml").write_text("name = ", encoding="utf-8")
    result = run(folder, "--orderconds")
    assert result.returncode == 1
    assert "expected a TOML file" in result.stdout


def test_complete_demands_every_family(folder: Path) -> None:
    result = run(folder, "--orderconds-complete")
    assert result.returncode == 1
    assert "no order is claimed in family cg, in which the method has order 1" in result.stdout


def test_certified_demands_proofs(folder: Path) -> None:
    text = EULER.format(1).replace('"1"', '"1.00000000000000000000~"')
    (folder / "rounded.toml").write_text(text.replace("euler", "rounded"), encoding="utf-8")
    assert run(folder, "--orderconds").returncode == 0
    result = run(folder, "--orderconds-certified")
    assert result.returncode == 1
    assert "rk: certificate decimal" in result.stdout
    assert "1 failed, 1 passed" in result.stdout


def test_a_tableau_without_claims_is_skipped_with_its_order(folder: Path) -> None:
    (folder / "silent.toml").write_text(EULER.partition("[claims]")[0], encoding="utf-8")
    result = run(folder, "--orderconds", "-rs")
    assert result.returncode == 0
    assert "the file claims no order; computed orders: rk 1" in result.stdout


def test_other_files_are_left_alone_unless_named(folder: Path) -> None:
    (folder / "Cargo.toml").write_text('[package]\nname = "x"\n', encoding="utf-8")
    assert "1 passed" in run(folder, "--orderconds").stdout
    result = run(folder, "--orderconds", target="Cargo.toml")
    assert "no family; expected one of cf" in result.stdout


def test_without_the_flag_nothing_is_collected(folder: Path) -> None:
    assert run(folder).returncode == 5
