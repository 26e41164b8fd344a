"""Files are written completely or not at all, whenever an exception arrives."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from orderconds.output_file import is_temporary, write_files


class Interrupted(BaseException):
    """Stands for the exception of a signal."""


def interrupt_after(call: Callable[..., object]) -> Callable[..., object]:
    def run(*arguments: object, **options: object) -> object:
        call(*arguments, **options)
        raise Interrupted

    return run


@pytest.mark.parametrize("name", ["open", "fsync", "chmod"])
def test_an_exception_right_after_a_system_call_leaves_no_temporary_file(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = tmp_path / "kept"
    kept.write_bytes(b"before")
    monkeypatch.setattr(os, name, interrupt_after(getattr(os, name)))
    with pytest.raises(Interrupted):
        write_files({kept: b"after", tmp_path / "new": b"text"})
    assert os.listdir(tmp_path) == ["kept"]
    assert kept.read_bytes() == b"before"


def test_temporary_names_are_recognised_and_files_are_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[str] = []
    replace = os.replace

    def record(source: Path, target: Path) -> None:
        seen.append(Path(source).name)
        replace(source, target)

    monkeypatch.setattr(os, "replace", record)
    write_files({tmp_path / ("x" * 200): b"1", tmp_path / "y": b"2"}, private=True)
    assert len(seen) == 2
    assert all(map(is_temporary, seen))
    assert (tmp_path / "y").read_bytes() == b"2"
    assert (tmp_path / "y").stat().st_mode & 0o777 == 0o600
