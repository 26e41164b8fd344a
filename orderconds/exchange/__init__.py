"""Read and write tableaux in the formats of other programs: JSON, CSV, NumPy, SymPy, LaTeX, C arrays.

A Python file is executed only at the user's request. If a method is exported and imported again, its
coefficients do not change. TOML and JSON can contain every key of a tableau. The other formats omit the
tables ``[proof]`` and ``[dense]`` (:func:`left_out`).

A number from another program is a double, a rounded decimal or exact:

- A short binary fraction in a NumPy archive, for example 0.375, is exact. All other floats in the archive
  are doubles.
- A decimal that was probably printed from a double is a double, for example 0.3333333333333333.
- Other decimals with at least 12 significant digits are rounded (suffix ``~``).
- Shorter decimals are exact.
"""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from typing import Protocol, cast

from orderconds.errors import InputError
from orderconds.tableau import Claims, Tableau
from orderconds.tableau.comparison import equal_coefficients, equal_extensions
from orderconds.tableau.file import MAX_NAME, bytes_of
from orderconds.tableau.file_format import Data
from orderconds.tableau.record import from_data

FORMATS = {
    "toml": ("orderconds.exchange.toml_file", ".toml"),
    "json": ("orderconds.exchange.json_file", ".json"),
    "csv": ("orderconds.exchange.csv_table", ".csv"),
    "numpy": ("orderconds.exchange.numpy_archive", ".npz"),
    "sympy": ("orderconds.exchange.sympy_source", ".py"),
    "latex": ("orderconds.exchange.latex_array", ".tex"),
    "c": ("orderconds.exchange.c_arrays", ".c"),
}
"""For each format, the module that reads and writes the files, and the suffix of the files."""

COMPLETE = ("toml", "json")
"""The formats that can contain every key of a tableau."""


def export(data: Data, to: str) -> bytes:
    """Return a tableau as the content of a file in the format ``to``.

    Raises :class:`~orderconds.errors.InputError` for an unknown format, and for a method that the format
    cannot represent.

    >>> export({"name": "euler", "family": "rk", "A": [["0"]], "b": ["1"]}, "csv").decode().split()
    ['name,euler', 'family,rk', 'A,0', 'b,1']
    """
    content = _module(to).write(data)
    back = read_data(content, to, f"the output in format {to}", str(data.get("name")))
    _require_same(from_data(data), from_data(back), to)
    return content


def _require_same(given: Tableau, back: Tableau, to: str) -> None:
    """Raise InputError if ``back``, the tableau that was read from the output, differs from ``given``."""
    same = (given.family, given.source, given.bibtex) == (back.family, back.source, back.bibtex)
    same &= _comparable(given.claims) == _comparable(back.claims)
    if can_contain("dense", to):
        same &= equal_extensions(given, back)
    if can_contain("proof", to):
        same &= (given.proof is None) == (back.proof is None)
    if not (same and equal_coefficients(given, back)):
        raise InputError(
            f"format {to} cannot represent this tableau: reading the output gives a different tableau",
            where=given.name,
            expected="a format that can represent the tableau, such as json",
        )


def _comparable(claims: Claims) -> tuple[dict[str, int], dict[str, bool]]:
    """Return claims in a form that does not depend on their sequence in a file."""
    return {claim.label: claim.order for claim in claims.orders}, dict(claims.properties)


def read_data(content: bytes, of: str, where: str, name: str = "imported") -> Data:
    """Return the keys and values of the tableau in a file of the format ``of``.

    If the file contains no name, the tableau gets the name ``name``. If the file contains embedded weights
    without their order, this function computes the order. Raises :class:`~orderconds.errors.InputError` if
    the content cannot be read. The error message contains the text ``where``, usually the path of the file.

    >>> read_data(b"0,0\\n,1\\n", "csv", "euler.csv", name="euler")
    {'name': 'euler', 'family': 'rk', 'A': [['0']], 'b': ['1'], 'c': ['0']}
    """
    data = _module(of).read(content, where)
    return data if of == "toml" else _completed(data, where, name)


