"""The folder that emissions are written to."""

from __future__ import annotations

import json
import os

import pytest

from codegen.artifact import MANIFEST, read
from codegen.loader import load
from orderconds.errors import InputError


def test_what_is_written_is_read_back(kernels, tmp_path):
    for name in ("rigid", "pendulum"):
        for target in ("c", "python"):
            kernels.emission(getattr(kernels, name)(), target).write(tmp_path / "made")
    emission = kernels.emission(kernels.pendulum(), "c")
    again = read(tmp_path / "made", "pendulum", "c")
    assert again.files == emission.files
    assert again.manifest == json.loads(json.dumps(emission.manifest))
    state = [0.5, 0.25]
    for target in ("c", "python"):
        there = load(tmp_path / "made", "pendulum", target).run(state, 0.1, 5)
        assert there == load(kernels.emission(kernels.pendulum(), target)).run(state, 0.1, 5)


def test_a_folder_holds_each_module_once_and_nothing_temporary(kernels, tmp_path):
    for _ in range(2):
        kernels.emission(kernels.rigid(), "c").write(tmp_path)
    assert sorted(p.name for p in tmp_path.iterdir()) == [MANIFEST, "rigid.c", "rigid.h"]
    assert len(json.loads((tmp_path / MANIFEST).read_text())["modules"]) == 1


def test_the_manifest_does_not_depend_on_the_order_of_writing(kernels, tmp_path):
    names = ["rigid", "pendulum", "powers"]
    for folder, order in (("a", names), ("b", names[::-1])):
        for name in order:
            kernels.emission(getattr(kernels, name)(), "c").write(tmp_path / folder)
    assert (tmp_path / "a" / MANIFEST).read_bytes() == (tmp_path / "b" / MANIFEST).read_bytes()


def test_a_file_changed_by_hand_is_refused(kernels, tmp_path):
    kernels.emission(kernels.rigid(), "python").write(tmp_path)
    (tmp_path / "rigid.py").write_text("import this\n")
    with pytest.raises(InputError, match=r"rigid\.py was changed since it was emitted"):
        load(tmp_path)
    (tmp_path / "rigid.py").unlink()
    with pytest.raises(InputError, match=r"rigid\.py is missing"):
        load(tmp_path)


def test_a_choice_among_several_must_be_made(kernels, tmp_path):
    kernels.emission(kernels.rigid(), "python").write(tmp_path)
    kernels.emission(kernels.rigid(), "c").write(tmp_path)
    with pytest.raises(InputError, match=r"2 modules answer to rigid.*one of rigid \(c\), rigid \(python\)"):
        read(tmp_path, "rigid")
    with pytest.raises(InputError, match="0 modules answer to nobody"):
        read(tmp_path, "nobody")


def test_what_is_no_manifest_is_said_to_be_none(kernels, tmp_path):
    (tmp_path / MANIFEST).write_text("[1, 2]")
    with pytest.raises(InputError, match="this is not a manifest"):
        kernels.emission(kernels.rigid(), "c").write(tmp_path)


def test_a_file_in_place_of_a_folder_or_a_folder_in_place_of_a_manifest_is_told(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "folder" / "manifest.json").mkdir(parents=True)
    with pytest.raises(InputError, match=r"file.manifest\.json: not a directory"):
        read(tmp_path / "file")
    with pytest.raises(InputError, match=r"folder.manifest\.json: is a directory"):
        read(tmp_path / "folder")


def test_a_folder_that_cannot_be_made_is_bad_input(kernels, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot write there"):
        kernels.emission(kernels.rigid(), "c").write(tmp_path / "file" / "folder")


def test_a_disk_that_is_full_after_the_header_leaves_no_header(kernels, tmp_path, monkeypatch):
    opened = []

    def full(handle, *words, **options):
        opened.append(handle)
        if len(opened) > 1:
            os.close(handle)
            raise OSError(28, "No space left on device")
        return fdopen(handle, *words, **options)

    fdopen = os.fdopen
    monkeypatch.setattr("codegen.artifact.os.fdopen", full)
    with pytest.raises(InputError, match="cannot write there: No space left on device"):
        kernels.emission(kernels.rigid(), "c").write(tmp_path)
    assert len(opened) == 2
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_write_leaves_the_folder_as_it_was(kernels, tmp_path, monkeypatch):
    kernels.emission(kernels.rigid(), "c").write(tmp_path)
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("codegen.artifact.os.replace", full)
    with pytest.raises(InputError, match="cannot write there: No space left on device"):
        kernels.emission(kernels.rigid(), "c", "other_").write(tmp_path)
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before
