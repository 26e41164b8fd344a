"""Building: which compiler, what is cached, and that nothing half built stays."""

from __future__ import annotations

import pytest

from codegen.build import CompileError, CompilerMissing, build, cache_directory, find_compiler
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
    with pytest.raises(CompilerMissing, match=r"\$CC: no-such-compiler is not there"):
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


def test_a_cache_that_cannot_be_written_is_bad_input(monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    with pytest.raises(InputError, match=r"cannot write there.*set XDG_CACHE_HOME"):
        build(SOURCE)


def test_a_compiler_that_cannot_be_read_is_bad_input(monkeypatch):
    monkeypatch.setenv("CC", 'cc "')
    with pytest.raises(CompilerMissing, match=r"\$CC: cannot read 'cc \"': no closing quotation"):
        find_compiler()


def test_a_compiler_that_says_it_succeeded_and_wrote_nothing_is_told(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("CC", "true")
    with pytest.raises(CompileError, match=r"answer\.c: true wrote nothing"):
        build(SOURCE)
    assert list(cache_directory().iterdir()) == []
