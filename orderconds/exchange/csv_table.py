"""CSV tables, in one of two forms:

- Named arrays: each line begins with the name of a vector or a matrix. The other cells of the line contain
  the vector or one row of the matrix.
- A plain Butcher tableau: for each stage i, one line contains c_i and row i of A. The next line contains an
  empty cell and the weights b. An additional line may contain an empty cell and embedded weights. Other
  empty cells are zeros.

Cells are separated by commas, semicolons or tabs. Comments (``#`` or ``%``) and a header are ignored.

The line ``order,4`` claims order 4 in the family of the tableau. The line ``claims,rk=4`` claims order 4 in
the family ``rk``.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from orderconds.errors import TableauError
from orderconds.exchange import rows
from orderconds.exchange.arrays import (
    MATRICES,
    ROWS,
    TEXTS,
    Arrays,
    butcher,
    coefficient,
    from_arrays,
    to_arrays,
)
from orderconds.tableau.file_format import Data

NAMES = (*TEXTS, *ROWS, *MATRICES)
"""The names that the first cell of a CSV line can contain."""
WEIGHTS = ("b", "embedded_b")
"""In a plain Butcher tableau, a line of weights begins with a name in WEIGHTS or with an empty cell."""

Table = tuple[tuple[str, ...], ...]


def write(data: Data) -> bytes:
    """Return CSV text with exact coefficients.

    >>> write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()
    ['name,m', 'family,rk', 'A,1/2', 'b,1']
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for name, value in to_arrays(data, "CSV").items():
        for row in value if name in MATRICES else [value] if name in ROWS else [[value]]:
            writer.writerow([name, *row])
    return text.getvalue().encode()


def read(content: bytes, where: str) -> Data:
    """Return the keys and values of the tableau file that the CSV text represents.

    >>> read(b"A,1/2\\nb,1\\n", "m.csv")
    {'family': 'rk', 'A': [['1/2']], 'b': ['1']}
    """
    try:
        table = rows.read(content.decode(), NAMES).rows
    except (csv.Error, UnicodeDecodeError) as problem:
        raise TableauError(str(problem), where=where, expected="CSV") from None
    entries: Arrays = {}
    if table and _is_plain(table):
        plain = [row for row in table if row[0] not in TEXTS]
        entries = _plain(plain, where)
        table = tuple(row for row in table if row[0] in TEXTS)
    for name, *cells in table:
        if name in TEXTS:
            if name in entries:
                raise _repeated(name, where)
            entries[name] = ",".join(filter(None, cells)) if name == "claims" else cells[0] if cells else ""
        elif name in MATRICES:
            entries.setdefault(name, []).append([coefficient(x) for x in cells])
        elif name in entries:
            raise _repeated(name, where)
        else:
            entries[name] = [coefficient(x) for x in cells]
    return from_arrays(entries, where)


def _repeated(name: str, where: str) -> TableauError:
    return TableauError(
        f"two rows begin with {name}", where=where, expected=f"one row that begins with {name}"
    )


def _is_plain(table: Table) -> bool:
    """Return True if a CSV table is a plain Butcher tableau."""
    first = [row[0] for row in table]
    return not any(name in MATRICES for name in first) and any(name not in NAMES for name in first)


def _plain(table: Sequence[tuple[str, ...]], where: str) -> Arrays:
    """Return the arrays of a plain Butcher tableau.

    Raise TableauError if the number of lines of weights is neither 1 nor 2.
    """
    stages = [[coefficient(x) for x in row] for row in table if row[0] and row[0] not in WEIGHTS]
    weights = [[coefficient(x) for x in row[1:]] for row in table if not row[0] or row[0] in WEIGHTS]
    if not weights or len(weights) > 2:
        raise TableauError(
            f"{len(weights)} rows of weights",
            where=where,
            expected="one line with c_i and row i of A for each stage, then a line with the weights b, "
            "then at most one line with embedded weights; lines of weights begin with an empty cell",
        )
    return butcher(stages, weights)
