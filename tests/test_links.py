"""Links between pages lead to a file and a heading, and every page of docs is in the menu of the site."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = (
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    ROOT / "CHANGELOG.md",
    ROOT / "benchmarks/README.md",
    *sorted((ROOT / "docs").rglob("*.md")),
    *sorted((ROOT / "examples").glob("*/README.md")),
)
LINK = re.compile(r"\]\((?P<path>[^)#\s]*)(?:#(?P<anchor>[^)\s]*))?\)")


def prose(page: Path) -> str:
    """Return the text of a page without fenced blocks and without code in a line."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", "", text)


@cache
def anchors(page: Path) -> frozenset[str]:
    """Return the anchors of the headings of a page."""
    headings = re.findall(
        r"^#{1,6} (.*)$",
        re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S),
        re.M,
    )
    return frozenset(
        re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings
    )


def broken(page: Path, text: str) -> Iterator[str]:
    """Yield the links of a text of ``page`` that lead to no file of the repository, or to no heading."""
    for link in LINK.finditer(text):
        path, anchor = link["path"], link["anchor"]
        if re.match(r"[a-z]+:", path):
            continue
        target = (page.parent / path).resolve() if path else page
        if not target.is_file() or not target.is_relative_to(ROOT):
            yield f"{path}: no such file"
        elif anchor is not None and anchor not in anchors(target):
            yield f"{path}#{anchor}: no such heading"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_link_of_a_page_leads_to_a_file_and_a_heading(page: Path) -> None:
    assert list(broken(page, prose(page))) == []


def test_a_broken_link_is_seen() -> None:
    text = (
        "[a](docs/nothing.md) [b](docs/index.md#nowhere) [c](docs/index.md#where-to-begin) [d](https://x.y)"
    )
    assert list(broken(ROOT / "README.md", text)) == [
        "docs/nothing.md: no such file",
        "docs/index.md#nowhere: no such heading",
    ]


def test_every_page_of_docs_is_in_the_menu() -> None:
    menu = set(re.findall(r"([\w/]+\.md)$", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"), re.M))
    pages = {page.relative_to(ROOT / "docs").as_posix() for page in (ROOT / "docs").rglob("*.md")}
    assert pages <= menu


def test_every_schema_and_picture_is_linked() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    files = [*(ROOT / "docs/schemas").rglob("*.json"), *(ROOT / "docs/pictures").glob("*.svg")]
    assert [file.name for file in files if f"/{file.name})" not in text] == []
