"""Building: which compiler, what is cached, and that nothing half built stays."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import time

import pytest

from codegen import build as build_module
from codegen import cache_entry as cache
from codegen.build import CompileError, CompilerMissing, build, find_compiler
from codegen.cache_entry import cache_directory
from codegen.folder_lock import locked
from codegen.loader import load
from codegen.printers.c.module import FLAGS
from orderconds.errors import InputError

SOURCE = {"answer.c": "int answer(void);\nint answer(void)\n{\n    return 42;\n}\n"}


def test_no_compiler_is_one_message(monkeypatch, tmp_path):
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(CompilerMissing, match="PATH: no C compiler; expected cc, gcc or clang"):
        build(SOURCE)


def test_a_named_compiler_that_is_not_there_is_not_replaced_by_another(monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler -O3")
    with pytest.raises(CompilerMissing, match=r"\$CC: the compiler no-such-compiler does not exist"):
        find_compiler()


def test_a_named_compiler_may_carry_arguments(monkeypatch):
    monkeypatch.setenv("CC", "cc -DANSWER=7")
    assert find_compiler().command == ("cc", "-DANSWER=7")
    text = SOURCE["answer.c"].replace("42", "ANSWER")
    assert build({"answer.c": text}).exists()


def test_the_second_build_is_the_first(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    first = build(SOURCE)
    stamp = first.stat().st_mtime_ns
    assert build(SOURCE) == first
    assert first.stat().st_mtime_ns == stamp
    assert build(SOURCE, (*FLAGS, "-O1")) != first


def test_a_refused_source_shows_the_compilers_words_and_leaves_nothing(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    with pytest.raises(CompileError, match=r"(?s)broken\.c.*nonsense"):
        build({"broken.c": "nonsense\n"})
    assert list(cache_directory().iterdir()) == []


def test_a_warning_is_an_error():
    with pytest.raises(CompileError, match="unused"):
        build({"careless.c": "int f(void);\nint f(void)\n{\n    int unused = 1;\n    return 0;\n}\n"})


@pytest.mark.parametrize("error", [errno.EACCES, errno.EROFS])
def test_a_cache_that_cannot_be_written_to_is_replaced_by_a_temporary_folder(
    monkeypatch, tmp_path, caplog, error
):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    made = cache.tempfile.mkdtemp

    def refuse(*words, dir=None, **options):
        if dir is not None:
            raise OSError(error, os.strerror(error))
        return made(*words, **options)

    monkeypatch.setattr(cache.tempfile, "mkdtemp", refuse)
    monkeypatch.setattr(build_module, "working_directory", lambda folder: refuse(dir=folder))
    with pytest.raises(InputError, match="set XDG_CACHE_HOME to another folder"):
        build(SOURCE)  # the temporary folder as well
    monkeypatch.undo()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    inside = cache.working_directory

    def read_only(folder):
        if folder.is_relative_to(tmp_path):
            raise OSError(error, os.strerror(error))
        return inside(folder)

    monkeypatch.setattr(build_module, "working_directory", read_only)
    first, second = build(SOURCE), build(SOURCE)
    assert first == second
    assert first.exists()
    assert not first.is_relative_to(tmp_path)
    assert caplog.text.count("the cache cannot be used") == 1
    assert "set XDG_CACHE_HOME to a folder that you own" in caplog.text


def test_a_full_disk_is_bad_input_and_leaves_nothing(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("orderconds.output_file.os.fsync", full)
    with pytest.raises(InputError, match="cannot write to this path: no space left on device; free some"):
        build(SOURCE)
    assert list(cache_directory().iterdir()) == []
    monkeypatch.undo()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert build(SOURCE).exists()


def truncate(path):
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def change_a_bit(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(bytes(content))


def replace_by_text(path):
    path.write_text("no library")


def lose_the_digest(path):
    path.with_name(path.name + ".sha256").unlink()


def link_elsewhere(path):
    path.rename(path.with_name("elsewhere"))
    path.symlink_to("elsewhere")


def replace_by_a_folder(path):
    path.unlink()
    (path / "within").mkdir(parents=True)


def replace_the_digest_by_a_folder(path):
    replace_by_a_folder(path.with_name(path.name + ".sha256"))


RUINS = [truncate, change_a_bit, replace_by_text, lose_the_digest, link_elsewhere, replace_by_a_folder]


@pytest.mark.parametrize("ruin", [*RUINS, replace_the_digest_by_a_folder])
def test_a_bad_entry_is_built_again(monkeypatch, tmp_path, ruin):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    path = build(SOURCE)
    good = path.read_bytes()
    ruin(path)
    assert cache.recall(path) is None
    assert build(SOURCE) == path
    assert cache.recall(path) == good
    assert not path.is_symlink()


def test_a_library_without_the_symbols_is_built_again_even_with_its_digest(monkeypatch, tmp_path, kernels):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    emission = kernels.emission(kernels.pendulum(), "c")
    path, other = build(emission.files), build(SOURCE)
    cache.keep(path, other.read_bytes())
    python = load(kernels.emission(kernels.pendulum(), "python"))
    assert load(emission).run([0.5, 0.25], 0.1, 5) == python.run([0.5, 0.25], 0.1, 5)
    cache.keep(path, b"no library")
    assert load(emission).run([0.5, 0.25], 0.1, 5) == python.run([0.5, 0.25], 0.1, 5)


def test_the_folder_is_the_users_alone(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert build(SOURCE).parent.stat().st_mode & 0o777 == 0o700
    cache_directory().chmod(0o777)
    assert cache_directory().stat().st_mode & 0o777 == 0o700


def test_the_folder_of_another_user_is_not_used_and_one_warning_says_so(monkeypatch, tmp_path, caplog):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    foreign = build(SOURCE)
    user = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: user + 1)
    found = cache_directory(), cache_directory()
    assert found[0] == found[1] != foreign.parent
    assert caplog.text.count("the folder belongs to another user") == 1
    assert cache.recall(foreign) is None


def test_without_a_home_folder_a_temporary_one_serves(monkeypatch, caplog):
    def nowhere():
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(cache.Path, "home", nowhere)
    assert build(SOURCE).exists()
    assert "there is no home folder" in caplog.text


def test_what_a_killed_build_leaves_is_removed_by_a_later_one(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    program = (
        "import os, signal, sys\nfrom codegen import build\n"
        "build.keep = lambda *_: os.kill(os.getpid(), signal.SIGKILL)\n"
        f"build.build({SOURCE!r})\n"
    )
    done = subprocess.run([sys.executable, "-c", program], check=False)
    assert done.returncode == -signal.SIGKILL
    (left,) = cache_directory().iterdir()
    assert left.name.startswith(cache.WORKING)
    build({"other.c": SOURCE["answer.c"]})
    assert left.exists()  # its process might be alive and about to take the lock
    os.utime(left, (0, 0))
    with locked(left):
        path = build(SOURCE)
        assert left.exists()
    path.unlink()
    build(SOURCE)
    assert not left.exists()


def test_two_processes_that_build_the_same_thing_both_have_it(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    program = (
        "import ctypes, sys\nfrom codegen.build import build\nsys.stdin.read()\n"
        f"print(ctypes.CDLL(str(build({SOURCE!r}))).answer())\n"
    )
    both = [
        subprocess.Popen(
            [sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        for _ in range(2)
    ]
    for child in both:
        child.stdin.close()
    for child in both:
        assert child.stdout.read() == "42\n"
        assert child.wait() == 0
        child.stdout.close()
    assert len(list(cache_directory().iterdir())) == 2  # the library and its digest


def test_a_compiler_that_cannot_be_read_is_bad_input(monkeypatch):
    monkeypatch.setenv("CC", 'cc "')
    with pytest.raises(CompilerMissing, match=r"\$CC: 'cc \"' is not a command: no closing quotation"):
        find_compiler()


def test_a_compiler_that_says_it_succeeded_and_wrote_nothing_is_told(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("CC", "true")
    with pytest.raises(CompileError, match=r"answer\.c: true wrote no output"):
        build(SOURCE)
    assert list(cache_directory().iterdir()) == []


def test_an_interrupted_build_ends_every_process_of_the_compiler(monkeypatch, tmp_path):
    compiler = tmp_path / "cc"
    compiler.write_text(
        '#!/bin/sh\ncase "$1" in --version) echo cc 1;; *) sleep 300 & echo $! > "$MARK"; wait;; esac\n'
    )
    compiler.chmod(0o755)
    mark = tmp_path / "mark"
    monkeypatch.setenv("CC", str(compiler))
    monkeypatch.setenv("MARK", str(mark))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    # A shell lets its background processes ignore the signal, and children inherit this.
    restore = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    program = f"{restore}from codegen.build import build\nbuild({SOURCE!r})\n"
    with subprocess.Popen([sys.executable, "-c", program], stderr=subprocess.DEVNULL) as process:
        while not mark.exists() or not mark.read_text().strip():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        process.wait()
    child = int(mark.read_text())
    deadline = time.monotonic() + 10
    while _is_running(child) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not _is_running(child)


def _is_running(process: int) -> bool:
    """Return True if a process exists and is not a zombie."""
    shown = subprocess.run(
        ["ps", "-o", "stat=", "-p", str(process)], capture_output=True, text=True, check=False
    )
    return bool(shown.stdout.strip()) and not shown.stdout.strip().startswith("Z")
