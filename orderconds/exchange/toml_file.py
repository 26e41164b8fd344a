"""The project's own tableau files, in TOML. The keys are written in a fixed order."""

from __future__ import annotations

from orderconds.errors import TableauError
from orderconds.tableau import dumps
from orderconds.tableau.file_format import Data
from orderconds.tableau.record import from_data
from orderconds.tableau.toml_reader import parse_toml


def write(data: Data) -> bytes:
    """Return the keys and values of a tableau file as TOML text.

    >>> write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()[-1]
    'b = ["1"]'
    """
    return dumps(from_data(data)).encode()


def read(content: bytes, where: str) -> Data:
    """Return the keys and values of TOML text.

    >>> read(b'name = "m"', "m.toml")
    {'name': 'm'}
    """
    try:
        return parse_toml(content.decode())
    except (ValueError, RecursionError) as problem:  # Invalid UTF-8 raises a ValueError.
        raise TableauError(str(problem) or "nested too deep", where=where, expected="TOML") from None
