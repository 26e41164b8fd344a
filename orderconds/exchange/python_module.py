"""Execute a Python module at the user's request, and read the arrays that the module assigns."""

from __future__ import annotations

import contextlib
import runpy
import sys
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, Arrays, from_arrays
from orderconds.exchange.nested import Cells
from orderconds.exchange.notation import from_python
from orderconds.tableau.doubles import double_text
from orderconds.tableau.file_format import Data


def execute(path: str | Path) -> Data:
    """Run a module that assigns a tableau, and return a dictionary with the keys of a tableau file.

    Text that the module prints goes to stderr. Raises :class:`~orderconds.errors.TableauError` if the module
    raises an error, ends the program, or assigns values that are not coefficients.

    >>> execute("/no/such/file.py")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    orderconds.errors.TableauError: /no/such/file.py: FileNotFoundError: ...; expected a module that runs ...
    """
    where = str(path)
    try:
        with contextlib.redirect_stdout(sys.stderr):
            assigned = runpy.run_path(where, run_name="<tableau>")
    except (Exception, SystemExit) as problem:
        raise TableauError(
            f"{type(problem).__name__}: {str(problem)[:200]}",
            where=where,
            expected="a module that runs without an error",
        ) from None
    return from_arrays(_arrays(assigned, where), where)


def _arrays(assigned: Mapping[str, object], where: str) -> Arrays:
    entries: Arrays = {}
    for name in (*MATRICES, *ROWS):
        value = assigned.get(name)
        if value is not None and not callable(value):
            cells = _cells(value, f"{where}: {name}")
            nested = isinstance(cells, list) and cells and isinstance(cells[0], list)
            entries[name] = cells[0] if name in ROWS and nested and len(cells) == 1 else cells
    for name in ("name", "family", "source", "base"):
        if isinstance(text := assigned.get(name), str):
            entries[name] = text
    for name in ("order", "embedded_order"):
        if type(number := assigned.get(name)) is int:
            entries[name] = str(number)
    claims = assigned.get("claims")
    if isinstance(claims, str):
        entries["claims"] = claims
    elif isinstance(claims, Mapping):
        entries["claims"] = ", ".join(f"{key}={str(x).lower()}" for key, x in claims.items())
    return entries


def _cells(value: object, where: str) -> Cells:
    """Return the text of a number, or nested lists of texts for an array.

    Raise TableauError for other values.
    """
    listed = getattr(value, "tolist", None)
    value = listed() if listed is not None else value
    if isinstance(value, list | tuple):
        return [_cells(x, where) for x in value]
    if isinstance(value, bool | complex):
        raise TableauError(f"the value {value}", where=where, expected="a real number")
    if isinstance(value, float):
        return double_text(value, where)
    if isinstance(value, int | Fraction | str):
        return str(value)
    if type(value).__module__.partition(".")[0] in ("sympy", "decimal"):
        return from_python(str(value)).replace(" ", "")
    raise TableauError(f"an object of type {type(value).__name__}", where=where, expected="a real number")
