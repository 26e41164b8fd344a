"""CSV: one array a line, or a line a row of a matrix, its name first; a plain Butcher tableau reads as well.

A plain one has c and a row of A in each line, then b after an empty cell, and after another the embedded
weights; a blank cell elsewhere is a zero.
"""

from __future__ import annotations

import csv
import io
from typing import Any

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, arrays, butcher, coefficient, data_of


def write(data: Any) -> bytes:
    """Return CSV text with exact coefficients.

    >>> write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()
    ['name,m', 'family,rk', 'A,1/2', 'b,1']
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for name, value in arrays(data, "CSV").items():
        for row in value if name in MATRICES else [value] if name in ROWS else [[value]]:
            writer.writerow([name, *row])
    return text.getvalue().encode()


def read(content: bytes, where: str) -> dict[str, Any]:
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
    known = {*TEXTS, *ROWS, *MATRICES}
    if rows and not any(row[0].strip() in known for row in rows):
        return _plain(rows, where)
    found: Arrays = {}
    for name, *cells in ([cell.strip() for cell in row] for row in rows):
        if name in TEXTS:
            found[name] = cells[0] if cells else ""
        elif name in MATRICES:
            found.setdefault(name, []).append([coefficient(x) for x in cells])
        elif name in found:
            raise TableauError(f"{name} twice", where=where, expected="it once")
        else:
            found[name] = [coefficient(x) for x in cells]
    return data_of(found, where)


def _plain(rows: list[list[str]], where: str) -> dict[str, Any]:
    """Read c | A over b."""
    stages = [[coefficient(x) for x in row] for row in rows if row[0].strip()]
    weights = [[coefficient(x) for x in row[1:]] for row in rows if not row[0].strip()]
    if not weights or len(weights) > 2:
        raise TableauError(
            f"{len(weights)} rows of weights",
            where=where,
            expected="lines c, a_1, ..., a_s, then one or two that begin with an empty cell: b, embedded b",
        )
    return data_of(butcher(stages, weights), where)
