"""The places that commands write to: an empty name is a mistake, not the present folder."""

from __future__ import annotations

import click


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


FOLDER = Place("folder", "for the present one type .")
FILE = Place("file", "leave the option out for stdout")