def _completed(data: Data, where: str, name: str) -> Data:
    """If the file states no name, add ``name``. If the file contains embedded weights without their order,
    compute the order and add it."""
    data = {"name": name, **data}
    embedded = data.get("embedded")
    if isinstance(embedded, dict) and "b" in embedded and "order" not in embedded:
        embedded["order"] = 1
        lower = from_data(data, where).lower()
        embedded["order"] = max(1, order_on_vector_spaces(lower)) if lower else 1
    return data


def order_on_vector_spaces(tableau: Tableau) -> int:
    """Return the classical order of a method, that is, its order on vector spaces.

    >>> order_on_vector_spaces(Tableau.load("cg4"))
    4
    """
    from orderconds.checking import family_order
    from orderconds.families import get

    return family_order(tableau, get("rk")).order


PYTHON = "sympy"
"""The name of the format of Python modules. The exported modules import SymPy."""


def load_foreign(path: str | Path, *, execute: bool = False) -> Tableau | None:
    """Return the tableau in a file. Return None for the suffix ``.toml`` and for an unknown suffix.

    A tableau without a name is named after the file. If ``execute`` is true, a Python module is executed, not
    only parsed.

    >>> load_foreign("rk4.toml") is None
    True
    """
    of = find_format(str(path))
    if of in (None, "toml"):
        return None
    if execute and of == PYTHON:
        from orderconds.exchange.python_module import execute as run

        data = _completed(run(path), str(path), name_of(path))
    else:
        data = read_data(bytes_of(path), of, str(path), name_of(path))
    return from_data(data, str(path), str(path))


def name_of(path: str | Path) -> str:
    """Return a tableau name computed from a path.

    >>> name_of("my files/my method (2).csv")
    'my_method_2'
    """
    return re.sub(r"[^A-Za-z0-9.+-]+", "_", Path(path).stem).strip("_.+-")[:MAX_NAME] or "imported"


def left_out(data: Data, to: str) -> tuple[str, ...]:
    """Return the keys of ``data`` that a file in the format ``to`` cannot contain. Keys with empty values are
    ignored.

    >>> left_out({"name": "m", "proof": {"conditions": "cg"}}, "csv")
    ('proof',)
    """
    return tuple(key for key, value in data.items() if value and not can_contain(key, to))


def can_contain(key: str, to: str) -> bool:
    """Return True if files in the format ``to`` can contain the value of the key ``key`` of a tableau.

    The value may be written in another form. For example, a CSV file contains the coefficients that follow
    from the value of ``low_storage``.

    >>> can_contain("dense", "json"), can_contain("dense", "csv")
    (True, False)
    """
    if to in COMPLETE:
        return True
    from orderconds.exchange.arrays import KEYS

    return key in KEYS


def format_of(path: str, hint: str = "") -> str:
    """Return the format that the suffix of a file indicates. Raise InputError for an unknown suffix. The
    message contains ``hint``.

    >>> format_of("rk4.h")
    'c'
    """
    if (name := find_format(path)) is not None:
        return name
    raise InputError(
        f"a file with an unknown suffix: {path}",
        expected=f"one of {', '.join(suffix for _, suffix in FORMATS.values())}, .h",
        hint=hint,
    )


def find_format(path: str) -> str | None:
    """Return the format that the suffix of a file indicates, or None for an unknown suffix.

    >>> find_format("rk4.npz"), find_format("rk4.txt")
    ('numpy', None)
    """
    for name, (_, suffix) in FORMATS.items():
        if path.endswith(suffix) or (name == "c" and path.endswith(".h")):
            return name
    return None


class _Format(Protocol):
    """A module that reads and writes one file format."""

    def write(self, data: Data) -> bytes: ...

    def read(self, content: bytes, where: str) -> Data: ...


def _module(name: str) -> _Format:
    if name not in FORMATS:
        raise InputError(f"unknown format {name!r}", expected=f"one of {', '.join(FORMATS)}")
    return cast("_Format", import_module(FORMATS[name][0]))
