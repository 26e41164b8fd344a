"""What README and docs show is what the program prints."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests import sessions
from tests.sessions import ROOT, SLOW, Session, parts, printed, without_times


def page(path: Path) -> object:
    """Return the parameter of one page; a slow page runs with the slow tests."""
    name = path.relative_to(ROOT).as_posix()
    slow = SLOW in path.read_text(encoding="utf-8")
    return pytest.param(path, id=name, marks=[pytest.mark.slow] if slow else [])


PAGES = [
    page(path)
    for path in sessions.pages()
    if any(isinstance(part, Session) for part in parts(path.read_text(encoding="utf-8")))
]


@pytest.mark.parametrize("path", PAGES)
def test_each_session_of_a_page_prints_what_the_page_shows(path: Path, tmp_path: Path) -> None:
    folder = sessions.folder_of(path, tmp_path / "session")
    for session, output in printed(path.read_text(encoding="utf-8"), folder):
        assert without_times(output) == without_times(session.shown), session.command


def test_the_readme_and_the_tutorial_have_sessions() -> None:
    ids = {parameter.id for parameter in PAGES}  # type: ignore[attr-defined]
    assert {"README.md", "docs/tutorial.md"} <= ids


def test_a_block_is_split_into_commands_with_their_outputs() -> None:
    text = "<!-- file: a.txt -->\n```text\none\n```\n\n```console\n$ cat \\\n  a.txt\none\n\n$ true\n```\n"
    assert [p if isinstance(p, tuple) else (p.command, p.shown) for p in parts(text)] == [
        ("a.txt", "one\n"),
        ("cat \\\n  a.txt", "one\n\n"),
        ("true", ""),
    ]


def test_an_output_that_differs_is_replaced_and_a_time_is_not() -> None:
    text = "```console\n$ echo 'two, 3 ms'\n{}\n```\n"
    assert sessions.renewed(text.format("one")) == text.format("two, 3 ms")
    assert sessions.renewed(text.format("two, 44.5 ms")) == text.format("two, 44.5 ms")
