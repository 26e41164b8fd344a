"""The output file of a command that writes a tableau. The suffix of the file determines the format."""

from __future__ import annotations

import os

import click

from orderconds.commands.place import FILE, put
from orderconds.tableau.file_format import Data

tableau_output = click.option(
    "--output",
    "-o",
    type=FILE,
    metavar="FILE",
    help="Write to this file instead of stdout. The suffix of FILE determines the format: .toml, .json, "
    ".csv, .npz, .py, .tex, .c or .h.",
)
"""The option ``--output`` of the commands that write a tableau."""


def output_format(output: str | None, hint: str = "") -> str:
    """Return the format that the suffix of an output file indicates.

    Without an output file, and for a device or a pipe with an unknown suffix, the format is ``toml``. Raises
    :class:`~orderconds.errors.InputError` if the suffix is unknown and ``output`` is not a device or a pipe.
    The message contains ``hint``.

    >>> output_format(None), output_format("rk4.csv")
    ('toml', 'csv')
    """
    from orderconds.exchange import find_format, format_of

    if output is None:
        return "toml"
    # The name of a device or a pipe, such as /dev/null, usually has no suffix.
    special = os.path.exists(output) and not os.path.isfile(output) and not os.path.isdir(output)
    return find_format(output) or ("toml" if special else format_of(output, hint))


def put_tableau(output: str, to: str, data: Data, toml: str | None = None) -> None:
    """Write a tableau to a file in the format ``to``. Print a note about each key that the file omits.

    If ``to`` is ``"toml"``, the text ``toml`` is written to the file. By default, this text is computed from
    ``data``.

    Raises :class:`~orderconds.errors.InputError` if the format cannot represent the tableau, or if writing
    fails.

    >>> put_tableau(os.devnull, "csv", {"name": "m", "family": "rk", "A": [[]], "b": [1]})
    """
    from orderconds.exchange import export

    put(output, toml.encode() if to == "toml" and toml is not None else export(data, to))
    note_left_out(data, to)


def note_left_out(data: Data, to: str) -> None:
    """Print a note on stderr about each key of ``data`` that is missing in a file of the format ``to``.

    >>> note_left_out({"name": "m", "proof": {"conditions": "cg", "order": 4}}, "json")
    """
    from orderconds.exchange import left_out

    for key in left_out(data, to):
        click.echo(
            f"note: the output does not contain the key {key}; the formats json and toml can contain it",
            err=True,
        )
