"""Kills, full disks, missing compilers and homes: nothing is half written, and the next run works."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from codegen.commands.emit import command as emit
from codegen.commands.regenerate import command as regenerate
from codegen.commands.report import command as report
from codegen.loader import load
from orderconds.errors import InputError
from orderconds.output_file import SUFFIX

ROOT = Path(__file__).parents[3]
posix = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

LIST = """
[[module]]
scene = "free_rigid_body"
method = "cf4"
targets = ["c", "python"]
"""

PROGRAM = """
import os, signal, sys
from importlib import import_module
limit, module, words = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
replace, done = os.replace, []
def kill(*names):
    if len(done) == limit:
        os.kill(os.getpid(), signal.SIGKILL)
    done.append(replace(*names))
os.replace = kill
import_module(module).command(words, standalone_mode=False)
"""


def run(command: click.Command, *words: str) -> str:
    result = CliRunner().invoke(command, words, standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result.stdout


def kill_at(rename: int, module: str, *words: str) -> None:
    """Run a command in a process that is killed in place of the rename of that number."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(rename), f"codegen.commands.{module}", *words],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        check=False,
    )
    assert done.returncode == -signal.SIGKILL


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@posix
@pytest.mark.parametrize("rename", [0, 3])
def test_a_regeneration_that_is_killed_is_completed_by_the_next(rename: int, tmp_path: Path) -> None:
    (tmp_path / "list.toml").write_text(LIST)
    words = ("--list", str(tmp_path / "list.toml"), "-o", str(tmp_path / "made"))
    kill_at(rename, "regenerate", *words)
    assert any(name.endswith(SUFFIX) for name in contents(tmp_path / "made"))
    told = run(regenerate, *words, "--check")
    assert f"{4 - rename} differences, 4 files expected; type: orderconds regenerate" in told
    assert SUFFIX not in told
    run(regenerate, *words)
    assert run(regenerate, *words, "--check").startswith("0 differences")
    assert not any(name.endswith(SUFFIX) for name in contents(tmp_path / "made"))


@posix
@pytest.mark.parametrize("rename", [0, 1])
def test_an_emission_that_is_killed_is_repaired_by_the_next(rename: int, tmp_path: Path) -> None:
    words = ("free_rigid_body", "-m", "cf4", "-t", "python", "-o", str(tmp_path / "made"))
    kill_at(rename, "emit", *words)
    with pytest.raises(InputError, match="0 modules match"):
        load(tmp_path / "made")
    run(emit, *words)
    assert load(tmp_path / "made").interface.size == 3
    assert not any(name.endswith(SUFFIX) for name in contents(tmp_path / "made"))


@pytest.mark.parametrize("stop", [KeyboardInterrupt(), OSError(30, "Read-only file system")])
@pytest.mark.parametrize("rename", [0, 1])
def test_an_emission_that_stops_leaves_no_temporary_file(
    stop: BaseException, rename: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = ("free_rigid_body", "-m", "cf4", "-t", "python", "-o", str(tmp_path / "made"))
    replace, done = os.replace, []

    def refuse(*names: str) -> None:
        if len(done) == rename:
            raise stop
        done.append(replace(*names))

    monkeypatch.setattr("orderconds.output_file.os.replace", refuse)
    expected = InputError if isinstance(stop, OSError) else (KeyboardInterrupt, click.Abort)
    with pytest.raises(expected):
        run(emit, *words)
    assert len(contents(tmp_path / "made")) == rename


def test_without_a_compiler_one_message_says_what_to_install(tmp_path: Path) -> None:
    environment = {**os.environ, "PATH": str(tmp_path), "PYTHONPATH": str(ROOT)}
    environment.pop("CC", None)
    command = [
        sys.executable,
        "-m",
        "orderconds",
        "converge",
        "free_rigid_body",
        "-m",
        "cf4",
        "--target",
        "c",
    ]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "orderconds: PATH: no C compiler; expected cc, gcc or clang; "
        "install a compiler, or set CC to its command\n"
    )


def test_an_almost_empty_environment_is_enough(tmp_path: Path) -> None:
    """No HOME, no locale: the home folder is the account's, or the cache a temporary one."""
    environment = {"PATH": os.environ["PATH"], "PYTHONPATH": str(ROOT), "XDG_CACHE_HOME": str(tmp_path)}
    environment |= {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}
    command = [
        sys.executable,
        "-m",
        "orderconds",
        "converge",
        "free_rigid_body",
        "-m",
        "cf4",
        "--target",
        "c",
    ]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


