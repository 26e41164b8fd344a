"""Worker processes end with the process that started them, however it ends."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from orderconds.errors import InputError
from orderconds.processes import in_processes
from orderconds.tableau import find

posix = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

COMMAND = """
import os, signal, sys, time
import click
from orderconds import cli
from orderconds.processes import in_processes
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job of a shell ignores it
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup ignores it
def work(seconds):
    os.write(1, b"working\\n")  # one call: two workers may print their words first and their line ends later
    time.sleep(seconds)
@click.command()
@click.option("--lost", is_flag=True)
def command(lost):
    found = in_processes(work, [600] * 8, 2)
    if lost:
        globals()["kept"] = found  # nobody closes it
    next(found)
cli.Program.get_command = lambda *_: command
cli.main()
"""


def die(seconds: int) -> None:
    if seconds == 0:
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(seconds)


def fail(text: str) -> int:
    return int(text)


def test_results_come_in_the_order_of_the_jobs() -> None:
    assert list(in_processes(fail, [str(n) for n in range(50)], 2)) == list(range(50))


def test_what_a_job_raises_is_raised_here_and_the_others_end() -> None:
    with pytest.raises(ValueError, match="invalid literal") as caught:
        list(in_processes(fail, ["1", "x", *map(str, range(50))], 2))
    (note,) = caught.value.__notes__
    assert "in a worker process" in note
    assert "in fail\n" in note


def test_an_iteration_that_is_left_early_waits_for_no_job() -> None:
    found = in_processes(time.sleep, [0, *[600] * 8], 2)
    next(found)
    found.close()  # type: ignore[attr-defined]


@posix
def test_a_worker_that_is_killed_is_one_error() -> None:
    with pytest.raises(InputError, match="a worker process was killed; expected enough memory for 2"):
        list(in_processes(die, [0, 600, 600], 2))


@posix
@pytest.mark.parametrize("words", [[], ["--lost"]])
@pytest.mark.parametrize(
    ("name", "status", "group"),
    [
        ("SIGTERM", 143, False),
        ("SIGHUP", 129, False),
        ("SIGINT", 130, False),
        ("SIGINT", 130, True),
        ("SIGTERM", 143, True),
        ("SIGKILL", -9, False),
    ],
)
def test_workers_end_with_the_program_so_that_its_pipe_closes(
    name: str, status: int, group: bool, words: list[str]
) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", COMMAND, "wait", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as child:
        assert child.stdout is not None
        assert [child.stdout.readline() for _ in range(2)] == ["working\n"] * 2
        (os.killpg if group else os.kill)(child.pid, getattr(signal, name))
        _, err = child.communicate(timeout=30)  # the workers hold the pipes too
    assert child.returncode == status
    assert err.count("\n") == (name != "SIGKILL")


def heed_interrupts() -> None:
    """Restore the default signals: background jobs of a shell ignore SIGINT, programs under nohup SIGHUP."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


def kept(checkpoint: Path) -> int:
    """Return how many batches a checkpoint holds; all but the first come from workers."""
    return len(json.loads(checkpoint.read_text())["batches"]) if checkpoint.exists() else 0


@posix
@pytest.mark.parametrize(
    ("name", "status", "said"),
    [("SIGTERM", 143, "stopped by SIGTERM"), ("SIGINT", 130, "interrupted"), ("SIGKILL", -9, "")],
)
def test_a_search_that_is_stopped_leaves_no_workers_and_goes_on_from_its_checkpoint(
    name: str, status: int, said: str, tmp_path: Path
) -> None:
    words = ["solve", "vcg", "--stages", "3", "--order", "3", "--minimise", "error", "--processes", "2"]
    command = [sys.executable, "-m", "orderconds", *words, "-o", str(tmp_path / "found.toml"), "--starts"]
    checkpoint = tmp_path / "found.toml.search"
    with subprocess.Popen(
        [*command, "1000000"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=heed_interrupts,
    ) as child:
        while child.poll() is None and kept(checkpoint) < 2:
            time.sleep(0.01)
        child.send_signal(getattr(signal, name))
        _, err = child.communicate(timeout=30)
    assert child.returncode == status
    if said:
        assert err.decode().startswith(
            f"orderconds: {said}; the results of the finished random starts are saved in "
        )
        assert err.count(b"\n") == 1
        assert os.listdir(tmp_path) == ["found.toml.search"]
    subprocess.run([*command, "64"], check=True, capture_output=True)
    assert {"found.toml"} == {path.name for path in tmp_path.iterdir() if not path.name.startswith(".")}


@posix
@pytest.mark.parametrize(("name", "status"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)])
@pytest.mark.parametrize("words", [[], ["--json"]])
def test_a_check_of_a_folder_that_is_stopped_leaves_no_workers_and_one_document(
    name: str, status: int, words: list[str], tmp_path: Path
) -> None:
    (tmp_path / "000.toml").write_text("=")  # its message says that the check has begun
    for number in range(1, 400):
        (tmp_path / f"{number:03}.toml").symlink_to(find("dop853"))
    with subprocess.Popen(
        [sys.executable, "-m", "orderconds", "check", str(tmp_path), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=heed_interrupts,
    ) as child:
        assert child.stderr is not None
        assert "000.toml" in child.stderr.readline()
        child.send_signal(getattr(signal, name))
        out, err = child.communicate(timeout=60)  # the workers hold the pipes too
    assert child.returncode == status
    assert err.count("\n") == 1
    if words:
        assert json.loads(out)["error"]["status"] == status


def nested(job: str) -> list[int]:
    return list(in_processes(len, [job, 2 * job], 2))


def test_a_job_may_start_jobs_which_run_in_its_worker() -> None:
    assert list(in_processes(nested, ["a", "bb"], 2)) == [[1, 2], [2, 4]]
