"""NumPy archives (``.npz``). For example, the matrix A of a tableau becomes two arrays: ``A`` contains the
entries as doubles, and ``A_exact`` contains the exact entries as text.

If ``A_exact`` is missing, the coefficients are the doubles in ``A``. Arrays of Python objects are refused.
The array ``order`` contains the claimed order in the family of the tableau. The array ``claims`` contains
families and claimed orders as text, for example ``rk=4``.
"""

from __future__ import annotations

import io
import re
import struct
import zipfile
import zlib
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias, cast

from orderconds.errors import TableauError
from orderconds.exchange.arrays import TEXTS, Arrays, from_arrays, to_arrays
from orderconds.exchange.claim_text import json_table
from orderconds.exchange.nested import Cells
from orderconds.tableau.doubles import double_text
from orderconds.tableau.file_format import Data
from orderconds.tableau.record import from_data

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np

    from orderconds.ring.protocol import RealRing

EXACT = "_exact"
LARGEST = 20_000_000
"""The largest total size of the unpacked arrays of an archive, in bytes."""
UNREADABLE = (
    EOFError,
    KeyError,
    MemoryError,
    NotImplementedError,
    OSError,
    RuntimeError,
    SyntaxError,
    ValueError,
    struct.error,
    zipfile.BadZipFile,
    zlib.error,
)
"""The errors that a damaged or encrypted archive raises."""
INTEGERS = ("count", "start")
EXPECTED = "an array of numbers (float64 or integers) with 1 or 2 axes"

Floats: TypeAlias = "float | list[Floats]"
"""A number, or nested lists of numbers."""


def write(data: Data) -> bytes:
    """Return a tableau as the content of an ``.npz`` archive.

    >>> write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]})[:2]
    b'PK'
    """
    import numpy as np

    content = io.BytesIO()
    entries = to_arrays(data, "NumPy")
    roots = entries.get("numbers", "{}")
    members: Arrays = {}
    for name, value in entries.items():
        if name in TEXTS:
            members[name] = np.array(value)
        elif name in INTEGERS:
            members[name] = np.array([int(x) for x in value])
        else:
            members[name] = np.array(floats(value, roots), dtype=np.float64)
            members[name + EXACT] = np.array(value)
    np.savez(content, **members)
    return content.getvalue()


def floats(value: Cells, roots: str = "{}") -> Floats:
    """Convert a coefficient, or nested lists of coefficients, to the nearest doubles.

    ``roots`` is a JSON text that maps the names of polynomial roots to their definitions.

    >>> floats([["1/2", "1/3"]])
    [[0.5, 0.3333333333333333]]
    """
    if isinstance(value, list):
        return [floats(x, roots) for x in value]
    return nearest(value, roots)


@lru_cache(maxsize=4096)
def nearest(text: str, roots: str = "{}") -> float:
    """Return the double nearest to a coefficient.

    ``roots`` maps the names of polynomial roots to their definitions, as JSON text.

    >>> nearest("1/3 - sqrt(3)/6")
    0.04465819873852045
    >>> nearest("x/2", '{"x": {"minpoly": ["-2", "0", "0", "1"], "near": "1.26"}}')
    0.6299605249474366
    """
    fraction = re.fullmatch(r"(-?[0-9]{1,300})(?:/([1-9][0-9]{0,299}))?", text)
    try:
        if fraction:  # Python rounds the quotient of two integers correctly.
            return int(fraction[1]) / int(fraction[2] or 1)
        data = {"name": "x", "family": "rk", "A": [[]], "b": [text], "numbers": json_table(roots, "numbers")}
        tableau = from_data(data)
        (weight,) = tableau.abelian().b
        return cast("RealRing", tableau.ring).nearest_float(weight)
    except OverflowError:
        raise TableauError(
            f"the coefficient {text[:40]!r} is beyond the range of doubles",
            expected="the format json, which can store numbers of any size",
        ) from None


def read(content: bytes, where: str) -> Data:
    """Read a tableau from an ``.npz`` archive, and return a dictionary with the keys of a tableau file.

    Raises TableauError if an entry of ``A`` is not the double nearest to the exact value in ``A_exact``.

    >>> read(write({"name": "m", "family": "rk", "A": [["1/3"]], "b": ["1"]}), "m.npz")["A"]
    [['1/3']]
    """
    import numpy as np

    if not zipfile.is_zipfile(io.BytesIO(content)):
        raise TableauError("no zip archive", where=where, expected="an .npz archive")
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as archive:
            _require_small(archive.zip, where)
            members = {name: _member(archive, name, where) for name in archive.files}
    except UNREADABLE as problem:
        raise TableauError(str(problem) or "no archive", where=where, expected="an .npz archive") from None
    entries: Arrays = {}
    for name, value in members.items():
        if not isinstance(value, np.ndarray):
            raise TableauError(f"the file {name} is not an array", where=where, expected="arrays")
        if name.endswith(EXACT) and value.dtype.kind != "U":
            raise TableauError(f"the array {name} has the type {value.dtype}", where=where, expected="texts")
    for name, value in members.items():
        if name.endswith(EXACT):
            continue
        if name in TEXTS:
            entries[name] = str(value)
            continue
        exact = members.get(name + EXACT)
        _require_numbers(name, value.dtype.kind, value.dtype.itemsize, value.ndim, where)
        if exact is None or name in INTEGERS:
            entries[name] = _coefficients(value.tolist(), f"{where}: {name}")
            continue
        entries[name] = exact.tolist()
        if not np.array_equal(np.array(floats(entries[name], str(members.get("numbers", "{}")))), value):
            raise TableauError(
                f"the numbers in the array {name} differ from the exact texts in the array {name}{EXACT}",
                where=where,
                expected="equal numbers in both arrays",
                hint="correct or remove one of the two arrays",
            )
    return from_arrays(entries, where)


def _member(archive: Mapping[str, np.ndarray], name: str, where: str) -> np.ndarray:
    """Return one array of an archive. Raise an error if the array contains Python objects."""
    try:
        return archive[name]
    except ValueError as problem:
        if "allow_pickle" not in str(problem):
            raise
        raise TableauError(
            f"the array {name} contains pickled Python objects",
            where=where,
            expected=EXPECTED,
            hint="fill ragged rows with zeros, and save with numpy.savez(FILE, A=A, b=b)",
        ) from None


def _require_numbers(name: str, kind: str, size: int, axes: int, where: str) -> None:
    """Require a vector or a matrix. The entries must be integers or doubles."""
    if axes not in (1, 2) and kind in "fiu":
        raise TableauError(f"the array {name} has {axes} axes", where=where, expected=EXPECTED)
    if kind == "c":
        raise TableauError(f"the array {name} contains complex numbers", where=where, expected=EXPECTED)
    if kind == "f" and size != 8:
        raise TableauError(
            f"the array {name} contains floats with {8 * size} bits",
            where=where,
            expected=EXPECTED,
            hint="store the original coefficients as float64; float32 arrays remain inaccurate if converted",
        )
    if kind not in "fiu":
        raise TableauError(f"the array {name} has the NumPy kind {kind!r}", where=where, expected=EXPECTED)


def _require_small(archive: zipfile.ZipFile, where: str) -> None:
    size = sum(member.file_size for member in archive.infolist())
    if size > LARGEST:
        raise TableauError(
            f"arrays of {size} bytes in total", where=where, expected=f"at most {LARGEST} bytes"
        )


def _coefficients(value: Floats, where: str) -> Cells:
    if isinstance(value, list):
        return [_coefficients(x, where) for x in value]
    return double_text(value, where) if isinstance(value, float) else str(value)
