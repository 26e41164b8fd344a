"""Files that a user names are regular, of bounded size, and never waited for."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds.cli import program
from orderconds.errors import InputError
from orderconds.input_file import content_of, read_bytes, read_text

posix = pytest.mark.skipif(os.name != "posix", reason="pipes, links and owners of POSIX")


@posix
def test_a_pipe_is_refused_without_waiting_for_a_writer(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match=r"pipe: not a regular file"):
        read_bytes(tmp_path / "pipe")


def test_a_file_of_the_bound_is_read_and_a_byte_more_is_not(tmp_path: Path) -> None:
    path = tmp_path / "x"
    path.write_bytes(b"1234")
    assert read_bytes(path, limit=4) == b"1234"
    with pytest.raises(InputError, match="a file of more than 3 bytes; expected a list"):
        read_bytes(path, "a list", limit=3)


def test_bytes_that_are_no_text_and_names_that_are_none_are_bad_input(tmp_path: Path) -> None:
    (tmp_path / "latin").write_bytes(b"\xe9")
    with pytest.raises(InputError, match="bytes that are not UTF-8"):
        read_text(tmp_path / "latin")
    for name in ("a\0b", "a\ud800b"):
        with pytest.raises(InputError, match="not a valid file name"):
            read_text(name)


@posix
def test_an_own_file_is_no_link_and_belongs_to_the_user(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_bytes(b"text")
    (tmp_path / "link").symlink_to("file")
    assert content_of(tmp_path / "file", own=True) == content_of(tmp_path / "link") == b"text"
    with pytest.raises(OSError, match="not a regular file"):
        content_of(tmp_path / "link", own=True)
    user = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: user + 1)
    with pytest.raises(PermissionError, match="the file belongs to another user"):
        content_of(tmp_path / "file", own=True)


@posix
@pytest.mark.parametrize(
    "words",
    [
        "check FOLDER",
        "check FOLDER/pipe.toml",
        "check FOLDER/pipe.csv",
        "check FOLDER/excused",
        "convert FOLDER/pipe.json",
        "refine FOLDER/pipe.toml",
        "table --check FOLDER/pipe.toml",
        "emit FOLDER/pipe.py -m cf4 --json",
        "emit dipole -m FOLDER/pipe.toml --json",
        "regenerate --list FOLDER/pipe.toml -o FOLDER/made",
        "regenerate --list /dev/full -o FOLDER/made",
    ],
)
def test_no_command_waits_for_a_pipe_or_reads_a_device(words: str, tmp_path: Path) -> None:
    for name in ("pipe.toml", "pipe.csv", "pipe.json", "pipe.py", "excused/DECIMAL"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        os.mkfifo(tmp_path / name)
    (tmp_path / "excused" / "euler.toml").write_text('name = "e"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n')
    done = subprocess.run(
        [sys.executable, "-m", "orderconds", *words.replace("FOLDER", str(tmp_path)).split()],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 2
    assert "not a regular file" in done.stderr
    assert all("not a regular file" in line for line in done.stderr.splitlines())


def test_a_list_of_excuses_that_is_no_text_is_bad_input(tmp_path: Path) -> None:
    (tmp_path / "euler.toml").write_text('name = "e"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n')
    (tmp_path / "DECIMAL").write_bytes(b"\xff: why\n")
    result = CliRunner().invoke(program, ["check", str(tmp_path)])
    assert (result.exit_code, result.stdout) == (2, "")
    assert "DECIMAL: bytes that are not UTF-8" in result.stderr
