"""``orderconds emit`` and ``orderconds regenerate`` as commands."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from codegen.commands.emit import command as emit
from codegen.commands.regenerate import command as regenerate
from codegen.loader import load
from orderconds.errors import InputError
from orderconds.output_file import SUFFIX

ROOT = Path(__file__).parents[3]


def run(command: click.Command, *arguments: str, status: int = 0) -> str:
    """Run a command; its status is what it returns, and its errors are the program's to print."""
    result = CliRunner().invoke(command, arguments, standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    assert result.return_value == status
    return result.stdout


def test_emit_writes_modules_that_load(tmp_path):
    told = run(emit, "free_rigid_body", "-m", "cf4", "-t", "c", "-t", "python", "-o", str(tmp_path / "a/b"))
    names = sorted(Path(line).name for line in set(told.split()))
    assert names == [
        "free_rigid_body_cf4.c",
        "free_rigid_body_cf4.h",
        "free_rigid_body_cf4.py",
        "manifest.json",
    ]
    start = [0.6, 0.0, 0.8]
    states = [load(tmp_path / "a/b", target=target).run(start, 0.1, 7) for target in ("c", "python")]
    assert states[0] == pytest.approx(states[1], abs=1e-15)


def test_the_command_in_the_header_makes_the_same_bytes(tmp_path):
    words = ["free_rigid_body", "--method", "rkmk(2):rk4", "--parameter", "alpha", "--prefix", "top"]
    run(emit, *words, "-o", str(tmp_path / "a"))
    entry = json.loads((tmp_path / "a/manifest.json").read_text())["modules"][0]
    assert entry["command"].startswith("orderconds emit free_rigid_body --method 'rkmk(2):rk4' --target c")
    import shlex

    again = shlex.split(entry["command"])[2:-1]
    run(emit, *again, str(tmp_path / "b"))
    for name in ("top.c", "top.h", "manifest.json"):
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()


def test_explain_tells_what_a_long_step_calls_and_how_often():
    told = run(emit, "dipole", "-m", "cg:cg4a", "--explain")
    assert "# outlined functions\n  piece_1, 5 calls: field(y1)\n" in told


def test_the_header_s_command_quotes_a_file_s_name_and_keeps_the_default_of_an_input(tmp_path, monkeypatch):
    import shlex

    path = tmp_path / "my scene's.py"
    path.write_text("from codegen.scenes.free_rigid_body import scene\n")
    words = [str(path), "--method", "cg:cg3", "--parameter", "alpha=1/3", "--parameter", "alpha"]
    run(emit, *words, "-o", str(tmp_path / "a"))
    entry = json.loads((tmp_path / "a/manifest.json").read_text())["modules"][0]
    assert entry["defaults"] == {"alpha": 1 / 3}
    monkeypatch.chdir(tmp_path)
    run(emit, *shlex.split(entry["command"])[2:-1], str(tmp_path / "b"))
    for made in (tmp_path / "a").iterdir():
        assert made.read_bytes() == (tmp_path / "b" / made.name).read_bytes()


def test_explain_tells_every_pass_and_writes_nothing():
    told = run(emit, "free_rigid_body", "-m", "cg:cg3", "--explain")
    for word in ("# lowered:", "# shared values: removed", "# left out", "no formula depends on the time"):
        assert word in told


def test_json_is_the_manifest_and_nothing_else(tmp_path):
    told = run(emit, "free_rigid_body", "-m", "cf4", "-o", str(tmp_path), "--json", "--explain")
    (record,) = json.loads(told)
    assert record["order"] == 4
    assert record["certificate"] == "exact"
    assert record["passes"][0]["name"] == "shared values"
    assert record["functions"] == []
    assert [Path(p).name for p in record["paths"]][-1] == "manifest.json"


def test_emit_needs_a_place_to_write():
    with pytest.raises(click.UsageError, match="-o DIR is missing"):
        run(emit, "free_rigid_body", "-m", "cf4")


def test_nothing_is_written_when_a_target_is_unknown(tmp_path):
    with pytest.raises(InputError, match="unknown target rust"):
        run(emit, "free_rigid_body", "-m", "cf4", "-t", "c", "-t", "rust", "-o", str(tmp_path / "made"))
    assert not (tmp_path / "made").exists()


LIST = """
[[module]]
scene = "free_rigid_body"
method = "cf4"
targets = ["c", "python"]
"""


@pytest.fixture
def made(tmp_path):
    (tmp_path / "list.toml").write_text(LIST)
    arguments = ("--list", str(tmp_path / "list.toml"), "-o", str(tmp_path / "made"))
    run(regenerate, *arguments)
    return tmp_path / "made", arguments


def test_regenerate_twice_changes_nothing(made):
    _, arguments = made
    assert run(regenerate, *arguments, "--check").startswith("0 differences, 4 files expected")
    assert run(regenerate, *arguments).startswith("0 of 4 files rewritten")


@pytest.mark.parametrize("kind", ["different", "missing", "stale"])
def test_regenerate_check_names_what_differs_and_regenerate_mends_it(made, kind):
    folder, arguments = made
    path = folder / "free_rigid_body" / "free_rigid_body_cf4.py"
    if kind == "missing":
        path.unlink()
    elif kind == "different":
        path.write_text(path.read_text() + " ")
    else:
        path = folder / "dipole" / "dipole_vcg_midpoint.py"
        run(emit, "dipole", "-m", "vcg:midpoint", "-t", "python", "-o", str(path.parent))
    told = run(regenerate, *arguments, "--check", status=1)
    assert f"{path}: {kind}" in told
    assert "files expected; type: orderconds regenerate" in told
    record = json.loads(run(regenerate, *arguments, "--check", "--json", status=1))
    assert {"file": path.relative_to(folder).as_posix(), "kind": kind} in record["differences"]
    run(regenerate, *arguments)
    assert path.exists() == (kind != "stale")
    assert run(regenerate, *arguments, "--check").startswith("0 differences")


def test_regenerate_never_removes_what_was_not_emitted(made):
    folder, arguments = made
    letter = folder / "free_rigid_body" / "letter.txt"
    letter.write_text("mine")
    assert f"{letter}: unknown" in run(regenerate, *arguments)
    assert letter.read_text() == "mine"
    assert f"{letter}: unknown" in run(regenerate, *arguments, "--check", status=1)


def test_what_a_killed_write_leaves_is_no_difference_and_the_next_write_removes_it(made):
    folder, arguments = made
    left = folder / "free_rigid_body" / f".free_rigid_body_cf4.c.k3_x91ab{SUFFIX}"
    left.write_text("half")
    assert run(regenerate, *arguments, "--check").startswith("0 differences")
    (folder / "free_rigid_body" / "free_rigid_body_cf4.c").write_text("old")
    run(regenerate, *arguments)
    assert not left.exists()


def test_a_list_that_cannot_be_read_is_bad_input(tmp_path):
    path = tmp_path / "list.toml"
    wrong = {
        LIST + "extra = 1\n": "module 1: the keys of the module are: extra, method",
        "[[module": "not valid TOML",
        "\xff": "bytes that are not UTF-8",
        'name = "euler"\n': "the file is not a list of modules; its keys are: name",
        "": "the file is not a list of modules; its keys are: none",
        "module = 3": "not a list of modules",
        'module = ["a"]': "module 1: the keys of the module are: 'a'",
        LIST.replace('"cf4"', "4"): "expected two strings and a list of strings",
        LIST.replace('["c", "python"]', '"c"'): "expected two strings and a list of strings",
    }
    for text, message in wrong.items():
        path.write_bytes(text.encode("latin-1"))
        with pytest.raises(InputError, match=message):
            run(regenerate, "--list", str(path), "-o", str(tmp_path / "made"))


@pytest.mark.parametrize("seed", ["1", *(pytest.param(seed, marks=pytest.mark.slow) for seed in ("0", "2"))])
def test_the_kept_modules_are_what_is_emitted_under_any_hash_seed(seed):
    program = (
        "import sys\n"
        "from codegen.commands.regenerate import command\n"
        "sys.exit(command(standalone_mode=False))\n"
    )
    answer = subprocess.run(
        [sys.executable, "-c", program, "--check"],
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": seed},
    )
    assert answer.returncode == 0, answer.stdout + answer.stderr


def test_a_tableau_without_family_on_a_hamiltonian_scene_has_a_note():
    def result(scene, method):
        done = CliRunner().invoke(emit, [scene, "-m", method, "--json"], catch_exceptions=False)
        return done.stderr, json.loads(done.stdout)[0]["family_chosen"]

    note, chosen = result("linear_oscillator", "rk4")
    assert note == (
        "note: rk4 is given without a family; it is emitted as vrkmk(2):rk4; an alternative is vcg:rk4\n"
    )
    assert chosen
    assert result("linear_oscillator", "vcg:rk4") == ("", False)
    assert result("free_rigid_body", "cf4") == ("", False)


def test_an_empty_prefix_is_refused() -> None:
    with pytest.raises(InputError, match="'' cannot be the prefix"):
        run(emit, "free_rigid_body", "-m", "cf4", "--prefix", "", "--json")
