"""``pytest --orderconds DIR``: a folder of tableaux is a gate."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

EULER = 'name = "euler"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n[claims]\nrk = {}\n'


Run = Callable[..., tuple[int, str]]


def arguments(folder: Path, *flags: str, target: str = ".") -> list[str]:
    """Return the arguments of pytest for a file or folder in ``folder``."""
    plugins = ["-p", "orderconds.pytest_plugin", "-p", "no:cacheprovider"]
    places = ["--rootdir", str(folder), "-c", str(folder / "none.ini")]
    return [*plugins, "-q", *places, *flags, str(folder / target)]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Return a function that runs pytest in this process and returns its status and output."""
    # A worker of pytest-xdist passes its options on in these variables.
    for name in ("PYTEST_ADDOPTS", "PYTEST_XDIST_WORKER", "PYTEST_XDIST_WORKER_COUNT"):
        monkeypatch.delenv(name, raising=False)

    def inside(folder: Path, *flags: str, target: str = ".") -> tuple[int, str]:
        capsys.readouterr()
        # At its end, the plugin unraisableexception collects the garbage of this large process five times.
        without = [f"no:{name}" for name in ("xdist", "hypothesispytest", "unraisableexception")]
        options = ["--capture=no", *(part for name in without for part in ("-p", name))]
        status = pytest.main([*options, *arguments(folder, *flags, target=target)])
        return int(status), "".join(capsys.readouterr())

    return inside


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "none.ini").write_text("[pytest]\n", encoding="utf-8")
    (tmp_path / "euler.toml").write_text(EULER.format(1), encoding="utf-8")
    (tmp_path / "pyproject.toml").write_text("[project]\n", encoding="utf-8")
    return tmp_path


def test_a_folder_of_sound_tableaux_passes(folder: Path) -> None:
    """In a process of its own, as a user starts it."""
    result = subprocess.run(
        [sys.executable, "-m", "pytest", *arguments(folder, "--orderconds")],
        capture_output=True,
        text=True,
        cwd=Path(__file__).parents[2],
        check=False,
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert "1 passed" in result.stdout


def test_a_wrong_claim_fails_with_the_condition_and_no_traceback(folder: Path, run: Run) -> None:
    (folder / "wrong.toml").write_text(EULER.format(2), encoding="utf-8")
    status, output = run(folder, "--orderconds")
    assert status == 1
    assert "rk: order 1, claimed 2" in output
    assert "sum_i b_i c_i = 1/2, residual -1/2" in output
    assert "Traceback" not in output
    assert "1 failed, 1 passed" in output


def test_a_file_that_cannot_be_read_fails_with_its_message(folder: Path, run: Run) -> None:
    (folder / "broken.toml").write_text("name = ", encoding="utf-8")
    status, output = run(folder, "--orderconds")
    assert status == 1
    assert "expected valid TOML" in output


def test_complete_demands_every_family(folder: Path, run: Run) -> None:
    status, output = run(folder, "--orderconds-complete")
    assert status == 1
    assert "no claim in family cg; the method has order 1 in this family" in output


def test_certified_demands_proofs(folder: Path, run: Run) -> None:
    text = EULER.format(1).replace('"1"', '"1.00000000000000000000~"')
    (folder / "rounded.toml").write_text(text.replace("euler", "rounded"), encoding="utf-8")
    assert run(folder, "--orderconds")[0] == 0
    status, output = run(folder, "--orderconds-certified")
    assert status == 1
    assert "rk: certificate decimal" in output
    assert "1 failed, 1 passed" in output


def test_a_tableau_without_claims_is_skipped_with_its_order(folder: Path, run: Run) -> None:
    (folder / "silent.toml").write_text(EULER.partition("[claims]")[0], encoding="utf-8")
    status, output = run(folder, "--orderconds", "-rs")
    assert status == 0
    assert "order 1; nothing claimed" in output


def test_other_files_are_left_alone_unless_named(folder: Path, run: Run) -> None:
    (folder / "Cargo.toml").write_text('[package]\nname = "x"\n', encoding="utf-8")
    assert "1 passed" in run(folder, "--orderconds")[1]
    _, output = run(folder, "--orderconds", target="Cargo.toml")
    assert "no family; expected one of cf" in output


def test_without_the_flag_nothing_is_collected(folder: Path, run: Run) -> None:
    assert run(folder)[0] == 5
