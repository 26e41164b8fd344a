"""A tableau as text or bytes in one of the formats of :mod:`orderconds.exchange`."""

from __future__ import annotations

from os import PathLike

from orderconds.exchange import export
from orderconds.tableau import Tableau, dumps
from orderconds.tableau.doubles import decimal_text, is_double
from orderconds.tableau.write import as_data


def convert(tableau: Tableau | str | PathLike[str], to: str) -> str | bytes:
    """Return a tableau in the format ``to``: toml, json, csv, sympy, latex or c as text, numpy as bytes.

    ``tableau`` may also be a file or a name of the library. Doubles are written as decimals, except in toml,
    which keeps their exact values. Raises :class:`~orderconds.errors.InputError` for an unknown format, and
    for a method that the format cannot represent.

    >>> print(convert("euler", "csv").splitlines()[-1])
    b,1
    """
    given = tableau if isinstance(tableau, Tableau) else Tableau.load(tableau)
    data = as_data(given)
    if given.doubles:
        exact = to == "toml"
        data = {key: value if exact else _with_decimals(value) for key, value in data.items()}
    content = dumps(given).encode() if to == "toml" else export(data, to)
    try:
        return content if content.startswith(b"PK") else content.decode()
    except UnicodeDecodeError:
        return content


def _with_decimals(value: object) -> object:
    """Return a value of a tableau file in which decimals replace doubles."""
    if isinstance(value, str):
        return decimal_text(value) + "~" if is_double(value) else value
    if isinstance(value, list):
        return [_with_decimals(x) for x in value]
    if isinstance(value, dict):
        return {key: _with_decimals(x) for key, x in value.items()}
    return value
