"""Options for output files and output folders, and a function that writes an output file."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import click

from orderconds.errors import InputError
from orderconds.input_file import reason
from orderconds.output_file import write_files


class Place(click.ParamType[str]):
    """The type of an option for an output file or folder.

    A blank name is refused. A name that begins with ``--`` is refused, because it is usually the next option.

    >>> FOLDER.convert("out", None, None)
    'out'
    """

    def __init__(self, name: str, otherwise: str) -> None:
        self.name, self.otherwise = name, otherwise

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return ``value``. Raise click.BadParameter if ``value`` is blank or begins with ``--``."""
        if not value.strip():
            self.fail(f"{value!r} is not the name of a {self.name}; {self.otherwise}", param, ctx)
        if value.startswith("--"):
            self.fail(
                f"the name of a {self.name} is missing before {value}; if {value} itself is the name, type "
                f"./{value}",
                param,
                ctx,
            )
        return value


FOLDER = Place("folder", "type '.' for the current folder")
FILE = Place("file", "without this option, the output goes to stdout")


def put(path: str, content: bytes) -> None:
    """Write ``content`` to a file atomically. If ``path`` is a device or a pipe, write to it directly.

    Raises :class:`~orderconds.errors.InputError` if writing fails or if no process reads the pipe.

    >>> import os
    >>> put(os.devnull, b"gone")
    """
    try:
        # If symbolic links form a loop, ``target`` is still a link.
        target = Path(os.path.realpath(path))
        if target.is_symlink():
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
        if target.exists() and not target.is_file():
            _write_directly(target, content)
            return
        write_files({target: content})
    except OSError as problem:
        raise InputError(reason(problem), where=path, expected="a file that can be written") from None


def _write_directly(path: Path, content: bytes) -> None:
    """Write to an existing device or pipe. Raise an OSError if no process reads the pipe."""
    try:
        handle = os.open(path, os.O_WRONLY | getattr(os, "O_NONBLOCK", 0))
    except OSError as problem:
        if problem.errno == errno.ENXIO:
            raise OSError(problem.errno, "no process reads this pipe") from None
        raise
    with os.fdopen(handle, "wb") as stream:
        if os.name == "posix":
            # While a pipe is full, the write has to wait until another process reads from the pipe.
            os.set_blocking(handle, True)
        stream.write(content)
