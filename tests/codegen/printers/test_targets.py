"""A target is complete: its entry in the registry, its printer, its templates and its snippets."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

import codegen
from codegen import printers
from codegen.artifact import Artifact
from codegen.commands.bench import command as bench
from codegen.commands.converge import command as converge
from codegen.emitter import compile_method, emit, emit_compiled
from codegen.lab.orders.order_study import order_study
from codegen.lab.reference import cached_reference
from codegen.loader import load
from codegen.printers import DEFAULT, Target, names, register, target, targets, unregister
from codegen.snippets.graph import snippets
from orderconds.errors import InputError, UnknownName

ROOT = Path(codegen.__file__).parent
METHOD = "cf:cf4"


@pytest.fixture
def toy() -> Iterator[Target]:
    """A target of another package: one public call registers it."""
    yield register(replace(target("python"), name="toy", title="Toy", about="a toy", most_steps=640))
    unregister("toy")


@pytest.mark.parametrize("entry", targets(), ids=names())
def test_every_target_prints_a_module_that_it_can_load(entry: Target) -> None:
    artifact = emit("free_rigid_body", METHOD, entry.name)
    assert entry.step_file(artifact.manifest["module"]) in artifact.files
    state = list(artifact.manifest["initial"])
    assert load(artifact).step(state, 0.01) != state


@pytest.mark.parametrize("name", names())
def test_every_target_has_its_folders(name: str) -> None:
    assert list((ROOT / "templates" / name).glob("module.*.j2"))
    assert (ROOT / "snippets" / name / "number.j2").is_file()


def test_every_snippet_is_in_some_target() -> None:
    files = {path.stem for name in names() for path in (ROOT / "snippets" / name).glob("*.j2")}
    # Each table of a scene has a snippet of its own.
    assert {snippet.template for batch in (False, True) for snippet in snippets(batch=batch)} | {
        "number",
        "table",
    } == files


def test_the_default_target_is_the_first_one() -> None:
    assert names()[0] == DEFAULT


def test_an_unknown_target_is_bad_input() -> None:
    with pytest.raises(UnknownName, match="fortran"):
        target("fortran")


def test_a_name_belongs_to_one_target(toy: Target) -> None:
    assert register(toy) is toy
    for name in ("toy", DEFAULT):
        with pytest.raises(InputError, match="already"):
            register(replace(toy, name=name, about="another"))


def test_a_registered_target_is_listed_until_it_is_removed(toy: Target) -> None:
    assert names()[-1] == "toy"
    assert {"name": "toy", "about": "a toy"} in printers.listing()
    unregister("toy")
    assert "toy" not in names()


def test_a_module_is_loaded_by_its_target(toy: Target) -> None:
    python: Artifact = emit("free_rigid_body", METHOD, "python")
    own = replace(python, manifest={**python.manifest, "target": toy.name})
    state = list(python.manifest["initial"])
    assert load(own).step(state, 0.01) == load(python).step(state, 0.01)
    unregister("toy")
    with pytest.raises(UnknownName, match="unknown target toy"):
        load(own)


def test_converge_measures_a_registered_target(toy: Target) -> None:
    arguments = ["free_rigid_body", "-m", METHOD, "--target", toy.name, "--json"]
    result = CliRunner().invoke(converge, arguments, standalone_mode=False)
    assert result.exception is None
    (found,) = json.loads(result.stdout)
    assert (found["target"], found["verdict"], found["stated_order"]) == (toy.name, "holds", 4)
    few = replace(toy, name="few", most_steps=20)
    register(few)
    result = CliRunner().invoke(converge, [*arguments, "--target", few.name], standalone_mode=False)
    unregister("few")
    (found,) = json.loads(result.stdout)
    assert (found["target"], max(found["steps"])) == (few.name, 20)


def test_bench_names_candidates_of_a_registered_target(toy: Target) -> None:
    arguments = ["free_rigid_body", "-m", METHOD, "-t", toy.name, "--budget", "0.001", "--json"]
    result = CliRunner().invoke(bench, arguments, standalone_mode=False)
    assert result.exception is None
    rows = json.loads(result.stdout)
    assert {row["target"] for row in rows} == {toy.name}
    assert all(row["compile_seconds"] == 0.0 for row in rows)


def test_the_order_study_of_the_report_covers_every_target(toy: Target) -> None:
    compiled = compile_method("free_rigid_body", METHOD)
    study = order_study(compiled, cached_reference(compiled.scene), str)
    data = study.as_json()
    assert toy.name in names()
    assert list(study.convergences) == list(names())
    assert all(isinstance(data[name], dict) for name in names())
    assert study.verdict == "holds"
    assert study.artifact.manifest["target"] == DEFAULT


def test_the_stack_is_stated_where_the_target_says() -> None:
    for entry in targets():
        artifact = emit_compiled(compile_method("free_rigid_body", METHOD), entry.name)
        text = artifact.files[entry.step_file(artifact.manifest["module"])]
        assert not entry.stack or re.search(entry.stack, text)
