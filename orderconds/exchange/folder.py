"""Find the tableau files in a folder."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from orderconds.errors import InputError
from orderconds.exchange import FORMATS, csv_table, find_format, rows
from orderconds.exchange.arrays import MATRICES, ROWS
from orderconds.tableau.file import KEYS, bytes_of, meant_as_tableau

SUFFIXES = tuple(dict.fromkeys((*(suffix for _, suffix in FORMATS.values()), ".h")))
"""The suffixes of files that may contain a tableau."""

EXCUSES = "DECIMAL"
"""The name of a text file in a folder. The file lists tableaux. For these tableaux,
``orderconds check --certified`` requires no proof of the order."""

NO_KEY = "contains no key of a tableau, such as family, A or b"
_ARRAY = re.compile(r"(?<!\w)(?:\w+_)?(?:A|gamma|alpha|exponentials)\s*(?:\[[^\]]*\]\s*){1,2}=", re.ASCII)
_LATEX = re.compile(
    r"\\begin\{array\}\s*\{\s*[lcr]\s*\||(?:A|gamma|alpha|exponentials)\s*=\s*\\begin\{[bp]matrix"
)


@dataclass
class Folder:
    """The files below a folder.

    ``tableaux`` contains the paths of the tableau files. ``skipped`` contains a pair (path, reason) for each
    file that :func:`reason_to_skip` rejects.
    """

    tableaux: list[str] = field(default_factory=list)
    skipped: list[tuple[str, str]] = field(default_factory=list)
    others: list[str] = field(default_factory=list)
    """Names of hidden folders, and names of files with an unknown suffix."""


def scan(folder: str | Path, *, strict: bool = False) -> Folder:
    """Return the files below a folder, sorted by path. Hidden folders are not searched.

    If ``strict`` is true, the field ``tableaux`` of the result also contains files that only resemble a
    tableau (see :func:`reason_to_skip`).

    >>> from orderconds.tableau.library import root
    >>> files = scan(root())
    >>> len(files.tableaux) > 100, files.skipped, "sources.bib" in files.others
    (True, [], True)
    """
    files = Folder()
    for path in _files(Path(folder), files.others):
        if path.suffix not in SUFFIXES:
            if path.name != EXCUSES:
                files.others.append(path.name)
        elif reason := reason_to_skip(path, strict=strict):
            files.skipped.append((str(path), reason))
        else:
            files.tableaux.append(str(path))
    return files


def _files(folder: Path, hidden: list[str]) -> Iterator[Path]:
    paths: list[Path] = []
    for place, folders, names in os.walk(folder):
        hidden += sorted(f"{name}/" for name in folders if _is_hidden(name))
        folders[:] = sorted(name for name in folders if not _is_hidden(name))
        paths += [Path(place, name) for name in names]
    yield from sorted(paths)


def _is_hidden(name: str) -> bool:
    return name.startswith(".") or name == "__pycache__"


@dataclass(frozen=True)
class Reason:
    """The reason to skip a file. ``plain`` is true if nothing in the file resembles a tableau."""

    text: str
    plain: bool = True


def reason_to_skip(path: str | Path, *, strict: bool = False) -> str:
    """Return the reason to skip a file, or an empty text if the file must be read.

    Damaged files are not skipped, so that the user sees an error message. If ``strict`` is true, a file that
    resembles a tableau must be read, too, for example a JSON file with a matrix.

    >>> from orderconds.tableau import find
    >>> from orderconds.tableau.library import root
    >>> reason_to_skip(find("rk4")), reason_to_skip(root().parent / "pyproject.toml")
    ('', 'contains no key of a tableau, such as family, A or b')
    """
    reason = _reason(path)
    return "" if reason is None or (strict and not reason.plain) else reason.text


def _reason(path: str | Path) -> Reason | None:
    of = find_format(str(path))
    if of == "toml":
        return None if meant_as_tableau(path) else Reason(NO_KEY)
    try:
        content = bytes_of(path)
    except InputError:
        return None
    return _REASONS[of](content) if of in _REASONS else Reason("the file has an unknown suffix")


def _of_json(content: bytes) -> Reason | None:
    try:
        data = json.loads(content)
    except (ValueError, RecursionError):
        return None
    if not isinstance(data, dict):
        return Reason(NO_KEY, plain=not _is_matrix(data))
    similar = {key.casefold() for key in KEYS} & {key.casefold() for key in data}
    matrix = any(map(_is_matrix, data.values()))
    return None if not KEYS.isdisjoint(data) else Reason(NO_KEY, plain=not similar and not matrix)


def _is_matrix(value: object) -> bool:
    """Return True if a value is a list of lists, and at least one of the lists contains a number or a
    string."""
    if not isinstance(value, list) or not value or not all(isinstance(row, list) for row in value):
        return False
    return any(isinstance(x, int | float | str) for row in value for x in row)


def _of_csv(content: bytes) -> Reason | None:
    """Return the reason to skip a CSV file, or None if the file is not skipped."""
    try:
        table = rows.read(content.decode(), csv_table.NAMES)
    except (csv.Error, UnicodeDecodeError):
        return None
    named = any(row[0] in (*MATRICES, *ROWS) for row in table.rows)
    weights = any(not row[0] for row in table.rows)
    if named or (weights and not table.plainly_other):
        return None
    text = "no row begins with the name of an array (A, b, ...) or with an empty cell"
    return Reason(text, plain=not table.rows or table.plainly_other)


def _of_archive(content: bytes) -> Reason | None:
    try:
        names = zipfile.ZipFile(io.BytesIO(content)).namelist()
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        return None
    arrays = {name.removesuffix(".npy") for name in names}
    if (arrays & {*MATRICES, *ROWS}) - {"c"}:
        return None
    unnamed = any(name.casefold() in ("a", "b") or re.fullmatch(r"arr_\d+", name) for name in arrays)
    return Reason("no array has one of the names A, b, gamma, ...", plain=not unnamed)


def _of_python(content: bytes) -> Reason | None:
    from orderconds.exchange import python_source

    text = python_source.reason_to_skip(content)
    return Reason(text, plain=python_source.is_plainly_other(content)) if text else None


def _of_latex(content: bytes) -> Reason | None:
    match = _LATEX.search(content.decode(errors="replace"))
    return None if match else Reason("no Butcher tableau and no matrix named A, gamma, alpha or exponentials")


def _of_c(content: bytes) -> Reason | None:
    match = _ARRAY.search(content.decode(errors="replace"))
    return None if match else Reason("no array is named A, gamma, alpha or exponentials")


_REASONS: dict[str | None, Callable[[bytes], Reason | None]] = {
    "json": _of_json,
    "csv": _of_csv,
    "numpy": _of_archive,
    "sympy": _of_python,
    "latex": _of_latex,
    "c": _of_c,
}
"""For each format, a function that returns the reason to skip a file, or None if the file is not skipped."""
