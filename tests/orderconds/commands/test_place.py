"""An empty name of a place to write to is bad usage, in every command that writes."""

from __future__ import annotations

import json
import os
import threading
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds.cli import program
from orderconds.commands.place import put
from orderconds.errors import InputError


@pytest.mark.parametrize(
    "arguments",
    [["convert", "rk4"], ["construct", "gauss", "--stages", "2"], ["refine", "cg4a"]],
    ids=lambda x: x[0],
)
@pytest.mark.parametrize("place", ["", "  "])
def test_an_empty_place_is_bad_usage(arguments: list[str], place: str) -> None:
    result = CliRunner().invoke(program, [*arguments, "-o", place])
    assert result.exit_code == 2
    assert "is not the name of a file" in result.output


def test_a_file_is_replaced_whole_its_permissions_and_links_kept(tmp_path: Path) -> None:
    target, link = tmp_path / "x.toml", tmp_path / "link.toml"
    target.write_bytes(b"before")
    target.chmod(0o640)
    link.symlink_to(target)
    put(str(link), b"after")
    assert (target.read_bytes(), target.stat().st_mode & 0o777, link.is_symlink()) == (b"after", 0o640, True)
    assert sorted(os.listdir(tmp_path)) == ["link.toml", "x.toml"]


def test_what_cannot_be_written_leaves_nothing_behind(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none" / "x"):
        with pytest.raises(InputError, match="a file that can be written"):
            put(str(path), b"")
    assert os.listdir(tmp_path) == []


def test_a_device_is_written_to() -> None:
    put(os.devnull, b"gone")
    assert Path(os.devnull).is_char_device()


def test_a_full_disk_leaves_the_file_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    (tmp_path / "x").write_bytes(b"before")
    monkeypatch.setattr("orderconds.output_file.os.fsync", full)
    with pytest.raises(InputError, match="no space left on device; expected a file that can be written"):
        put(str(tmp_path / "x"), b"after")
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"x": b"before"}


@pytest.mark.skipif(os.name != "posix", reason="pipes of POSIX")
def test_a_pipe_without_a_reader_is_refused_and_one_with_a_slow_reader_gets_everything(
    tmp_path: Path,
) -> None:
    pipe, content = tmp_path / "pipe", b"text" * 50_000  # more than a pipe holds
    os.mkfifo(pipe)
    with pytest.raises(InputError, match="pipe: no process reads this pipe; expected a file"):
        put(str(pipe), b"")
    found: list[bytes] = []
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    os.set_blocking(reader, True)

    def read() -> None:
        with os.fdopen(reader, "rb") as stream:
            found.append(stream.read())

    slow = threading.Timer(0.1, read)
    slow.start()
    put(str(pipe), content)
    slow.join()
    assert found == [content]


@pytest.mark.skipif(os.name != "posix", reason="links of POSIX")
def test_a_link_to_itself_is_bad_input(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to("loop")
    with pytest.raises(InputError, match="loop: too many levels of symbolic links; expected a file"):
        put(str(loop), b"")


def test_an_option_is_not_taken_for_the_name_of_a_file() -> None:
    result = CliRunner().invoke(program, ["convert", "rk4", "--output", "--json"])
    assert result.exit_code == 2
    assert "the name of a file is missing before --json" in result.stderr
    assert json.loads(result.stdout)["error"]["status"] == 2
