"""The output of commands as JSON or as tables."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from orderconds.exit_status import current_run

if TYPE_CHECKING:
    from orderconds.explain.lines import Style


def is_terminal() -> bool:
    """Return True if standard output is a terminal.

    >>> isinstance(is_terminal(), bool)
    True
    """
    return sys.stdout.isatty()


def drawing_style(plain: bool = False) -> Style:
    """Return the style of tree drawings: Unicode or ASCII.

    ASCII is used if ``plain`` is true, or if the encoding of the output lacks the Unicode characters.

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
    """Return a context manager that shows a message.

    After ``with working(...) as show``, the call ``show(text)`` replaces the message. Without a terminal,
    messages are shown only with ``--verbose``, as lines on stderr.

    >>> with working("deriving"):
    ...     order = 4
    ...
    """
    if not _on_terminal():
        lines = _Lines()
        lines.show(message)
        yield lines.show
        return
    from rich.console import Console

    with Console(stderr=True, highlight=False, markup=False).status(message) as status:
        yield status.update


@contextmanager
def counting(message: str, total: int | None = None) -> Iterator[Callable[[str], object]]:
    """Return a context manager that shows the progress of work on several items.

    Inside the block ``with counting(...) as done``, call ``done(name)`` after each item. ``total`` is the
    number of items, or None if this number is unknown.
    Without a terminal, progress is shown only with ``--verbose``, as lines on stderr.

    >>> with counting("measuring", total=2) as done:
    ...     _ = done("first")
    ...
    """
    if not _on_terminal():
        lines = _Lines(total)
        lines.show(message)
        yield lines.finish
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        Progress,
        SpinnerColumn,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    known = "" if total is None else " of {task.total:.0f}"
    console = Console(stderr=True, highlight=False, markup=False)
    with Progress(
        SpinnerColumn(),
        TextColumn("{task.description}"),
        *([] if total is None else [BarColumn(20)]),
        TextColumn("{task.completed:.0f}" + (known or " done")),
        TimeElapsedColumn(),
        *([] if total is None else [TextColumn("remaining"), TimeRemainingColumn()]),
        console=console,
        transient=True,
    ) as progress:
        task = progress.add_task(message, total=total)
        yield lambda text: progress.update(task, advance=1, description=text)


def _on_terminal() -> bool:
    """Return True if progress may be drawn: stdout and stderr are terminals, and ``--quiet`` is not given."""
    return is_terminal() and sys.stderr.isatty() and not current_run().quiet


class _Lines:
    """Writes the progress of work as lines to stderr, but only with ``--verbose``.

    ``total`` is the number of items of the work, or None if this number is unknown.
    """

    def __init__(self, total: int | None = None) -> None:
        self.total, self.finished, self.begin = total, 0, time.monotonic()

    def show(self, text: str) -> None:
        """Write the elapsed time and ``text`` in one line."""
        if current_run().verbose:
            click.echo(f"{time.monotonic() - self.begin:7.1f} s  {text}", err=True)

    def finish(self, text: str) -> None:
        """Count one finished item, and write a line. ``text`` is the name of the item."""
        self.finished += 1
        if self.total is None:
            self.show(f"{self.finished}  {text}")
            return
        rest = (time.monotonic() - self.begin) / self.finished * max(0, self.total - self.finished)
        self.show(f"{self.finished} of {self.total}, {rest:.1f} s remaining  {text}")


def is_shown(held: bool) -> bool:
    """Return True if a result is to be printed.

    ``held`` is True if the result is a success. With ``--quiet``, only failures are printed.

    >>> is_shown(held=True), is_shown(held=False)
    (True, True)
    """
    return not (held and current_run().quiet)


def print_json(value: object) -> None:
    """Print one JSON document, indented and in ASCII.

    >>> print_json({"order": 4})
    {
      "order": 4
    }
    """
    current_run().print_document(value)


def print_table(columns: Sequence[str], rows: Sequence[Sequence[str]], indent: int = 0) -> None:
    """Print rows below the headings of the columns. The widest entry determines the width of a column.

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
    """Return the lines of a table in plain text. Two spaces separate the columns.

    >>> plain_table(["family", "order"], [["rk", "4"], ["rkmk(1)", "3"]])
    ['family   order', 'rk       4', 'rkmk(1)  3']
    """
    lines = [list(columns), *map(list, rows)]
    widths = [max(len(line[k]) for line in lines) for k in range(len(columns))]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    ]
