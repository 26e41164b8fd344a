"""A tableau as text or bytes in one of the formats of :mod:`orderconds.exchange`."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike

from orderconds.exchange import export
from orderconds.tableau import Tableau, dumps
from orderconds.tableau.doubles import decimal_text, is_double
from orderconds.tableau.write import as_data


NUMBERS: dict[str, Callable[[str], object]] = {"csv": decimal_text, "json": lambda text: float(text[:-1])}
"""For each format that other programs read, a function from the text of a double to its number there."""


def convert(tableau: Tableau | str | PathLike[str], to: str) -> str | bytes:
    """Return a tableau in the format ``to``: toml, json, csv, sympy, latex or c as text, numpy as bytes.

    ``tableau`` may also be a file or a name of the library. Raises :class:`~orderconds.errors.InputError` for an unknown format, and
    for a method that the format cannot represent.

    >>> print(convert("euler", "csv").splitlines()[-1])
    b,1
    """
    given = tableau if isinstance(tableau, Tableau) else Tableau.load(tableau)
    data = as_data(given)
    if given.doubles and to in NUMBERS:
        data = {key: _with_numbers(value, NUMBERS[to]) for key, value in data.items()}
    content = dumps(given).encode() if to == "toml" else export(data, to)
    try:
        return content.decode()
    except UnicodeDecodeError:
        return content


def _with_numbers(value: object, number: Callable[[str], object]) -> object:
    """Return a value of a tableau file in which numbers replace the texts of doubles."""
    if isinstance(value, str):
        return number(value) if is_double(value) else value
    if isinstance(value, list):
        return [_with_numbers(x, number) for x in value]
    if isinstance(value, dict):
        return {key: _with_numbers(x, number) for key, x in value.items()}
    return value
