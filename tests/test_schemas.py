"""The JSON of every command has the schema of docs/schemas, and the schemas describe all of it."""

from __future__ import annotations

import copy
import json
from functools import cache
from pathlib import Path
from typing import Any

import click
import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator
from referencing import Registry, Resource

from orderconds.cli import program

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "docs/schemas/v1"
NAMES = sorted(path.name.removesuffix(".schema.json") for path in FOLDER.glob("*.schema.json"))
NOT_COMMANDS = {"error", "manifest"}

QUICK = [
    ("derive", "rk --order 4"),
    ("derive", "rk --order 4 --all"),
    ("derive", "sprk --order 2 --explain"),
    ("check", "cg3 gauss2"),
    ("check", "rk4 --family vcg --order 4"),
    ("check", "cg4a --family cg"),
    ("check", "heun.csv floats.json"),
    ("refine", "floats.json"),
    ("construct", "gauss --stages 2"),
    ("extend", "ralston3"),
    ("convert", "rk4 --to csv"),
    ("trees", "rooted --order 4 --count"),
    ("trees", "directed --order 3 --explain"),
    ("trees", "rooted --order 3 --draw"),
    ("modified", "midpoint --order 4"),
    ("modified", "cf4 --order 5"),
    ("series", "bch --order 3"),
    ("cite", "cg3"),
    ("completion", "bash"),
    ("refine", "yoshida6.toml"),
    ("error", "convert missing.toml"),
    ("error", "derive rk"),
]
SLOW = [
    ("check", "yoshida6"),
    ("emit", "spin_lattice --method splitting:strang --explain"),
    ("solve", "rk --stages 2 --order 2 --explicit"),
    ("solve", "rk --stages 1 --order 2 --explicit"),
    ("solve", "vcg --stages 2 --order 3"),
    ("table", ""),
    ("list", ""),
    ("emit", "free_rigid_body --method cf:cf4 --explain"),
    ("emit", "dipole --method vcg:midpoint --parameter beta --jacobian -o out"),
    ("emit", "actuated_rigid_body --method cf:cf43 --adaptive -o out"),
    ("emit", "free_rigid_body --method rkmk(2):rk4 --dense --events 2 -o out"),
    ("converge", "dipole --method vcg:midpoint --steps 10,20,40"),
    ("converge", "--protocol strict --method cf4"),
    ("localerror", "free_rigid_body --method cf:cf4"),
    ("localerror", "dipole --method cf:cf4"),
    ("bench", "free_rigid_body --method cf:cf4 --adaptive ambient:dop853 --against c --budget 0.001"),
    ("longrun", "dipole --method vcg:midpoint --steps 400"),
    ("figure", "duffing frozen -o frozen.svg"),
    ("stability", "driven_spin --method cf:cf4 --quick"),
    ("recommend", "free_rigid_body --error 1e-4 --tableau cf4 --budget 5"),
    ("recommend", "free_rigid_body --error 1e-30 --tableau cf4 --budget 5"),
    ("report", "free_rigid_body --method cf:cf4 --quick -o report"),
    ("regenerate", "--check"),
]


def closed(schema: Any) -> Any:
    """Return a schema in which an object has no other properties than those that it describes.

    The published schemas permit other properties, because a version may add some.
    """
    if isinstance(schema, list):
        return [closed(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    schema = {key: closed(value) for key, value in schema.items()}
    if "type" in schema and isinstance(schema.get("properties"), dict):
        schema.setdefault("additionalProperties", False)
    return schema


@cache
def schemas() -> dict[str, Any]:
    """Return all schemas, as published."""
    return {name: json.loads((FOLDER / f"{name}.schema.json").read_text(encoding="utf-8")) for name in NAMES}


@cache
def validator(name: str) -> Draft202012Validator:
    """Return the validator of one schema that permits described properties only."""
    resources = {schema["$id"]: Resource.from_contents(closed(schema)) for schema in schemas().values()}
    registry: Any = Registry().with_resources(resources.items())
    return Draft202012Validator(closed(schemas()[name]), registry=registry)


def problems(name: str, document: Any) -> list[str]:
    """Return the places at which a document differs from its schema."""
    return [f"{error.json_path}: {error.message[:200]}" for error in validator(name).iter_errors(document)]


def printed(command: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return the JSON that a command prints in a folder."""
    monkeypatch.chdir(folder)
    source = ROOT / "tableaux/composition/yoshida6.toml"
    (folder / "yoshida6.toml").write_bytes(source.read_bytes())
    (folder / "heun.csv").write_text("0,0,0\n1,1,0\n,1/2,1/2\n", encoding="utf-8")
    floats = '{"A": [[0, 0], [0.6666666666666666, 0]], "b": [0.25, 0.75], "order": 2}'
    (folder / "floats.json").write_text(floats, encoding="utf-8")
    return json.loads(CliRunner().invoke(program, [*command.split(), "--json"]).stdout)


@pytest.mark.parametrize(
    ("name", "arguments"), [*QUICK, *(pytest.param(*case, marks=pytest.mark.slow) for case in SLOW)]
)
def test_the_output_of_a_command_has_its_schema(
    name: str, arguments: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command = arguments if name == "error" else f"{name} {arguments}"
    assert problems(name, printed(command, tmp_path, monkeypatch)) == []


def test_the_manifest_of_emitted_code_has_its_schema() -> None:
    files = sorted((ROOT / "generated").glob("*/manifest.json"))
    assert files
    for file in files:
        assert problems("manifest", json.loads(file.read_text(encoding="utf-8"))) == []


def test_every_command_with_json_has_a_schema_and_a_case() -> None:
    context = click.Context(program)
    commands = {
        name
        for name in program.list_commands(context)
        if (command := program.get_command(context, name)) is not None
        and any(option.name == "as_json" for option in command.params)
    }
    assert set(NAMES) - NOT_COMMANDS == commands
    assert {name for name, _ in [*QUICK, *SLOW]} - NOT_COMMANDS == commands


@pytest.mark.parametrize("name", NAMES)
def test_each_schema_is_a_schema_with_the_name_of_its_file(name: str) -> None:
    Draft202012Validator.check_schema(schemas()[name])
    assert schemas()[name]["$id"] == f"urn:orderconds:v1:{name}"
    assert f"](../schemas/v1/{name}.schema.json)" in (ROOT / "docs/reference/json.md").read_text("utf-8")


def test_a_changed_document_is_refused() -> None:
    result = CliRunner().invoke(program, ["check", "kutta3", "--family", "cg", "--json"])
    good = json.loads(result.stdout)
    assert problems("check", good) == []
    for change in (
        lambda record: record.pop("verdict"),
        lambda record: record.update(verdict="perhaps"),
        lambda record: record["orders"]["cg"].update(order="2"),
        lambda record: record["orders"]["cg"]["failing"][0].pop("residual"),
        lambda record: record.update(more=1),
    ):
        bad = copy.deepcopy(good)
        change(bad[0])
        assert problems("check", bad) != []
