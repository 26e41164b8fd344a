"""Tableau files among other files: which files of a folder hold a tableau, and why the others are skipped."""

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
from orderconds.exchange import FORMATS, find_format
from orderconds.exchange.arrays import MATRICES, ROWS
from orderconds.tableau.file import KEYS, bytes_of, meant_as_tableau

SUFFIXES = tuple(dict.fromkeys((*(suffix for _, suffix in FORMATS.values()), ".h")))
"""The suffixes of files that may hold a tableau."""

EXCUSES = "DECIMAL"
"""A file of a folder with the names of tableaux whose orders need no proof."""

NO_KEY = "no key of a tableau (family, A, b, ...)"
_ARRAY = re.compile(r"(?<!\w)(?:\w+_)?(?:A|gamma|alpha|exponentials)\s*(?:\[[^\]]*\]\s*){1,2}=", re.ASCII)
_LATEX = re.compile(
    r"\\begin\{array\}\s*\{\s*[lcr]\s*\||(?:A|gamma|alpha|exponentials)\s*=\s*\\begin\{[bp]matrix"
)


@dataclass
class Folder:
    """The files below a folder: paths of tableaux, and skipped files with the reason."""

    tableaux: list[str] = field(default_factory=list)
    skipped: list[tuple[str, str]] = field(default_factory=list)
    others: list[str] = field(default_factory=list)
    """Names of files and hidden folders that no format reads."""


def scan(folder: str | Path) -> Folder:
    """Return the files below a folder, sorted by path. Hidden folders are not searched.

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
        elif reason := reason_to_skip(path):
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


def reason_to_skip(path: str | Path) -> str:
    """Return why a file holds no tableau, or an empty text if it is to be read as a tableau.

    A file that is damaged is to be read, so that its error is reported.

    >>> from orderconds.tableau import find
    >>> from orderconds.tableau.library import root
    >>> reason_to_skip(find("rk4")), reason_to_skip(root().parent / "pyproject.toml")
    ('', 'no key of a tableau (family, A, b, ...)')
    """
    of = find_format(str(path))
    if of == "toml":
        return "" if meant_as_tableau(path) else NO_KEY
    try:
        content = bytes_of(path)
    except InputError:
        return ""
    return _REASONS[of](content) if of in _REASONS else "a suffix that no format has"


def _of_json(content: bytes) -> str:
    try:
        data = json.loads(content)
    except (ValueError, RecursionError):
        return ""
    return "" if isinstance(data, dict) and not KEYS.isdisjoint(data) else NO_KEY


def _of_csv(content: bytes) -> str:
    """Return why a table of text is skipped: it has neither a named array nor rows of weights."""
    try:
        rows = [row for row in csv.reader(io.StringIO(content.decode())) if row]
    except (csv.Error, UnicodeDecodeError):
        return ""
    named = any(row[0].strip() in (*MATRICES, *ROWS) for row in rows)
    weights = any(not row[0].strip() and any(map(str.strip, row)) for row in rows)
    return "" if named or weights else "no row is named A, b, ..., and no row begins with an empty cell"


def _of_archive(content: bytes) -> str:
    try:
        names = zipfile.ZipFile(io.BytesIO(content)).namelist()
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        return ""
    arrays = {name.removesuffix(".npy") for name in names} & {*MATRICES, *ROWS}
    return "" if arrays - {"c"} else "no array is named A, b, ..."


def _of_python(content: bytes) -> str:
    from orderconds.exchange import python_source

    return python_source.reason_to_skip(content)


def _of_latex(content: bytes) -> str:
    return "" if _LATEX.search(content.decode(errors="replace")) else "no Butcher tableau and no matrix A"


def _of_c(content: bytes) -> str:
    return "" if _ARRAY.search(content.decode(errors="replace")) else "no array is named A, gamma, ..."


_REASONS: dict[str | None, Callable[[bytes], str]] = {
    "json": _of_json,
    "csv": _of_csv,
    "numpy": _of_archive,
    "sympy": _of_python,
    "latex": _of_latex,
    "c": _of_c,
}
"""For each format, a function that returns why a file is skipped."""
