"""Sessions of README, docs and examples: ``console`` blocks, which tests run and compare with their pages.

The blocks of one page run in order in one new folder. A line that begins with ``$ `` is a command; the
lines after it are its output, with the messages of stderr. ``<!-- file: NAME -->`` writes the fenced block
that follows to a file. A page with the comment ``<!-- sessions: slow -->`` runs with the slow tests.

``python tests/sessions.py PAGE...`` replaces the outputs in pages by those of the program.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from click.testing import CliRunner

ROOT = Path(__file__).parents[1]
SLOW = "<!-- sessions: slow -->"
FENCE = re.compile(
    r"(?:^<!-- file: (?P<file>\S+) -->\n+)?^```(?P<language>\w*)[^\n]*\n(?P<body>.*?)^```$", re.M | re.S
)
TIME = re.compile(r" *\b\d+(?:\.\d+)?(?:e[+-]?\d+)? ?(?:ns|µs|ms|s|seconds|minutes)\b")
"""A run time, with the spaces that align it."""


@dataclass(frozen=True)
class Session:
    """One command of a page with the output that the page shows, and the place of the output in the page."""

    command: str
    shown: str
    start: int
    end: int


def pages() -> tuple[Path, ...]:
    """Return README, all pages of docs, and the pages of the examples.

    >>> "README.md" in [page.name for page in pages()]
    True
    """
    return (
        ROOT / "README.md",
        *sorted((ROOT / "docs").rglob("*.md")),
        *sorted((ROOT / "examples").glob("*/README.md")),
    )


def parts(text: str) -> Iterator[tuple[str, str] | Session]:
    """Yield the files of a page, as pairs of name and content, and its sessions, in order."""
    for fence in FENCE.finditer(text):
        if fence["file"]:
            yield fence["file"], fence["body"]
        elif fence["language"] == "console":
            yield from _sessions(fence["body"], fence.start("body"))


def _sessions(body: str, offset: int) -> Iterator[Session]:
    starts = [m.start() for m in re.finditer(r"^\$ ", body, re.M)]
    if body and starts[:1] != [0]:
        raise ValueError(f"a console block begins without a command: {body[:80]!r}")
    for start, end in zip(starts, [*starts[1:], len(body)], strict=True):
        after = re.compile(r"(?:.*\\\n)*.*\n").match(body, start)
        assert after
        command = body[start + 2 : after.end() - 1]
        yield Session(command, body[after.end() : end], offset + after.end(), offset + end)


def without_times(text: str) -> str:
    """Return a text with a mark in place of each run time, without spaces and empty lines at ends.

    >>> without_times("rk4   1.25 µs  next\\n\\n")
    'rk4 TIME  next'
    """
    lines = [TIME.sub(" TIME", line).rstrip() for line in text.splitlines()]
    return "\n".join(lines).strip("\n")


def execute(command: str, folder: Path) -> str:
    """Return what ``command`` prints in ``folder``, on stdout and stderr.

    A plain command of this program runs in this process, which saves its start. All others run in bash.
    """
    own, _, status = command.partition("; echo $?")
    if own.startswith("orderconds ") and not status and not re.search(r"[|<>;&$`*\n]", own):
        from orderconds.cli import program

        before = Path.cwd()
        os.chdir(folder)
        try:
            result = CliRunner().invoke(program, shlex.split(own)[1:], terminal_width=80)
        finally:
            os.chdir(before)
        return result.output + (f"{result.exit_code}\n" if own != command else "")
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env=_environment(folder),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        text=True,
        timeout=600,
        check=False,
    )
    return done.stdout


def _environment(folder: Path) -> dict[str, str]:
    """Return an environment in which ``orderconds`` and ``python`` are those of these tests."""
    commands = folder.parent / f"{folder.name}-bin"
    if not commands.exists():
        commands.mkdir()
        for name, arguments in (("python", ""), ("orderconds", " -m orderconds")):
            file = commands / name
            file.write_text(f'#!/bin/sh\nexec "{sys.executable}"{arguments} "$@"\n', encoding="utf-8")
            file.chmod(0o755)
    path = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))
    return {
        **os.environ,
        "PATH": f"{commands}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": path,
        "PYTHONIOENCODING": "utf-8",
        "COLUMNS": "80",
        "TERM": "dumb",
    }


def folder_of(page: Path, folder: Path) -> Path:
    """Return a new folder for the sessions of a page: empty, or for an example a copy of its folder."""
    if page.parent.parent == ROOT / "examples":
        return shutil.copytree(page.parent, folder)
    folder.mkdir()
    return folder


def printed(text: str, folder: Path) -> Iterator[tuple[Session, str]]:
    """Run the sessions of a page in ``folder`` and yield each with its output; write its files on the way."""
    for part in parts(text):
        if isinstance(part, Session):
            yield part, execute(part.command, folder)
        else:
            file = folder / part[0]
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(part[1], encoding="utf-8")


def renewed(text: str, page: Path = ROOT / "README.md") -> str:
    """Return the text of a page with the present outputs of its sessions."""
    with tempfile.TemporaryDirectory() as top:
        replaced = list(printed(text, folder_of(page, Path(top) / "session")))
    for session, output in reversed(replaced):
        if without_times(output) != without_times(session.shown):
            new = output.strip("\n") + "\n" if output.strip() else ""
            blank = "\n" if session.shown.endswith("\n\n") and new else ""
            text = text[: session.start] + new + blank + text[session.end :]
    return text


def main(names: list[str]) -> None:
    """Rewrite the pages of these names, or all pages."""
    for page in [Path(name).resolve() for name in names] or pages():
        text = page.read_text(encoding="utf-8")
        new = renewed(text, page)
        if new != text:
            page.write_text(new, encoding="utf-8")
            print(f"{page}: outputs replaced")


if __name__ == "__main__":
    main(sys.argv[1:])
