"""The program: exit statuses, one message an error, commands of other packages through entry points."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import sys
import time
import tomllib
from importlib import import_module
from pathlib import Path

import click
import pytest
from click.testing import CliRunner, Result

from orderconds.cli import BUILT_IN, program
from orderconds.errors import TableauError

ROOT = Path(__file__).parents[2]


def run(*args: str) -> Result:
    return CliRunner().invoke(program, list(args))


@pytest.fixture
def offered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another distribution on sys.path that offers the commands ``fail``, ``raise`` and ``broken``."""
    (tmp_path / "another_package.py").write_text(
        "import click\n"
        "from orderconds.errors import TableauError\n"
        "@click.command(short_help='Fail honestly.')\n"
        "def fail():\n"
        "    return 1\n"
        "@click.command(name='raise')\n"
        "def raise_():\n"
        "    raise TableauError('a row of 3', where='x.toml: A', expected='2 entries', hint='drop one')\n"
    )
    info = tmp_path / "another_package-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: another-package\nVersion: 1\n")
    (info / "entry_points.txt").write_text(
        "[orderconds.commands]\n"
        "fail = another_package:fail\nraise = another_package:raise_\nbroken = missing_module:command\n"
    )
    monkeypatch.syspath_prepend(tmp_path)


def test_help_lists_every_built_in_command() -> None:
    result = run("--help")
    assert result.exit_code == 0
    assert all(f"\n  {name} " in result.stdout for name in BUILT_IN)


def test_help_loads_no_built_in_command() -> None:
    code = (
        "import sys, orderconds.cli as c\ntry: c.program.main(['--help'])\nexcept SystemExit: pass\n"
        "print([m for m, _ in c.BUILT_IN.values() if m in sys.modules], file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr.strip() == "[]"


def test_no_arguments_is_help() -> None:
    result = run()
    assert (result.exit_code, result.stderr) == (0, "")
    assert "Commands:" in result.stdout


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["chekc", "rk4"], "type: orderconds check"),
        (["--frobnicate"], "--frobnicate"),
        (["check", "rk4", "--family"], "check --help"),
        (["zzzzz"], "type: orderconds --help"),
    ],
)
def test_bad_usage_exits_2_with_one_line(args: list[str], said: str) -> None:
    result = run(*args)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert said in result.stderr
    assert result.stderr.count("\n") == 1


def test_every_built_in_command_is_a_click_command_named_in_the_table() -> None:
    for name, (module, _) in BUILT_IN.items():
        command = import_module(module).command
        assert isinstance(command, click.Command)
        assert command.name == name


