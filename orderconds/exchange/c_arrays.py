"""C arrays: correctly rounded doubles; a comment beside a rounded number gives its exact value.

The reader takes initialisers ``... NAME_A[..][..] = {{...}};`` and prefers the comment to the number.
"""

from __future__ import annotations

import re

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, coefficient, from_arrays, to_arrays
from orderconds.exchange.nested import Cells, nested
from orderconds.exchange.numpy_archive import nearest
from orderconds.tableau.write import Data

INTEGERS = ("count", "start", "embedded_order")
_ARRAY = re.compile(r"(\w+)\s*((?:\[[^\]]*\]\s*)*)=\s*([^;]*);", re.ASCII)
_TEXT = re.compile(r"^/\* (\w+): (.*) \*/$", re.MULTILINE)


def write(data: Data) -> bytes:
    """Return C definitions, every name under the tableau's own.

    >>> print(write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()[-1])
    static const double m_b[1] = {1.0};
    """
    entries = to_arrays(data, "C arrays")
    roots = entries.get("numbers", "{}")
    prefix = re.sub(r"\W", "_", entries["name"], flags=re.ASCII)
    lines = [f"/* {name}: {entries[name].replace('*/', '* /')} */" for name in TEXTS if name in entries]
    for name, value in entries.items():
        if name in INTEGERS:
            continue
        if name in MATRICES:
            width = max(map(len, value), default=1)
            rows = ",\n    ".join("{" + _cells_of(row, roots) + "}" for row in value)
            lines.append(f"static const double {prefix}_{name}[{len(value)}][{width}] = {{\n    {rows}}};")
        elif name in ROWS:
            lines.append(
                f"static const double {prefix}_{name}[{len(value)}] = {{{_cells_of(value, roots)}}};"
            )
    for name in INTEGERS[:2]:
        if name in entries:
            row = ", ".join(entries[name])
            lines.append(f"static const int {prefix}_{name}[{len(entries[name])}] = {{{row}}};")
    return ("\n".join(lines) + "\n").encode()


def _cells_of(row: list[str], roots: str) -> str:
    return ", ".join(_cell(x, roots) for x in row)


def _cell(text: str, roots: str) -> str:
    value = repr(nearest(text, roots))
    return value if coefficient(value) == text or value == f"{text}.0" else f"{value} /* {text} */"


def read(content: bytes, where: str) -> Data:
    """Return the keys of a tableau file.

    >>> read(b"double m_A[1][1] = {{1.0/2}}; double m_b[1] = {1};", "m.c")["A"]
    [['1.0/2']]
    """
    try:
        text = content.decode()
    except UnicodeDecodeError:
        raise TableauError("bytes that are no UTF-8", where=where, expected="C source") from None
    entries: Arrays = {name: value for name, value in _TEXT.findall(text) if name in TEXTS}
    text = _TEXT.sub("", re.sub(r"//.*", "", text))
    for name, brackets, value in _ARRAY.findall(text):
        key = next(
            (k for k in sorted(ROWS + MATRICES, key=len, reverse=True) if re.search(rf"(^|_){k}$", name)),
            None,
        )
        if key is None or not brackets:
            continue
        if key in entries:
            raise TableauError(f"two arrays {key}", where=where, expected="one")
        entries[key] = _cells(nested(value.strip(), "{", "}", f"{where}: {name}"))
    if not entries.keys() - set(TEXTS):
        raise TableauError(
            "no arrays", where=where, expected="definitions such as  double NAME_A[2][2] = {...};"
        )
    return from_arrays(entries, where)


def _cells(value: Cells) -> Cells:
    if isinstance(value, list):
        return [_cells(x) for x in value]
    exact = re.search(r"/\*\s*(.*?)\s*\*/", value, re.DOTALL)
    return exact[1] if exact else coefficient(value)
