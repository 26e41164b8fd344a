"""Convert a tableau to text or bytes in one of the formats of :mod:`orderconds.exchange`."""

from __future__ import annotations

import re
import warnings
from os import PathLike

from orderconds.exchange import export, json_file, left_out
from orderconds.tableau import Tableau, dumps
from orderconds.tableau.file_format import Data
from orderconds.tableau.write import as_data

_DECIMAL = re.compile(r"-?\d+\.?\d*d?", re.ASCII)
"""The pattern of an integer, a decimal or a double (suffix ``d``)."""


def convert(tableau: Tableau | str | PathLike[str], to: str) -> str | bytes:
    """Return a tableau in the format ``to``: toml, json, csv, sympy, latex, c or numpy.

    The result is bytes only for the format numpy. ``tableau`` may also be the path of a file, or the name of
    a tableau in the library. Raises :class:`~orderconds.errors.InputError` for an unknown format, and for a
    method that the format cannot represent.

    All formats except toml and json omit the proof and the continuous extension (the keys ``proof`` and
    ``dense``). A UserWarning names the omitted keys.

    >>> print(convert("euler", "csv").splitlines()[-1])
    b,1
    """
    given = tableau if isinstance(tableau, Tableau) else Tableau.load(tableau)
    data = as_data(given)
    content = dumps(given).encode() if to == "toml" else export(data, to)
    if given.doubles and to == "json":
        content = json_file.write(_with_floats(data))
    if keys := left_out(data, to):
        warnings.warn(
            f"{given.name}: the format {to} cannot contain the keys {', '.join(keys)}; json and toml can",
            stacklevel=2,
        )
    try:
        return content.decode()
    except UnicodeDecodeError:
        return content


def _with_floats(data: Data) -> Data:
    """Copy ``data``. In lists and tables, strings such as '1', '0.5' and '0.5d' become floats. The suffix d
    marks a double."""

    def number(x: object) -> object:
        if isinstance(x, list):
            return [number(y) for y in x]
        if isinstance(x, dict):
            return {key: number(y) for key, y in x.items()}
        return float(x.removesuffix("d")) if isinstance(x, str) and _DECIMAL.fullmatch(x) else x

    return {key: number(x) if isinstance(x, list | dict) else x for key, x in data.items()}
