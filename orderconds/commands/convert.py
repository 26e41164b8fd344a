"""``orderconds convert``: convert a tableau between TOML, JSON, CSV, NumPy, SymPy, LaTeX and C arrays."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click

from orderconds.commands import screen
from orderconds.commands.names import completing, tableau_names
from orderconds.commands.place import FILE, put
from orderconds.commands.tableau_output import note_left_out, output_format
from orderconds.exchange import FORMATS, export, format_of, left_out, name_of, read_data
from orderconds.tableau import find
from orderconds.tableau.file import bytes_of
from orderconds.tableau.record import from_data

NAMES = click.Choice(list(FORMATS))


@click.command(name="convert")
@click.argument("source", metavar="FILE|NAME", shell_complete=completing(tableau_names, files=True))
@click.option(
    "--from",
    "of",
    type=NAMES,
    help="The format of FILE. Default: the format indicated by the suffix of FILE.",
)
@click.option(
    "--to",
    type=NAMES,
    help="The format to write. By default, the suffix of --output indicates the format. Without --output, "
    "the default is toml.",
)
@click.option(
    "--name",
    help="The name of the new tableau.  [default: the name in FILE, or else the name of FILE without suffix]",
)
@click.option("--output", "-o", type=FILE, metavar="FILE", help="Write to this file instead of stdout.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(
    source: str, of: str | None, to: str | None, name: str | None, output: str | None, as_json: bool
) -> int:
    """Convert a tableau to another file format. The tableau is given as a file or by its name in the library.
    Python files are parsed, but never executed.

    Files in TOML and JSON can contain every key of a tableau. Files in other formats contain neither the
    proof nor the continuous extension (the keys proof and dense). The command prints a note about each
    omitted key. With --json, the list left_out contains these keys.

    \b
    Examples:
        orderconds convert rk4 --to latex
        orderconds convert cf4 --to json -o cf4.json
    """
    bare = of is None and not os.path.exists(source) and "." not in os.path.basename(source)
    path = find(source) if bare else Path(source)
    content = bytes_of(path)
    hint = "give the format with --from or --to"
    to = to or output_format(output, hint)
    of = of or format_of(str(path), hint)
    data = read_data(content, of, str(path), name or name_of(path))
    if name is not None:
        data["name"] = name
    from_data(data, str(path))  # Raise an error if the tableau is invalid.
    if as_json and to == "numpy" and output is None:
        raise click.UsageError(
            "the output of --json cannot contain a NumPy archive, because the archive is binary; give -o FILE"
        )
    converted = content if of == to == "toml" and name is None else export(data, to)
    if output is not None:
        put(output, converted)
    if not as_json:
        note_left_out(data, to)
    if as_json:
        text = None if to == "numpy" else converted.decode()
        record = {
            "name": data["name"],
            "from": of,
            "to": to,
            "left_out": list(left_out(data, to)),
            "path": output,
        }
        screen.print_json({**record, "tableau": text})
    elif output is None:
        sys.stdout.buffer.write(converted)
        sys.stdout.buffer.flush()
    return 0
