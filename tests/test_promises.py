"""The page of promises names tests that exist, and none of them is a test that nobody runs."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs/promises.md").read_text(encoding="utf-8")
NAMED = sorted(set(re.findall(r"`(test_\w+)`", PAGE)))


@cache
def defined() -> frozenset[str]:
    """Return the names of all test functions of the repository."""
    files = (ROOT / "tests").rglob("test_*.py")
    return frozenset(
        name
        for file in files
        for name in re.findall(r"^ *def (test_\w+)\(", file.read_text(encoding="utf-8"), re.MULTILINE)
    )


@pytest.mark.parametrize("name", NAMED)
def test_every_test_that_the_page_names_exists(name: str) -> None:
    assert name in defined()


def test_every_promise_names_a_test() -> None:
    promises = re.split(r"^- ", PAGE, flags=re.MULTILINE)[1:]
    assert len(promises) > 15
    for promise in promises:
        assert re.search(r"`test_\w+`", promise), promise


def test_the_readme_links_to_the_page() -> None:
    assert "](docs/promises.md)" in (ROOT / "README.md").read_text(encoding="utf-8")
