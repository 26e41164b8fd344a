"""Mutated tableau files in every format: each is read or refused with one message.

The bounds on time and memory of one input are against inputs that never end, they are no measurements.
"""

from __future__ import annotations

import resource
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from types import FrameType

import pytest
from click.testing import CliRunner

from orderconds.cli import program
from orderconds.errors import InputError
from orderconds.exchange import FORMATS, export, read_data
from orderconds.tableau.record import from_data
from tests.fuzz.mutated_files import drawn

SECONDS = 20

MEGABYTES = 2048


class TooLong(BaseException):
    """One input took longer than :data:`SECONDS`."""


def address_space() -> int:
    """Return the bytes of this process's address space."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    return pages * resource.getpagesize()


@contextmanager
def limited() -> Iterator[None]:
    """Raise :class:`TooLong` or a MemoryError where one input takes more than its share."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise TooLong

    previous = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    if sys.platform == "linux":
        resource.setrlimit(resource.RLIMIT_AS, (address_space() + (MEGABYTES << 20), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)


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


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_the_memory_of_an_input_is_bounded() -> None:
    with limited():
        bytearray(MEGABYTES // 2 << 20)
    # Other objects of the process may be freed meanwhile, so the margin is more than a few megabytes.
    with pytest.raises(MemoryError), limited():
        bytearray(2 * MEGABYTES << 20)


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
