"""Read text tables whose cells are separated by commas, semicolons or tabs."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass

DELIMITERS = (",", ";", "\t")
COMMENTS = ("#", "%")
"""The characters that begin a comment line, after optional blanks."""

_WORD = re.compile(r"[^\W\d][\w ()./^-]*")
_COLUMN_OF_TABLEAU = re.compile(r"[aA]\w*")


@dataclass(frozen=True)
class Rows:
    """The rows of a table, without the header. If the table has no header, ``header`` is empty.
    The cells contain no blanks at their beginning or end."""

    rows: tuple[tuple[str, ...], ...]
    header: tuple[str, ...] = ()

    @property
    def plainly_other(self) -> bool:
        """True if the table has a header whose first cell is not ``c``. Such a table is not a tableau."""
        return bool(self.header) and self.header[0] != "c"


def read(text: str, names: tuple[str, ...]) -> Rows:
    """Return the rows of a table.

    The delimiter is the comma, the semicolon or the tab, whichever occurs in the most lines. The first row
    is a header in two cases, otherwise it contains data:

    - The first cell is ``c``, and the other cells begin with ``a``: ``c,a1,a2``. This is the header of a
      tableau.
    - There are at least two cells. Each non-empty cell begins with a letter and contains only letters,
      digits, blanks and ``_()./^-``, for example ``time (s)``. The first cell is not in ``names``, the list
      of array names. This is the header of a table that is not a tableau.

    Raises :class:`csv.Error` for misplaced or unmatched quotation marks.

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
    # A line inside a quoted cell may begin with #. Such a line is not a comment.
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
