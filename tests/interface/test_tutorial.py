"""The examples of the page on the interface in Python run and give the printed results."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "tutorial_python.md"


def examples() -> doctest.DocTest:
    text = PAGE.read_text(encoding="utf-8")
    return doctest.DocTestParser().get_doctest(text, {}, PAGE.name, str(PAGE), 0)


def test_the_page_has_fifteen_sections_with_examples() -> None:
    _, *sections = PAGE.read_text(encoding="utf-8").split("\n## ")
    assert [section.partition(".")[0] for section in sections] == [str(n) for n in range(1, 16)]
    assert all(">>> " in section for section in sections)


@pytest.mark.slow
def test_every_example_gives_the_printed_result() -> None:
    failures: list[str] = []
    runner = doctest.DocTestRunner()
    runner.run(examples(), out=failures.append)
    assert failures == []
    assert runner.tries > 40