def commands() -> dict[str, click.Command]:
    """Return every command of this project, those of ``codegen`` as pyproject.toml offers them."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    places = {name: f"{module}:command" for name, (module, _) in BUILT_IN.items()}
    places |= project["entry-points"]["orderconds.commands"]
    return {n: getattr(import_module(p.partition(":")[0]), p.partition(":")[2]) for n, p in places.items()}


@pytest.mark.parametrize("name", commands())
def test_every_command_takes_json(name: str) -> None:
    options = {word for option in commands()[name].params for word in option.opts}
    assert "--json" in options


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["construct", "gauss", "-s", "2", "--stages", "3"], "construct: --stages is given twice"),
        (["check", "rk4", "-f", "rk", "--order=3", "-p4"], "check: --order is given twice"),
    ],
)
def test_an_option_of_one_value_is_not_given_twice(args: list[str], said: str) -> None:
    result = run(*args)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(f"orderconds: {said}; give it once")


def test_flags_and_options_of_several_values_may_be_repeated() -> None:
    assert run("construct", "gauss", "-s", "1", "--json", "--json").exit_code == 0
    words = ["--fix", "a21=1/2", "--fix", "b2=1"]
    assert run("solve", "rk", "-s", "2", "-p", "2", "--explicit", *words).exit_code == 0


def test_an_empty_place_to_write_to_is_told_what_to_type_for_the_present_folder() -> None:
    from orderconds.commands.place import FOLDER

    with pytest.raises(click.BadParameter, match=r"type '\.' for the current folder"):
        FOLDER.convert("", None, None)


@pytest.mark.usefixtures("offered")
class TestCommandsOfOtherPackages:
    def test_they_are_listed_after_the_built_in_ones(self) -> None:
        names = program.list_commands(click.Context(program))
        assert names[: len(BUILT_IN)] == list(BUILT_IN)
        assert {"fail", "raise", "broken"} <= set(names)

    def test_their_return_value_is_the_exit_status(self) -> None:
        assert run("fail").exit_code == 1

    def test_their_input_errors_become_one_message_and_status_2(self) -> None:
        result = run("raise")
        assert result.exit_code == 2
        assert result.stderr == "orderconds: x.toml: A: a row of 3; expected 2 entries; drop one\n"

    def test_one_that_cannot_be_loaded_is_named_and_does_not_end_the_help(self) -> None:
        assert run("broken").exit_code == 2
        assert "missing_module" in run("broken").stderr
        help_ = run("--help")
        assert help_.exit_code == 0
        assert "Fail honestly." in help_.stdout


def test_entry_points_of_this_project_exist() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for group in ("orderconds.commands", "orderconds.listings"):
        for value in project["entry-points"][group].values():
            module, _, attribute = value.partition(":")
            assert hasattr(import_module(module), attribute), value


def test_an_operating_system_error_is_one_message(monkeypatch: pytest.MonkeyPatch) -> None:
    @click.command()
    def refuse() -> None:
        raise PermissionError(13, "Permission denied", "locked.toml")

    monkeypatch.setattr(type(program), "get_command", lambda *_: refuse)
    result = run("check")
    assert (result.exit_code, result.stderr) == (2, "orderconds: locked.toml: Permission denied\n")


def test_errors_spell_what_where_expected_and_hint() -> None:
    assert str(TableauError("unknown key 'bb'", where="x.toml", expected="b", hint="rename it")) == (
        "x.toml: unknown key 'bb'; expected b; rename it"
    )


def test_a_reader_that_goes_away_ends_the_program_quietly() -> None:
    """As in ``orderconds trees rooted --order 12 | head``."""
    child = subprocess.Popen(
        [sys.executable, "-m", "orderconds", "trees", "rooted", "--order", "13"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert child.stdout is not None
    assert child.stderr is not None
    child.stdout.readline()
    child.stdout.close()
    assert child.stderr.read() == b""
    assert child.wait() == 141
    child.stderr.close()


@pytest.mark.skipif(os.name != "posix", reason="sends SIGINT")
def test_an_interrupt_ends_the_program_without_a_traceback() -> None:
    code = (
        "import click, signal, time, sys\nfrom orderconds.cli import Program, program\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a shell's background job ignores it
        "@click.command()\ndef wait():\n    print('ready', flush=True); time.sleep(60)\n"
        "Program.get_command = lambda *_: wait\nprogram.main(['wait'])"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        child.stdout.readline()
        time.sleep(0.05)
        child.send_signal(signal.SIGINT)
        assert child.wait() == 130
        assert "Traceback" not in child.stderr.read()


@pytest.mark.skipif(os.name != "posix", reason="closes file descriptors in a shell")
@pytest.mark.parametrize(
    ("redirections", "args", "status"),
    [
        (">&-", "list families", 0),
        (">&- 2>&-", "chekc", 2),
        ("2>/dev/full", "chekc", 2),
        (">/dev/full 2>/dev/full", "list families", 2),
    ],
)
def test_streams_that_take_nothing_leave_the_status(redirections: str, args: str, status: int) -> None:
    if "full" in redirections and not Path("/dev/full").exists():
        pytest.skip("no /dev/full")
    line = f"{shlex.quote(sys.executable)} -m orderconds {args} {redirections}"
    done = subprocess.run(["sh", "-c", line], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (status, "")
