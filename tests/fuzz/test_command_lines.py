"""Mutated command lines end with documented statuses, in bounded time and memory, and write whole files."""

from __future__ import annotations

import ast
import csv
import io
import json
import os
import shutil
import subprocess
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from random import Random

import click
import pytest

from codegen.artifact import MANIFEST, entries_of, read
from codegen.lab.measurement_cache import FOLDER
from orderconds.errors import InputError
from orderconds.exchange import FORMATS, read_data
from orderconds.exit_status import INTERRUPTED
from orderconds.output_file import is_temporary
from tests.fuzz.drawn_lines import commands, drawn, fill, sound
from tests.fuzz.fork_server import ERR, MEGABYTES, OUT, Ending, run, running

pytestmark = pytest.mark.skipif(os.name != "posix", reason="forks")

MEASURING = {"bench", "converge", "longrun", "recommend", "report", "solve", "stability"}
EXPANDING = {"derive"}
AS_LONG_AS_ASKED = MEASURING | EXPANDING
"""Commands that work as long as their options ask; they end when interrupted.

Such options are --order, --steps and --budget, which is 50 s by default."""


QUICK = 20
"""The number of lines that every run of the tests tries."""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[subprocess.Popen[str]]:
    with running(tmp_path_factory.mktemp("cache")) as process:
        yield process


def contents(folder: Path) -> dict[str, bytes]:
    """Return every regular file of a folder that is no capture of a stream."""
    found = (p for p in folder.rglob("*") if p.is_file() and p.name not in (OUT, ERR, "interrupted"))
    return {str(path.relative_to(folder)): path.read_bytes() for path in found}


def check_ending(words: list[str], ending: Ending) -> None:
    """Assert a documented status within the bounds."""
    assert ending.megabytes <= MEGABYTES
    assert not ending.left_processes
    if ending.interrupted:
        assert AS_LONG_AS_ASKED & set(words), "longer than 20 s"
        assert ending.status in (0, 1, 2, INTERRUPTED), "an interrupt does not end it"
    else:
        assert ending.status in (0, 1, 2)


def check_output(words: list[str], ending: Ending, out: bytes, err: str) -> None:
    """Assert one message or one document."""
    assert "Traceback" not in err
    assert "Traceback" not in out.decode(errors="replace")
    before = words[: words.index("--")] if "--" in words else words
    help_asked = {"-h", "--help", "--version"} & set(words)
    if "--json" in before and not help_asked:
        json.loads(out)
    if ending.status == 2 and "--json" not in before:
        assert err.strip()


def is_whole(content: bytes, words: list[str]) -> bool:
    """Return True if a written file is complete in one of the formats that commands write."""
    if "derive" in words and content.endswith(b"\n"):
        return True  # conditions as text, LaTeX or SymPy source: the last line is complete
    if content.endswith((b"</svg>\n", b"</html>\n")):
        return True
    if content.startswith(b"scene,method,"):  # the rows of a report
        rows = list(csv.reader(io.StringIO(content.decode())))
        return content.endswith(b"\n") and {len(row) for row in rows} == {len(rows[0])}
    for read_back in (tomllib.loads, json.loads, ast.parse):
        with suppress(ValueError, SyntaxError):
            return bool(read_back(content.decode()))
    for of in FORMATS:
        with suppress(InputError):
            return bool(read_data(content, of, "written"))
    return False


def check_files(words: list[str], ending: Ending, before: dict[str, bytes], folder: Path) -> None:
    """Assert that no file is half written, and that a refused line writes none."""
    after = contents(folder)
    assert not [name for name in after if is_temporary(Path(name).name)]
    changed = {name for name in after if after[name] != before.get(name)}
    lost = set(before) - set(after)
    assert not lost
    listed: set[str] = set()
    for name in after:
        if Path(name).name == MANIFEST:
            place = (folder / name).parent
            for entry in entries_of(place):
                files = read(place, entry["module"], entry["target"]).files  # compares the digests
                listed |= {str((place / file).relative_to(folder)) for file in files}
    # Each entry of a measurement cache holds its own digest.
    entries = {name for name in changed if any(part.endswith(FOLDER) for part in Path(name).parts)}
    assert not [name for name in changed - listed - entries if not is_whole(after[name], words)]
    if ending.status == 2:
        assert changed == set()


def examine(server: subprocess.Popen[str], seed: int, place: Path) -> tuple[list[str], Ending]:
    """Run the line of one seed."""
    words = drawn(seed)
    folder = place / f"line{seed}"
    folder.mkdir()
    fill(folder, seed)
    before = contents(folder)
    ending = run(server, words, folder)
    out = (folder / OUT).read_bytes() if (folder / OUT).exists() else b""
    err = (folder / ERR).read_text(errors="replace") if (folder / ERR).exists() else ""
    try:
        check_ending(words, ending)
        check_output(words, ending, out, err)
        check_files(words, ending, before, folder)
    except Exception as problem:
        shown = f"seed {seed}: {words!r}\n{ending}\n{out[:500]!r}\n{err[-1500:]}"
        raise AssertionError(f"{shown}\n{type(problem).__name__}: {problem}") from problem
    shutil.rmtree(folder)
    return words, ending


@pytest.mark.parametrize("name", commands())
def test_lines_are_drawn_over_every_option(name: str) -> None:
    words = {word for seed in range(100) for word in sound(name, Random(seed))}
    for parameter in commands()[name].params:
        if isinstance(parameter, click.Option):
            assert words & set(parameter.opts), parameter.name


def test_mutated_command_lines_end_with_a_documented_status(
    server: subprocess.Popen[str], tmp_path: Path
) -> None:
    endings = [examine(server, seed, tmp_path)[1] for seed in range(QUICK)]
    assert {ending.status for ending in endings} >= {0, 2}


@pytest.mark.slow
def test_more_mutated_command_lines_end_with_a_documented_status(
    server: subprocess.Popen[str], tmp_path: Path
) -> None:
    for seed in range(QUICK, 40):
        examine(server, seed, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(20))
def test_many_mutated_command_lines_end_with_a_documented_status(
    server: subprocess.Popen[str], tmp_path: Path, block: int
) -> None:
    for seed in range(10_000 + 250 * block, 10_250 + 250 * block):
        examine(server, seed, tmp_path)
