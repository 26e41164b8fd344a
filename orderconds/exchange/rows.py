"""Read text tables whose cells are separated by commas, semicolons or tabs."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass

DELIMITERS = (",", ";", "\t")
COMMENTS = ("#", "%")
"""A line that begins with one of these characters is a comment."""

_WORD = re.compile(r"[^\W\d][\w ()./^-]*")
_COLUMN_OF_TABLEAU = re.compile(r"[aA]\w*")


@dataclass(frozen=True)
class Rows:
    """The rows of a table, and its header if there is one. Blanks at the begin and at the end of a cell
    are removed."""

    rows: tuple[tuple[str, ...], ...]
    header: tuple[str, ...] = ()

    @property
    def plainly_other(self) -> bool:
        """True if the first cell of the header is not ``c``. Such a table is certainly not a tableau."""
        return bool(self.header) and self.header[0] != "c"


def read(text: str, names: tuple[str, ...]) -> Rows:
    """Return the rows of a table.

    The delimiter is the character (comma, semicolon or tab) that occurs in the most lines. The first row may
    be a header. A first row that begins with ``c`` is a header if its other cells are names of columns:
    ``c,a1,a2``. Any other first row is a header if all its cells are words and its first cell is
    not one of ``names``. Raises :class:`csv.Error` for misplaced or unmatched quotation marks.

    >>> read("# Heun\\nc;a1;a2\\n0;0;0\\n1;1;0\\n;1/2;1/2\\n", ("c",)).rows
    (('0', '0', '0'), ('1', '1', '0'), ('', '1/2', '1/2'))
    >>> read("c,1/2\\n", ("c",)).header
    ()
    """
    text = text.removeprefix("\ufeff")
    lines = [line for line in text.splitlines() if not _is_comment(line)]
    delimiter = max(DELIMITERS, key=lambda mark: sum(mark in line for line in lines))
    table = csv.reader(io.StringIO(text), delimiter=delimiter, strict=True)
    rows = [tuple(cell.strip() for cell in row) for row in table]
    # Comments are removed after the text has been divided into cells, because a line within a quoted cell may
    # begin with #.
    rows = [row for row in rows if any(row) and not _is_comment(row[0])]
    if rows and _is_header(rows[0], names):
        return Rows(tuple(rows[1:]), rows[0])
    return Rows(tuple(rows))


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith(COMMENTS)


def _is_header(row: tuple[str, ...], names: tuple[str, ...]) -> bool:
    cells = [cell for cell in row if cell]
    if row[0] == "c":
        return len(cells) > 1 and all(_COLUMN_OF_TABLEAU.fullmatch(cell) for cell in cells[1:])
    return row[0] not in names and len(row) > 1 and all(_WORD.fullmatch(cell) for cell in cells)
