"""A tableau as text or bytes in one of the formats of :mod:`orderconds.exchange`."""

from __future__ import annotations

from os import PathLike

from orderconds.exchange import export, json_file
from orderconds.tableau import Tableau, dumps
from orderconds.tableau.doubles import is_double
from orderconds.tableau.file_format import Data
from orderconds.tableau.write import as_data


def convert(tableau: Tableau | str | PathLike[str], to: str) -> str | bytes:
    """Return a tableau in the format ``to``: toml, json, csv, sympy, latex or c as text, numpy as bytes.

    ``tableau`` may also be a file or a name of the library. Raises :class:`~orderconds.errors.InputError` for
    an unknown format, and for a method that the format cannot represent.

    >>> print(convert("euler", "csv").splitlines()[-1])
    b,1
    """
    given = tableau if isinstance(tableau, Tableau) else Tableau.load(tableau)
    content = dumps(given).encode() if to == "toml" else export(as_data(given), to)
    if given.doubles and to == "json":
        content = json_file.write(_with_floats(as_data(given)))
    try:
        return content.decode()
    except UnicodeDecodeError:
        return content


def _with_floats(value: Data) -> Data:
    """Return the keys of a tableau file with floats in place of the texts of doubles; other programs expect
    numbers in JSON."""

    def converted(x: object) -> object:
        if isinstance(x, str):
            return float(x[:-1]) if is_double(x) else x
        if isinstance(x, list):
            return [converted(y) for y in x]
        return {key: converted(y) for key, y in x.items()} if isinstance(x, dict) else x

    return {key: converted(x) for key, x in value.items()}
