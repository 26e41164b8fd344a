"""The cache returns what was measured, only for the same key, and never a damaged or foreign entry."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from codegen import scenes
from codegen.lab import measurement_cache
from codegen.lab import reference as references
from codegen.lab.measurement_cache import MeasurementCache, files_digest, user_cache
from codegen.lab.reference import cached_reference, reference
from codegen.scene.run_time import with_runtime


@dataclass(frozen=True)
class Result:
    numbers: tuple[float, ...]
    note: str = ""


class Counted:
    """A measurement that counts its runs."""

    def __init__(self) -> None:
        self.runs = 0

    def __call__(self) -> Result:
        self.runs += 1
        return Result((1.0, float("inf"), self.runs), "measured")


@pytest.fixture
def cache(tmp_path: Path) -> MeasurementCache:
    return MeasurementCache(tmp_path / "entries")


def entries(cache: MeasurementCache) -> list[Path]:
    assert cache.folder is not None
    return sorted(cache.folder.iterdir())


def test_a_measurement_is_made_once_for_each_key(cache: MeasurementCache) -> None:
    measure = Counted()
    first = cache.get(("key", 1), Result, measure)
    assert cache.get(("key", 1), Result, measure) == first
    assert measure.runs == 1
    assert cache.get(("key", 2), Result, measure) != first
    assert measure.runs == 2
    assert len(entries(cache)) == 2


def test_a_new_cache_on_the_folder_finds_the_entries(cache: MeasurementCache) -> None:
    found = cache.get(("key",), Result, Counted())
    assert MeasurementCache(cache.folder).find(("key",), Result) == found


@pytest.mark.parametrize(
    "damage",
    [
        lambda content: content[:-1],
        lambda content: b"",
        lambda content: content[:-1] + bytes([content[-1] ^ 1]),
        lambda content: bytes(32) + content[32:],
        lambda content: b"not an entry of this cache",
    ],
    ids=["truncated", "empty", "one bit changed", "another digest", "foreign"],
)
def test_a_damaged_entry_is_measured_again(cache: MeasurementCache, damage) -> None:
    measure = Counted()
    cache.get(("key",), Result, measure)
    (path,) = entries(cache)
    path.write_bytes(damage(path.read_bytes()))
    assert cache.find(("key",), Result) is None
    assert cache.get(("key",), Result, measure).numbers[-1] == 2.0
    assert cache.get(("key",), Result, measure).numbers[-1] == 2.0


def replace_by_a_folder(path: Path) -> None:
    (path / "within").mkdir(parents=True)


def replace_by_a_link(path: Path) -> None:
    """A link to a device without end."""
    path.symlink_to("/dev/zero")


@pytest.mark.skipif(os.name != "posix", reason="pipes and devices of POSIX")
@pytest.mark.parametrize("replace", [replace_by_a_folder, replace_by_a_link, os.mkfifo])
def test_what_is_no_file_is_not_read_and_is_replaced(
    cache: MeasurementCache, replace: Callable[[Path], None]
) -> None:
    measure = Counted()
    cache.get(("key",), Result, measure)
    (path,) = entries(cache)
    path.unlink()
    replace(path)
    assert cache.get(("key",), Result, measure).numbers[-1] == 2.0
    assert cache.get(("key",), Result, measure).numbers[-1] == 2.0
    assert path.is_file()
    assert not path.is_symlink()


def test_an_entry_of_another_type_is_measured_again(cache: MeasurementCache) -> None:
    cache.store(("key",), "a text")
    assert cache.find(("key",), Result) is None
    assert cache.get(("key",), Result, Counted()).note == "measured"


def test_an_interrupted_write_leaves_no_entry(
    cache: MeasurementCache, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(source: str, target: Path) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", interrupted)
        with pytest.raises(KeyboardInterrupt):
            cache.store(("key",), Result((1.0,)))
    assert entries(cache) == []
    assert cache.find(("key",), Result) is None


def test_the_folder_belongs_to_the_user_alone(cache: MeasurementCache) -> None:
    cache.store(("key",), 1)
    assert cache.folder is not None
    assert stat.S_IMODE(cache.folder.stat().st_mode) == 0o700
    cache.folder.chmod(0o777)
    assert cache.find(("key",), int) == 1
    assert stat.S_IMODE(cache.folder.stat().st_mode) == 0o700


def test_a_folder_of_another_user_is_neither_read_nor_written_nor_removed(
    cache: MeasurementCache, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache.store(("key",), 1)
    monkeypatch.setattr(os, "getuid", lambda: os.stat("/").st_uid + 12345)
    assert cache.find(("key",), int) is None
    cache.store(("other",), 2)
    cache.remove()
    assert len(entries(cache)) == 1


def test_a_folder_that_cannot_be_written_to_costs_time_only(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    measure = Counted()
    for folder in (blocked, blocked / "inside", None):
        assert MeasurementCache(folder).get(("key",), Result, measure).note == "measured"
    assert measure.runs == 3
    link = tmp_path / "link"
    link.symlink_to(tmp_path)
    MeasurementCache(link).store(("key",), 1)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["file", "link"]


def test_an_exception_is_passed_on_and_nothing_is_stored(cache: MeasurementCache) -> None:
    def fail() -> int:
        raise ArithmeticError("no result")

    with pytest.raises(ArithmeticError, match="no result"):
        cache.get(("key",), int, fail)
    assert cache.get(("key",), int, lambda: 3) == 3


def test_remove_deletes_the_folder(cache: MeasurementCache) -> None:
    cache.store(("key",), 1)
    cache.remove()
    assert cache.folder is not None
    assert not cache.folder.exists()


def test_a_cached_reference_is_the_computed_one(cache: MeasurementCache) -> None:
    scene = scenes.load("free_rigid_body")
    exact, first, second = reference(scene), cached_reference(scene, cache), cached_reference(scene, cache)
    assert first == second
    assert first.digits(45) == exact.digits(45)
    assert first.uncertainty == exact.uncertainty
    assert len(entries(cache)) == 1


def test_references_of_other_parameters_and_programs_are_other_entries(
    cache: MeasurementCache, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = scenes.load("driven_spin")
    cached_reference(scene, cache)
    cached_reference(scenes.load("linear_oscillator"), cache)
    cached_reference(with_runtime(scenes.load("linear_oscillator"), ("omega=2",)), cache)
    assert len(entries(cache)) == 3
    monkeypatch.setattr(references, "_digest", lambda: "another program")
    cached_reference(scene, cache)
    assert len(entries(cache)) == 4


def test_the_user_s_cache_is_beside_the_compiled_modules(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert user_cache().folder == tmp_path / "orderconds" / "measurements"


def test_results_of_another_program_are_not_used(
    cache: MeasurementCache, monkeypatch: pytest.MonkeyPatch
) -> None:
    measure = Counted()
    cache.get(("key",), Result, measure)
    monkeypatch.setattr(measurement_cache, "program_digest", lambda: "another program")
    cache.get(("key",), Result, measure)
    assert measure.runs == 2


def test_the_digest_of_the_program_depends_on_each_file(tmp_path: Path) -> None:
    files = [tmp_path / name for name in ("a.py", "b.j2")]
    digests = set()
    for texts in [("x", "y"), ("xy", ""), ("x", "z"), ("y", "x")]:
        for path, text in zip(files, texts, strict=True):
            path.write_text(text)
        digests.add(files_digest(files))
    assert len(digests) == 4