REPORT = ("report", "free_rigid_body", "-m", "cg:cg3", "--quick", "--only", "orders", "--only", "long", "-o")


@posix
@pytest.mark.parametrize(
    ("name", "status"), [pytest.param("SIGKILL", -9, marks=pytest.mark.slow), ("SIGINT", 130)]
)
def test_a_report_that_is_stopped_leaves_whole_pages_and_is_completed_by_the_next(
    name: str, status: int, tmp_path: Path
) -> None:
    folder = tmp_path / "report"
    command = [sys.executable, "-m", "orderconds", *REPORT, str(folder)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        command,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),  # background jobs ignore it
    ) as child:
        while child.poll() is None and not list(folder.glob(".measured/*")):
            time.sleep(0.005)
        child.send_signal(getattr(signal, name))
        _, err = child.communicate(timeout=60)  # its workers hold the pipes too
    assert (child.returncode, err.count(b"\n")) == (status, int(name == "SIGINT"))
    assert not list(folder.glob("*.html"))
    assert not [path for path in folder.rglob("*") if name == "SIGINT" and path.name.endswith(SUFFIX)]
    done = subprocess.run([*command, "--json"], env=environment, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert sorted(contents(folder)) == ["free_rigid_body.html", "index.html"]
    for page in contents(folder).values():
        assert page.endswith(b"</html>\n")


PAGES = (*REPORT[1:5], "--only", "orders", "-o")
"""One measurement, then two pages: one of the scene and the overview."""


@posix
@pytest.mark.parametrize(
    ("rename", "pages"), [pytest.param(1, [], marks=pytest.mark.slow), (2, ["free_rigid_body.html"])]
)
def test_a_report_that_is_killed_between_its_pages_leaves_whole_pages_and_is_completed_by_the_next(
    rename: int, pages: list[str], tmp_path: Path
) -> None:
    kill_at(rename, "report", *PAGES, str(tmp_path))
    assert [path.name for path in tmp_path.glob("*.html")] == pages
    for page in pages:
        assert (tmp_path / page).read_text(encoding="utf-8").endswith("</html>\n")
    assert run(report, *PAGES, str(tmp_path))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["free_rigid_body.html", "index.html"]


@posix
@pytest.mark.parametrize("room", [pytest.param(500, marks=pytest.mark.slow), 5000])
def test_a_disk_that_is_full_before_or_between_pages_is_one_message(room: int, tmp_path: Path) -> None:
    """A limit on the size of a file acts as a full disk, and needs no disk."""
    command = [sys.executable, "-m", "orderconds", "report", *PAGES, str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    limit = partial(limit_files, room)
    full = subprocess.run(
        command, env=environment, capture_output=True, text=True, check=False, preexec_fn=limit
    )
    assert (full.returncode, full.stdout, full.stderr.count("\n")) == (2, "", 1)
    assert f"{tmp_path}: cannot write to this path: file too large" in full.stderr
    assert [path.name for path in tmp_path.rglob("*") if path.suffix in (".html", SUFFIX)] == []
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["free_rigid_body.html", "index.html"]


def limit_files(room: int) -> None:
    """Bound the files that a process writes, in bytes."""
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))


@posix
@pytest.mark.parametrize("words", [pytest.param([], marks=pytest.mark.slow), ["--json"]])
def test_a_report_whose_reader_goes_away_has_its_pages(words: list[str], tmp_path: Path) -> None:
    command = [sys.executable, "-m", "orderconds", "report", *PAGES, str(tmp_path), *words]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(command, env=environment, stdout=writing, stderr=subprocess.PIPE, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, b"")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["free_rigid_body.html", "index.html"]


@posix
@pytest.mark.parametrize(
    "words",
    [
        "emit free_rigid_body -m cf4 -o FOLDER/made",
        "convert rk4 -o FOLDER/rk4.json",
        "solve rk -s 1 -p 1 -o FOLDER/found.toml",
        "report free_rigid_body -m cg:cg3 --only orders -o FOLDER/report",
        "regenerate -o FOLDER/made",
    ],
)
def test_a_read_only_folder_is_one_message(words: str, tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    if os.access(tmp_path, os.W_OK):
        pytest.skip("this user writes everywhere")
    command = [sys.executable, "-m", "orderconds", *words.replace("FOLDER", str(tmp_path)).split()]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    tmp_path.chmod(0o700)
    assert (done.returncode, done.stdout) == (2, "")
    assert "permission denied" in done.stderr.lower()
    assert list(tmp_path.iterdir()) == []
