"""How the program ends: its exit status, one message, and with --json one document."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program
from orderconds.commands import screen
from orderconds.tableau import find

posix = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

WAIT = """
import signal, sys, time
from orderconds import cli
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job of a shell ignores it
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # a program under nohup ignores it
def wait(*_):
    import click
    @click.command()
    @click.option("--json", is_flag=True)
    def command(json):
        print("ready", file=sys.stderr, flush=True)
        time.sleep(60)
    return command
cli.Program.get_command = wait
cli.main()
"""


@pytest.fixture
def fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command ``check`` replaced by one with a fault."""

    @click.command()
    @click.option("--json", "as_json", is_flag=True)
    @click.option("--late", is_flag=True)
    def command(as_json: bool, late: bool) -> None:
        if late:
            screen.print_json({"done": True})
        raise ZeroDivisionError("division\nby a ball")

    monkeypatch.setattr(type(program), "get_command", lambda *_: command)


def run(*args: str, **environment: str) -> Result:
    return CliRunner().invoke(program, list(args), env=environment)


@pytest.mark.usefixtures("fails")
class TestInternalErrors:
    def test_one_exits_70_with_one_line_that_asks_for_a_report(self) -> None:
        result = run("check")
        assert (result.exit_code, result.stdout) == (70, "")
        assert result.stderr.startswith(
            "orderconds: internal error: ZeroDivisionError: division by a ball; please report this error"
        )
        assert result.stderr.count("\n") == 1

    def test_the_traceback_is_shown_when_it_is_asked_for(self) -> None:
        for result in (run("--traceback", "check"), run("check", ORDERCONDS_TRACEBACK="1")):
            assert result.exit_code == 70
            assert "in command\n    raise ZeroDivisionError" in result.stderr

    def test_with_json_its_record_is_the_only_document(self) -> None:
        (record,) = json.loads(run("check", "--json").stdout).values()
        assert (record["status"], record["kind"]) == (70, "ZeroDivisionError")
        assert json.loads(run("check", "--json", "--late").stdout) == {"done": True}


@pytest.mark.parametrize(
    ("args", "status", "kind"),
    [
        (["derive", "vgc", "--order", "3", "--json"], 2, "UnknownName"),
        (["derive", "--json"], 2, "MissingParameter"),
        (["cite", "nobody", "--json"], 2, "UnknownName"),
        (["chekc", "--json"], 2, "UnknownName"),
        (["convert", "nowhere.csv", "--json"], 2, "TableauError"),
        (["solve", "rk", "--stages", "2", "--order", "2", "--fix", "a99=1", "--json"], 2, "InputError"),
    ],
)
def test_with_json_an_error_is_one_document_that_has_the_message_in_parts(
    args: list[str], status: int, kind: str
) -> None:
    result = run(*args)
    (record,) = json.loads(result.stdout).values()
    assert (result.exit_code, record["status"], record["kind"]) == (status, status, kind)
    assert result.stderr == f"orderconds: {record['message']}\n"
    assert "found" not in record or record["found"] in record["message"]


def test_words_behind_a_double_dash_ask_for_no_json() -> None:
    assert run("cite", "--", "nobody", "--json").stdout == ""


def test_refine_without_a_proof_prints_a_document(tmp_path: Path) -> None:
    path = tmp_path / "euler.toml"
    path.write_text('name = "euler"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n')
    result = run("refine", str(path), "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout) == {
        "exact": {},
        "proof": None,
        "reason": "all coefficients are exact already",
    }


@posix
@pytest.mark.parametrize(
    ("name", "status", "said"),
    [
        ("SIGINT", 130, "interrupted"),
        ("SIGTERM", 143, "stopped by SIGTERM"),
        ("SIGHUP", 129, "stopped by SIGHUP"),
    ],
)
@pytest.mark.parametrize("words", [[], ["--json"]])
def test_a_signal_ends_the_program_with_one_line(name: str, status: int, said: str, words: list[str]) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", WAIT, "wait", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as child:
        assert child.stderr is not None
        assert child.stderr.readline() == "ready\n"
        child.send_signal(getattr(signal, name))
        out, err = child.communicate(timeout=30)
    assert (child.returncode, err) == (status, f"orderconds: {said}\n")
    if words:
        assert json.loads(out)["error"]["status"] == status
    else:
        assert out == ""


@posix
def test_an_ignored_signal_stays_ignored() -> None:
    """As ``nohup`` does it."""
    code = (
        "import os, signal\nfrom orderconds.exit_status import catch_signals\n"
        "signal.signal(signal.SIGHUP, signal.SIG_IGN)\ncatch_signals()\n"
        "os.kill(os.getpid(), signal.SIGHUP)\nprint('alive')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "alive\n"


@posix
@pytest.mark.parametrize("args", ["--help", "list families", "check rk4 --json", "derive rk --order 6"])
def test_a_closed_pipe_ends_every_output_quietly(args: str) -> None:
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(
        [sys.executable, "-m", "orderconds", *args.split()],
        stdout=write,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(write)
    assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.parametrize(
    ("name", "encoding"), [("é.toml", "ascii"), ("é.toml", "utf-8"), (os.fsdecode(b"\xff.toml"), "utf-8")]
)
def test_a_terminal_without_the_letters_of_a_name_is_no_error(
    tmp_path: Path, name: str, encoding: str
) -> None:
    try:
        (tmp_path / name).write_text('name = "euler"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n')
    except (OSError, UnicodeError):
        pytest.skip("not a valid file name on this system")
    done = subprocess.run(
        [sys.executable, "-m", "orderconds", "check", str(tmp_path / name)],
        env={**os.environ, "PYTHONIOENCODING": encoding},
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert b"euler: order 1; nothing claimed" in done.stdout


def test_a_file_that_is_printed_is_utf_8_in_every_locale(tmp_path: Path) -> None:
    text = find("cg4a").read_text(encoding="utf-8")
    (tmp_path / "cg4a.toml").write_text(text.replace('source = "', 'source = "Müller–'), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "orderconds", "refine", str(tmp_path / "cg4a.toml"), "--digits", "30"],
        env={**os.environ, "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"},
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert "Müller–" in done.stdout.decode("utf-8")
