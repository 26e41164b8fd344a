"""The list of a target is complete: printer, templates, snippets, and a line in each of two tables."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import codegen
from codegen import loader
from codegen.artifact import Artifact
from codegen.emitter import emit
from codegen.loader import LOADERS, load
from codegen.printers import TARGETS, target
from codegen.snippets.graph import snippets
from orderconds.errors import InputError, UnknownName

ROOT = Path(codegen.__file__).parent


def test_every_target_that_is_printed_can_be_loaded() -> None:
    assert sorted(TARGETS) == sorted(LOADERS)


@pytest.mark.parametrize("name", sorted(TARGETS))
def test_every_target_has_its_folders(name: str) -> None:
    assert list((ROOT / "templates" / name).glob("module.*.j2"))
    assert (ROOT / "snippets" / name / "number.j2").is_file()


def test_every_snippet_is_in_some_target() -> None:
    files = {path.stem for name in TARGETS for path in (ROOT / "snippets" / name).glob("*.j2")}
    assert {snippet.template for snippet in snippets()} == files - {"number"}


def test_an_unknown_target_is_bad_input() -> None:
    with pytest.raises(UnknownName, match="fortran"):
        target("fortran")


@pytest.fixture(scope="module")
def python() -> Artifact:
    return emit("free_rigid_body", "cf4", "python")


def test_one_line_makes_a_target_loadable(python: Artifact, monkeypatch: pytest.MonkeyPatch) -> None:
    toy = replace(python, manifest={**python.manifest, "target": "toy"})
    with pytest.raises(InputError, match="unknown target toy"):
        load(toy)
    monkeypatch.setitem(loader.LOADERS, "toy", LOADERS["python"])
    state = list(python.manifest["initial"])
    assert load(toy).step(state, 0.01) == load(python).step(state, 0.01)
