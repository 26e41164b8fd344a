"""CSV: each line consists of a name and an array, or of a name and one row of a matrix.

A plain Butcher tableau can be read as well. Each of its lines contains c_i and a row of A. A line that begins
with an empty cell contains b; a second such line contains the embedded weights. Blank cells elsewhere are
zeros.

Lines ``claims,rk=4`` or ``order,4`` state claims, also in a plain Butcher tableau. An embedded row has a line
``embedded_order,3``; without it the order of the row is computed.
"""

from __future__ import annotations

import csv
import io

from orderconds.errors import TableauError
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
    """Return the keys of a tableau file.

    >>> read(b"A,1/2\\nb,1\\n", "m.csv")
    {'family': 'rk', 'A': [['1/2']], 'b': ['1']}
    """
    try:
        rows = [
            row for row in csv.reader(io.StringIO(content.decode()), strict=True) if any(map(str.strip, row))
        ]
    except (csv.Error, UnicodeDecodeError) as problem:
        raise TableauError(str(problem), where=where, expected="CSV") from None
    entries: Arrays = {}
    if rows and not any(row[0].strip() in (*ROWS, *MATRICES) for row in rows):
        plain = [row for row in rows if row[0].strip() not in TEXTS]
        entries = _plain(plain, where) if plain else {}
        rows = [row for row in rows if row[0].strip() in TEXTS]
    for name, *cells in ([cell.strip() for cell in row] for row in rows):
        if name in TEXTS:
            if name in entries:
                raise TableauError(f"{name} twice", where=where, expected="it once")
            entries[name] = ",".join(filter(None, cells)) if name == "claims" else cells[0] if cells else ""
        elif name in MATRICES:
            entries.setdefault(name, []).append([coefficient(x) for x in cells])
        elif name in entries:
            raise TableauError(f"{name} twice", where=where, expected="it once")
        else:
            entries[name] = [coefficient(x) for x in cells]
    return from_arrays(entries, where)


def _plain(rows: list[list[str]], where: str) -> Arrays:
    """Return the arrays of a plain Butcher tableau: lines of c and A, then b."""
    stages = [[coefficient(x) for x in row] for row in rows if row[0].strip()]
    weights = [[coefficient(x) for x in row[1:]] for row in rows if not row[0].strip()]
    if not weights or len(weights) > 2:
        raise TableauError(
            f"{len(weights)} rows of weights",
            where=where,
            expected="lines c, a_1, ..., a_s, then one or two that begin with an empty cell: b, embedded b",
        )
    return butcher(stages, weights)
