"""The folder that emissions are written to."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from codegen.artifact import MANIFEST, Artifact, digest, read
from codegen.folder_lock import locked
from codegen.loader import load
from orderconds.errors import InputError
from orderconds.output_file import SUFFIX

ROOT = Path(__file__).parents[2]


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
    with pytest.raises(InputError, match=r"rigid\.py was changed after it was emitted"):
        load(tmp_path)
    (tmp_path / "rigid.py").unlink()
    with pytest.raises(InputError, match=r"rigid\.py is missing"):
        load(tmp_path)


def test_a_choice_among_several_must_be_made(kernels, tmp_path):
    kernels.emission(kernels.rigid(), "python").write(tmp_path)
    kernels.emission(kernels.rigid(), "c").write(tmp_path)
    with pytest.raises(
        InputError, match=r"2 modules match the name rigid.*one of rigid \(c\), rigid \(python\)"
    ):
        read(tmp_path, "rigid")
    with pytest.raises(InputError, match="0 modules match the name nobody"):
        read(tmp_path, "nobody")


def test_what_is_no_manifest_is_said_to_be_none(kernels, tmp_path):
    (tmp_path / MANIFEST).write_text("[1, 2]")
    with pytest.raises(InputError, match="this file is not a manifest"):
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
    with pytest.raises(InputError, match="cannot write to this path"):
        kernels.emission(kernels.rigid(), "c").write(tmp_path / "file" / "folder")


def test_a_disk_that_is_full_after_the_header_leaves_no_header(kernels, tmp_path, monkeypatch):
    synced = []

    def full(handle):
        synced.append(handle)
        if len(synced) > 1:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr("orderconds.output_file.os.fsync", full)
    with pytest.raises(InputError, match="cannot write to this path: no space left on device"):
        kernels.emission(kernels.rigid(), "c").write(tmp_path)
    assert len(synced) == 2
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_write_leaves_the_folder_as_it_was(kernels, tmp_path, monkeypatch):
    kernels.emission(kernels.rigid(), "c").write(tmp_path)
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("orderconds.output_file.os.replace", full)
    with pytest.raises(InputError, match="cannot write to this path: no space left on device"):
        kernels.emission(kernels.rigid(), "c", "other_").write(tmp_path)
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before


def module(name: str, text: str = "first", **entry: str) -> Artifact:
    """A module of two files."""
    files = {f"{name}.{suffix}": f"{text} {suffix}" for suffix in ("c", "h")}
    digests = {name: digest(content) for name, content in files.items()}
    return Artifact(files, {"module": name, "target": "c", "files": digests, "command": "emit it", **entry})


def test_processes_that_write_to_one_folder_at_the_same_time_lose_no_module(tmp_path):
    program = (
        "import sys\nfrom codegen.artifact import Artifact\n"
        "name = sys.argv[1]\nprint('ready', flush=True)\nsys.stdin.read()\n"
        "for k in range(20):\n"
        "    entry = {'module': f'{name}{k}', 'target': 'c', 'files': {}}\n"
        "    Artifact({f'{name}{k}.c': name}, entry).write(sys.argv[2])\n"
    )
    writers = [
        subprocess.Popen(
            [sys.executable, "-c", program, name, str(tmp_path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for name in "ab"
    ]
    for writer in writers:
        assert writer.stdout.readline() == "ready\n"
    for writer in writers:
        writer.stdin.close()
    for writer in writers:
        assert writer.wait() == 0
        writer.stdout.close()
    entries = json.loads((tmp_path / MANIFEST).read_text())["modules"]
    assert {e["module"] for e in entries} == {f"{name}{k}" for name in "ab" for k in range(20)}
    assert len(list(tmp_path.iterdir())) == 41  # no lock file


@pytest.mark.skipif(os.name != "posix", reason="sends SIGKILL")
@pytest.mark.parametrize("renames", range(4))
def test_a_write_that_is_killed_is_detected_and_repaired_by_the_next(tmp_path, renames):
    module("rigid").write(tmp_path)
    program = (
        "import os, signal\nfrom tests.codegen.test_artifact import module\n"
        "replace, done = os.replace, []\n"
        "def kill(*words):\n"
        f"    if len(done) == {renames}:\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
        "    done.append(replace(*words))\n"
        "os.replace = kill\n"
        f"module('rigid', 'second').write({str(tmp_path)!r})\n"
    )
    killed = subprocess.run(
        [sys.executable, "-c", program], env={**os.environ, "PYTHONPATH": str(ROOT)}, check=False
    )
    assert killed.returncode == (-signal.SIGKILL if renames < 3 else 0)
    if renames in (1, 2):
        with pytest.raises(
            InputError, match=r"was changed after it was emitted.*emit the module again: emit it"
        ):
            read(tmp_path)
    else:
        assert read(tmp_path).files["rigid.c"] == ("first c" if renames == 0 else "second c")
    assert any(path.name.endswith(SUFFIX) for path in tmp_path.iterdir()) == (renames < 3)
    module("rigid", "second").write(tmp_path)
    assert read(tmp_path).files["rigid.c"] == "second c"
    assert sorted(path.name for path in tmp_path.iterdir()) == [MANIFEST, "rigid.c", "rigid.h"]


def test_a_reader_waits_for_the_writer(tmp_path):
    module("rigid").write(tmp_path)
    with locked(tmp_path, shared=True) as first, locked(tmp_path, shared=True, wait=False) as second:
        assert (first, second) == (True, True)
        assert read(tmp_path).files["rigid.c"] == "first c"
    found = []
    reader = threading.Thread(target=lambda: found.append(read(tmp_path)))
    with locked(tmp_path):
        reader.start()
        reader.join(0.5)
        assert reader.is_alive()
    reader.join()
    assert found[0].files["rigid.c"] == "first c"


def test_methods_whose_names_differ_in_signs_do_not_overwrite_each_other(tmp_path):
    dot, dash = (module("top_rk_a_b", name, scene="top", method=f"rk:{name}") for name in ("a.b", "a-b"))
    dot.write(tmp_path)
    with pytest.raises(
        InputError, match=r"method rk:a\.b and the scene top, but .* method rk:a-b .*--prefix NAME"
    ):
        dash.write(tmp_path)
    dot.write(tmp_path)
    chosen = {"scene": "top", "command": "orderconds emit top --prefix mine_ -o ."}
    for name in ("a.b", "a-b"):
        module("mine", name, method=name, **chosen).write(tmp_path)
    assert read(tmp_path, "mine").files["mine.c"] == "a-b c"


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        '{"modules": [{"module": 1, "target": "c", "files": {}}]}',
        '{"modules": [{"module": "a", "target": "c", "files": {"a.c": []}}]}',
        '{"modules": [{"module": "a", "target": "c", "files": {"../a.c": "0"}}]}',
        '{"modules": [{"module": "a", "target": "c", "files": null}]}',
        '{"modules": 3}',
        "\xff",
    ],
)
def test_a_manifest_of_other_types_is_said_to_be_none(tmp_path, text):
    (tmp_path / MANIFEST).write_bytes(text.encode("latin-1"))
    with pytest.raises(InputError, match="this file is not a manifest"):
        read(tmp_path)


@pytest.mark.parametrize("change", [{"interface": {"size": 3}}, {"interface": []}, {"defaults": 1}, {}])
def test_an_entry_without_an_interface_is_bad_input(tmp_path, change):
    module("rigid", **change).write(tmp_path)
    with pytest.raises(InputError, match="the entry for rigid in the manifest is not valid"):
        load(tmp_path)
