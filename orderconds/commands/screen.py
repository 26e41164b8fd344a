"""The output of commands: JSON for machines, tables with rich on a terminal, plain columns elsewhere."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from orderconds.exit_status import current_run

if TYPE_CHECKING:
    from orderconds.explain.lines import Style


def is_terminal() -> bool:
    """Whether stdout is a terminal; only then is there colour and a progress line.

    >>> isinstance(is_terminal(), bool)
    True
    """
    return sys.stdout.isatty()


def drawing_style(plain: bool = False) -> Style:
    """Return the style of tree drawings on stdout: Unicode, or ASCII if requested or if the encoding requires
    it.

    >>> drawing_style(plain=True).signs["dot"]
    'o'
    """
    from orderconds.explain import lines

    try:
        "".join([*lines.UNICODE.signs.values(), *lines.UNICODE.edges.values()]).encode(
            getattr(sys.stdout, "encoding", None) or "ascii"
        )
    except UnicodeEncodeError:
        return lines.ASCII
    return lines.ASCII if plain else lines.UNICODE


@contextmanager
def working(message: str) -> Iterator[Callable[[str], object]]:
    """Show a message on a terminal during the work; show nothing elsewhere. The result is a function that
    changes the message.

    >>> with working("deriving"):
    ...     order = 4
    ...
    """
    if not (is_terminal() and sys.stderr.isatty()):
        yield str
        return
    from rich.console import Console

    with Console(stderr=True, highlight=False, markup=False).status(message) as status:
        yield status.update


@contextmanager
def counting(message: str) -> Iterator[Callable[[str], object]]:
    """Show a progress bar on a terminal; show nothing elsewhere. The result is a function, to be called with
    the name of each finished item. If the total is unknown, the items are counted.

    >>> with counting("measuring") as done:
    ...     _ = done("first")
    ...
    """
    if not (is_terminal() and sys.stderr.isatty()):
        yield str
        return
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}"), TextColumn("{task.completed:.0f} done"))
    console = Console(stderr=True, highlight=False, markup=False)
    with Progress(*columns, TimeElapsedColumn(), console=console, transient=True) as progress:
        task = progress.add_task(message, total=None)
        yield lambda text: progress.update(task, advance=1, description=text)


def print_json(value: object) -> None:
    """Print one JSON document: indented, with keys in their given order, ASCII only.

    >>> print_json({"order": 4})
    {
      "order": 4
    }
    """
    current_run().print_document(value)


def print_table(columns: Sequence[str], rows: Sequence[Sequence[str]], indent: int = 0) -> None:
    """Print rows under column heads; the columns are as wide as their widest entry.

    >>> print_table(["family", "order"], [["rk", "4"]])
    family  order
    rk      4
    """
    if is_terminal():
        # The import of rich is slow, so rich is imported only for output to a terminal.
        from rich.console import Console
        from rich.padding import Padding
        from rich.table import Table

        table = Table(*columns, box=None, pad_edge=False, header_style="bold")
        for row in rows:
            table.add_row(*row)
        Console(highlight=False, markup=False).print(Padding(table, (0, 0, 0, indent)))
        return
    for line in plain_table(columns, rows):
        click.echo(" " * indent + line)


def plain_table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of a table in plain columns two spaces apart.

    >>> plain_table(["family", "order"], [["rk", "4"], ["rkmk(1)", "3"]])
    ['family   order', 'rk       4', 'rkmk(1)  3']
    """
    lines = [list(columns), *map(list, rows)]
    widths = [max(len(line[k]) for line in lines) for k in range(len(columns))]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    ]
