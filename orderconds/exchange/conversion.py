"""A tableau as text or bytes in one of the formats of :mod:`orderconds.exchange`."""

from __future__ import annotations

from os import PathLike

from orderconds.exchange import export
from orderconds.tableau import Tableau, dumps
from orderconds.tableau.write import as_data


def convert(tableau: Tableau | str | PathLike[str], to: str) -> str | bytes:
    """Return a tableau in the format ``to``: toml, json, csv, sympy, latex or c as text, numpy as bytes.

    ``tableau`` may also be a file or a name of the library. Raises :class:`~orderconds.errors.InputError` for an unknown format, and
    for a method that the format cannot represent.

    >>> print(convert("euler", "csv").splitlines()[-1])
    b,1
    """
    given = tableau if isinstance(tableau, Tableau) else Tableau.load(tableau)
    content = dumps(given).encode() if to == "toml" else export(as_data(given), to)
    try:
        return content.decode()
    except UnicodeDecodeError:
        return content
