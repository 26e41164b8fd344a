"""A remembered reference is the computed one, to every digit that it states, and never another scene's."""

from __future__ import annotations

from pathlib import Path

import pytest

from codegen import scenes
from codegen.cache_entry import cache_directory
from codegen.lab.reference import reference
from codegen.lab.remembered import remembered


def test_what_is_remembered_is_what_was_computed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    scene = scenes.load("free_rigid_body")
    exact, first, second = reference(scene), remembered(scene), remembered(scene)
    assert first == second
    assert first.digits(45) == exact.digits(45)
    assert first.uncertainty == exact.uncertainty


def test_another_parameter_is_another_reference(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    scene = scenes.load("driven_spin")
    remembered(scene)
    (kept,) = (cache_directory() / "references").iterdir()
    kept.write_text("not json")
    assert remembered(scene).digits() == reference(scene).digits()
    assert len(list((cache_directory() / "references").iterdir())) == 1
    remembered(scenes.load("linear_oscillator"))
    assert len(list((cache_directory() / "references").iterdir())) == 2
