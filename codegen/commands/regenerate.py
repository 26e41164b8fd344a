"""``orderconds regenerate``: emit all modules of ``regenerate.toml`` into the folder ``generated/``.

With ``--check``, the command only compares the emitted files with the files of the folder.
"""

from __future__ import annotations

from pathlib import Path

import click

from orderconds.commands import screen
from orderconds.commands.place import FOLDER


@click.command(name="regenerate", short_help="Rewrite generated/, or compare it with newly emitted files.")
@click.option(
    "--check",
    "check_only",
    is_flag=True,
    help="Change nothing. If the folder and the newly emitted files differ, the exit status is 1.",
)
@click.option(
    "--output",
    "-o",
    type=FOLDER,
    metavar="DIR",
    help="The folder of the emitted modules; by default generated/ in the source tree.",
)
@click.option("--list", "listing", metavar="FILE", help="The list of modules, by default regenerate.toml.")
@click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")
def command(check_only: bool, output: str | None, listing: str | None, as_json: bool) -> int:
    """Rewrite the emitted modules that regenerate.toml lists. With --check, report the files that differ.

    An emitted file is stale if regenerate.toml no longer lists its module. Stale files are reported and,
    without --check, removed. Files that the program did not emit are reported as unknown.

    \b
    Examples:
        orderconds regenerate --check
    """
    from codegen.regenerate import LIST, compare, contents, entries, write

    directory = Path(output) if output is not None else source_folder()
    files = contents(entries(Path(listing) if listing is not None else LIST))
    differences = compare(directory, files) if check_only else write(directory, files)
    if as_json:
        screen.print_json(
            {
                "directory": str(directory),
                "files": len(files),
                "differences": [{"file": d.path, "kind": d.kind} for d in differences],
            }
        )
    else:
        for difference in differences:
            click.echo(f"{directory / difference.path}: {difference.kind}")
        if check_only:
            hint = "; type: orderconds regenerate" if differences else ""
            click.echo(f"{len(differences)} differences, {len(files)} files expected{hint}")
        else:
            written = sum(d.path in files for d in differences)
            click.echo(f"{written} of {len(files)} files rewritten in {directory}")
    return 1 if check_only and differences else 0


def source_folder() -> Path:
    """Return the folder ``generated/`` of the source tree that contains this package.

    If this package is not in a source tree, a usage error is raised.
    """
    root = Path(__file__).resolve().parents[2]
    pyproject = root / "pyproject.toml"
    if pyproject.is_file() and 'name = "orderconds"' in pyproject.read_text(encoding="utf-8").splitlines():
        return root / "generated"
    raise click.UsageError(
        "this copy of orderconds is not in a source tree; name the output folder with the option -o"
    )
