"""The metadata of the package, the citation and the changelog agree."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import yaml
from trove_classifiers import classifiers

import orderconds

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
CHANGES = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
KINDS = ("Added", "Changed", "Faster", "Fixed", "Removed")


def test_package_module_citation_and_changelog_have_one_version() -> None:
    newest = re.search(r"^## (\S+)", CHANGES, re.M)
    assert newest is not None
    assert PROJECT["version"] == orderconds.__version__ == CITATION["version"] == newest[1]


def test_the_address_of_the_project_is_one() -> None:
    assert list(PROJECT["urls"].values()) == [CITATION["url"]]


def test_the_citation_has_the_required_keys_and_the_name_of_the_package() -> None:
    assert {"cff-version", "message", "title", "authors"} <= CITATION.keys()
    assert (CITATION["title"], CITATION["license"]) == (PROJECT["name"], PROJECT["license"])


def test_every_classifier_is_known() -> None:
    assert set(PROJECT["classifiers"]) <= classifiers


def test_the_changelog_is_grouped_by_kind() -> None:
    kinds = re.findall(r"^### (.*)$", CHANGES, re.M)
    assert kinds
    assert set(kinds) <= set(KINDS)
