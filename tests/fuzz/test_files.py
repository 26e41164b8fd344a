"""Mutated tableau files in every format: each is read or refused with one message.

A small mutator, seeded: pieces of one file are deleted, doubled, exchanged, put into another one, or replaced
by hostile text. The longest time of one input is a bound against inputs that never end, not a measurement.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from random import Random
from types import FrameType

import pytest
from click.testing import CliRunner

from orderconds.cli import program
from orderconds.errors import InputError
from orderconds.exchange import FORMATS, export, read_data
from orderconds.tableau.file_format import Data
from orderconds.tableau.library import available, find
from orderconds.tableau.record import from_data

SECONDS = 20

HOSTILE = (
    b"\x00",
    b"\xff\xfe",
    b"\xe2\x80\xae",
    b"\r",
    b"\n",
    b"1e999",
    b"nan",
    b"inf",
    b"-0",
    b"1/0",
    b"~",
    b"0.1~",
    b"[",
    b"]" * 9,
    b"{" * 50,
    b"(" * 60,
    b"\\",
    b"\\\\",
    b"*/",
    b"/*",
    b"#",
    b"%",
    b'"""',
    b"'",
    b"sqrt(",
    b"^",
    b"9" * 400,
    b"0." + b"3" * 300,
    b"a." * 40,
    b"lambda",
    b"__import__('os')",
    b"x^64^64",
    b"2^(1/24)",
    b",,,",
    b"\\begin{pmatrix}",
    b"\\end{array}",
    b"&",
    b"A = [",
    b"proof",
    b"order = 99",
    b"2000-01-01",
    b"true",
    b"1.5",
)
"""Pieces that have a meaning in one of the formats, or none in any."""


class TooLong(BaseException):
    """One input took longer than :data:`SECONDS`."""


@contextmanager
def limited() -> Iterator[None]:
    def stop(number: int, frame: FrameType | None) -> None:
        raise TooLong

    previous = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)


@cache
def library() -> tuple[Data, ...]:
    """Return the small files of the library as keys and values."""
    found = []
    for name in available():
        content = Path(find(name)).read_bytes()
        if len(content) < 3000:
            found.append(read_data(content, "toml", name))
    return tuple(found)


@cache
def written(place: int, to: str) -> bytes | None:
    """Return a file of the library in a format, None where that cannot hold it."""
    try:
        return export(library()[place], to)
    except InputError:
        return None


def mutated(content: bytes, other: bytes, generator: Random) -> bytes:
    for _ in range(generator.choice((1, 1, 1, 2, 3, 8))):
        start, end = sorted(generator.randrange(len(content) + 1) for _ in range(2))
        end = min(end, start + generator.choice((1, 3, 20, 400)))
        piece = content[start:end]
        replaced = generator.choice(
            (
                b"",
                piece * 2,
                piece[::-1],
                piece * generator.choice((1, 50)),
                generator.choice(HOSTILE),
                bytes(generator.randrange(256) for _ in range(3)),
                other[start:end],
                piece.swapcase(),
            )
        )
        content = content[:start] + replaced + content[end:]
    return content


def drawn(seed: int) -> tuple[str, bytes]:
    """Return a format and a mutated file."""
    generator = Random(seed)
    of = generator.choice(sorted(FORMATS))
    content = None
    while content is None:
        content = written(generator.randrange(len(library())), of)
    other = written(generator.randrange(len(library())), generator.choice(sorted(FORMATS))) or b""
    return of, mutated(content, other, generator)


def read_or_refused(seed: int) -> bool:
    """Read one mutated file, and write it in another format where it is sound; say whether it was."""
    of, content = drawn(seed)
    to = Random(~seed).choice(sorted(FORMATS))
    try:
        with limited():
            data = read_data(content, of, "mutated")
            from_data(data, "mutated")
            export(data, to)
    except InputError:
        return False
    except (Exception, TooLong) as problem:
        raise AssertionError(f"seed {seed}, {of} to {to}: {problem!r}\n{content[:2000]!r}") from problem
    return True


def checked(seed: int, folder: Path) -> int:
    """Run ``check`` on one mutated file and return its exit status."""
    of, content = drawn(seed)
    path = folder / f"mutated{FORMATS[of][1]}"
    path.write_bytes(content)
    arguments = ["check", str(path), "--json", "--max-seconds", "2", "--max-memory", "2000"]
    try:
        with limited():
            result = CliRunner().invoke(program, arguments)
    except TooLong:
        raise AssertionError(f"seed {seed}, {of}: longer than {SECONDS} s\n{content[:2000]!r}") from None
    assert result.exit_code in (0, 1, 2), (seed, of, result.output, content[:2000])
    assert result.exception is None or isinstance(result.exception, SystemExit), (seed, result.exception)
    return result.exit_code


def test_mutated_files_are_read_or_refused() -> None:
    sound = sum(read_or_refused(seed) for seed in range(400))
    assert 40 < sound < 380  # else the mutator changes everything, or nothing


def test_mutated_files_are_checked_or_refused(tmp_path: Path) -> None:
    statuses = {checked(seed, tmp_path) for seed in range(40)}
    assert statuses == {0, 1, 2} or statuses == {0, 2}


@pytest.mark.slow
@pytest.mark.parametrize("block", range(20))
def test_many_mutated_files_are_read_or_refused(block: int) -> None:
    for seed in range(10_000 + 1000 * block, 11_000 + 1000 * block):
        read_or_refused(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_many_mutated_files_are_checked_or_refused(block: int, tmp_path: Path) -> None:
    for seed in range(50_000 + 100 * block, 50_100 + 100 * block):
        checked(seed, tmp_path)
