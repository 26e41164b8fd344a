"""Options of every command: one letter has one meaning, --quiet and --verbose, examples, completion."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

import click
import numpy
import pytest
from click.shell_completion import ShellComplete
from click.testing import CliRunner, Result

from orderconds.cli import program

NAMES = program.list_commands(click.Context(program))


def run(*words: str) -> Result:
    return CliRunner().invoke(program, list(words))


def command(name: str) -> click.Command:
    found = program.get_command(click.Context(program), name)
    assert found is not None
    return found


def examples(name: str) -> list[str]:
    """The command lines below "Examples:" in the help of a command."""
    text = run(name, "--help").stdout.partition("Examples:")[2].partition("\n\n")[0]
    return [line.strip() for line in text.splitlines() if line.strip()]


def test_a_letter_has_the_same_meaning_in_all_commands() -> None:
    meanings: dict[str, set[str]] = {}
    for name in NAMES:
        for option in command(name).params:
            for short in option.opts:
                if isinstance(option, click.Option) and re.fullmatch("-[A-Za-z]", short):
                    long = next(word for word in option.opts if word.startswith("--"))
                    meanings.setdefault(short, set()).add(long)
    assert meanings["-p"] == {"--order"}
    assert meanings["-P"] == {"--parameter"}
    assert {short: longs for short, longs in meanings.items() if len(longs) > 1} == {}


@pytest.mark.parametrize("name", NAMES)
def test_the_help_of_a_command_ends_with_examples_that_the_command_accepts(name: str) -> None:
    lines = examples(name)
    assert lines
    for line in lines:
        first, called, *words = shlex.split(line)
        assert (first, called) == ("orderconds", name)
        with click.Context(program, info_name="orderconds") as parent:
            command(name).make_context(name, words, parent=parent)


def test_every_command_with_a_scene_accepts_values_of_parameters() -> None:
    with_scene = [name for name in NAMES if any(p.name in ("scene", "scenes") for p in command(name).params)]
    assert len(with_scene) >= 8
    for name in with_scene:
        assert any("--parameter" in option.opts for option in command(name).params), name


def test_quiet_prints_only_what_does_not_hold(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.toml"
    wrong.write_text('name = "wrong"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n[claims]\nrk = 2\n')
    assert run("check", "--quiet", "rk4").stdout == ""
    assert run("check", "rk4").stdout.startswith("rk4: holds")
    result = run("check", "-q", "rk4", str(wrong))
    assert result.exit_code == 1
    assert "wrong: fails" in result.stdout
    assert "rk4" not in result.stdout
    assert "contradict" in run("check", "-q", "-v", "rk4").stderr


def test_verbose_writes_progress_with_the_remaining_time_to_stderr() -> None:
    result = run("check", "--verbose", "rk4", "cf4")
    assert re.search(r"\d\.\d s  2 of 2, 0\.0 s remaining  cf4\n", result.stderr)
    assert run("check", "rk4", "cf4").stderr == ""


@pytest.mark.parametrize(
    ("words", "typed", "wanted"),
    [
        ([], "conv", "converge"),
        (["derive"], "vr", "vrkmk"),
        (["check"], "dormand", "dormand_prince5"),
        (["emit"], "free", "free_rigid_body_s3"),
        (["emit", "dipole", "--method"], "vcg:tri", "vcg:triple_jump"),
        (["bench", "dipole", "--target"], "py", "python"),
    ],
)
def test_a_shell_completes_names(words: list[str], typed: str, wanted: str) -> None:
    completion = ShellComplete(program, {}, "orderconds", "_ORDERCONDS_COMPLETE")
    assert wanted in [item.value for item in completion.get_completions(words, typed)]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_script_of_a_shell_asks_this_program(shell: str) -> None:
    result = run("completion", shell)
    assert result.exit_code == 0
    assert "_ORDERCONDS_COMPLETE=" in result.stdout


@pytest.mark.slow
@pytest.mark.parametrize("line", [line for name in NAMES for line in examples(name)])
def test_the_examples_run(line: str, tmp_path: Path) -> None:
    root = Path(__file__).parents[3]
    for folder in ("tableaux", "docs"):
        (tmp_path / folder).symlink_to(root / folder)
    # ``refine`` needs decimals: those of a file with a [proof], and the binary floats of an archive.
    name = "carpenter_kennedy4" if " refine " in line else "rk4"
    words = [sys.executable, "-m", "orderconds", "convert", name, "-o", "mine.toml"]
    subprocess.run(words, cwd=tmp_path, check=True)
    numpy.savez(tmp_path / "mine.npz", A=numpy.array([[0.0, 0.0], [2 / 3, 0.0]]), b=numpy.array([0.25, 0.75]))
    (tmp_path / "top.py").symlink_to(root / "codegen" / "scenes" / "heavy_top.py")
    done = subprocess.run(
        [sys.executable, "-m", "orderconds", *shlex.split(line)[1:]],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=1200,
    )
    assert done.returncode == 0, done.stderr


def test_derive_writes_the_json_to_the_file_and_to_stdout(tmp_path: Path) -> None:
    place = tmp_path / "conditions.json"
    done = run("derive", "rk", "--order", "2", "--json", "-o", str(place))
    assert json.loads(done.stdout) == json.loads(place.read_text())
    refused = run("derive", "rk", "--order", "2", "--json", "-o", str(tmp_path))
    assert refused.exit_code == 2
    assert json.loads(refused.stdout)["error"]["status"] == 2


def test_solve_refuses_a_name_before_it_searches(tmp_path: Path) -> None:
    words = ("solve", "rk", "-s", "2", "-p", "2", "-o", str(tmp_path / "out.toml"), "--name", "ü")
    done = run(*words)
    assert done.exit_code == 2
    assert "--name: name = 'ü'" in done.stderr
    assert not list(tmp_path.iterdir())
