"""NumPy: an ``.npz`` archive with float64 arrays, and beside each the exact spelling (``A_exact``).

An archive without spellings is read by its floats, as decimals of all their digits.
"""

from __future__ import annotations

import io
import re
import struct
import zipfile
import zlib
from functools import lru_cache
from typing import Any

from orderconds.errors import TableauError
from orderconds.exchange.arrays import TEXTS, Arrays, arrays, coefficient, data_of, table
from orderconds.tableau.file import from_data

EXACT = "_exact"
LARGEST = 20_000_000
"""No more bytes are unpacked."""
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
"""What zip files and array headers raise that are damaged, encrypted or of another version."""
INTEGERS = ("count", "start")


def write(data: Any) -> bytes:
    """Return the archive.

    >>> write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]})[:2]
    b'PK'
    """
    import numpy as np

    content = io.BytesIO()
    found = arrays(data, "NumPy")
    roots = found.get("numbers", "{}")
    members: dict[str, Any] = {}
    for name, value in found.items():
        if name in TEXTS:
            members[name] = np.array(value)
        elif name in INTEGERS:
            members[name] = np.array([int(x) for x in value])
        else:
            members[name] = np.array(floats(value, roots), dtype=np.float64)
            members[name + EXACT] = np.array(value)
    np.savez(content, **members)
    return content.getvalue()


def floats(value: Any, roots: str = "{}") -> Any:
    """Return spelled coefficients as the doubles nearest to them; ``roots`` is the JSON of named ones.

    >>> floats([["1/2", "1/3"]])
    [[0.5, 0.3333333333333333]]
    """
    if isinstance(value, list):
        return [floats(x, roots) for x in value]
    return nearest(value, roots)


@lru_cache(maxsize=4096)
def nearest(spelled: str, roots: str = "{}") -> float:
    """Return the double nearest to a spelled coefficient.

    >>> nearest("1/3 - sqrt(3)/6")
    0.04465819873852045
    >>> nearest("x/2", '{"x": {"minpoly": ["-2", "0", "0", "1"], "near": "1.26"}}')
    0.6299605249474366
    """
    fraction = re.fullmatch(r"(-?[0-9]{1,300})(?:/([1-9][0-9]{0,299}))?", spelled)
    try:
        if fraction:  # most are; integers divide with one rounding
            return int(fraction[1]) / int(fraction[2] or 1)
        data = {"name": "x", "family": "rk", "A": [[]], "b": [spelled], "numbers": table(roots, "numbers")}
        tableau = from_data(data)
        (weight,) = tableau.abelian().b
        ring: Any = tableau.ring
        return float(ring.nearest_float(weight))
    except OverflowError:
        raise TableauError(
            f"{spelled[:40]!r}, beyond the range of doubles", expected="format json, which holds everything"
        ) from None


def read(content: bytes, where: str) -> dict[str, Any]:
    """Return the keys of a tableau file; floats and spellings that disagree are refused.

    >>> read(write({"name": "m", "family": "rk", "A": [["1/3"]], "b": ["1"]}), "m.npz")["A"]
    [['1/3']]
    """
    import numpy as np

    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as archive:
            _refuse_bombs(archive.zip, where)
            members = {name: archive[name] for name in archive.files}
    except UNREADABLE as problem:
        raise TableauError(str(problem) or "no archive", where=where, expected="an .npz archive") from None
    found: Arrays = {}
    for name, value in members.items():
        if name.endswith(EXACT):
            continue
        if name in TEXTS:
            found[name] = str(value)
            continue
        spelled = members.get(name + EXACT)
        if value.dtype.kind not in "fiu" or value.ndim not in (1, 2):
            raise TableauError(
                f"{name}: {value.dtype} with {value.ndim} axes", where=where, expected="numbers"
            )
        if spelled is None or name in INTEGERS:
            found[name] = _spelled(value.tolist())
            continue
        found[name] = spelled.tolist()
        if not np.array_equal(np.array(floats(found[name], str(members.get("numbers", "{}")))), value):
            raise TableauError(
                f"{name} that is not {name}{EXACT}",
                where=where,
                expected="numbers that agree",
                hint="drop one",
            )
    return data_of(found, where)


def _refuse_bombs(archive: zipfile.ZipFile, where: str) -> None:
    size = sum(member.file_size for member in archive.infolist())
    if size > LARGEST:
        raise TableauError(
            f"arrays of {size} bytes", where=where, expected=f"a tableau, of at most {LARGEST} bytes"
        )


def _spelled(value: Any) -> Any:
    return [_spelled(x) for x in value] if isinstance(value, list) else coefficient(repr(value))
