"""The places that commands write to: an empty name is a mistake, and files are whole or as they were."""

from __future__ import annotations

from pathlib import Path

import click

from orderconds.errors import InputError
from orderconds.input_file import reason
from orderconds.output_file import write_files


class Place(click.ParamType[str]):
    """The name of a folder or file to write; refused where it is empty or blank.

    >>> FOLDER.convert("out", None, None)
    'out'
    """

    def __init__(self, name: str, otherwise: str) -> None:
        self.name, self.otherwise = name, otherwise

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name."""
        if not value.strip():
            self.fail(f"{value!r} names no {self.name}; {self.otherwise}", param, ctx)
        return value


FOLDER = Place("folder", "type '.' for the present one")
FILE = Place("file", "leave the option out for stdout")


def put(path: str, content: bytes) -> None:
    """Write a file under another name and rename it; devices and pipes are written to as they are.

    Raises :class:`~orderconds.errors.InputError` where that cannot be done.

    >>> import os
    >>> put(os.devnull, b"gone")
    """
    target = Path(path).resolve()  # a link stays a link
    try:
        if target.exists() and not target.is_file():
            target.write_bytes(content)
            return
        write_files({target: content})
    except OSError as problem:
        raise InputError(reason(problem), where=path, expected="a file that can be written") from None
