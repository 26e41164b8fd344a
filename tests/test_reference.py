"""The pages of the reference that follow from the program are up to date."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).parents[1]


def load() -> ModuleType:
    """Return the script that writes the pages."""
    spec = importlib.util.spec_from_file_location("reference", ROOT / ".ci/reference.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


reference = load()


def test_the_pages_are_those_that_the_program_gives() -> None:
    """A new process compares them: click keeps the help option of a command that another test has run."""
    run = [sys.executable, str(ROOT / ".ci/reference.py"), "--check"]
    result = subprocess.run(run, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr


def test_every_command_and_every_option_is_on_the_page() -> None:
    import click

    from orderconds.cli import program

    text = (ROOT / reference.COMMANDS).read_text(encoding="utf-8")
    context = click.Context(program)
    for name in program.list_commands(context):
        chapter = text.partition(f"### {name}\n")[2].partition("\n### ")[0]
        command = program.get_command(context, name)
        assert command is not None
        for option in command.params:
            if isinstance(option, click.Option) and not option.hidden:
                assert option.opts[-1] in chapter, name
