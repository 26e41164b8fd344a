"""C arrays: correctly rounded doubles, the exact value in a comment beside each that is rounded.

What is read are the initialisers ``... NAME_A[..][..] = {{...}};``; a comment beside a number stands for it.
"""

from __future__ import annotations

import re
from typing import Any

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, arrays, coefficient, data_of
from orderconds.exchange.nested import nested
from orderconds.exchange.numpy_archive import nearest

INTEGERS = ("count", "start", "embedded_order")
_ARRAY = re.compile(r"(\w+)\s*((?:\[[^\]]*\]\s*)*)=\s*([^;]*);", re.ASCII)
_TEXT = re.compile(r"^/\* (\w+): (.*) \*/$", re.MULTILINE)


def write(data: Any) -> bytes:
    """Return C definitions, every name under the tableau's own.

    >>> print(write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()[-1])
    static const double m_b[1] = {1.0};
    """
    found = arrays(data, "C arrays")
    roots = found.get("numbers", "{}")
    prefix = re.sub(r"\W", "_", found["name"], flags=re.ASCII)
    lines = [f"/* {name}: {found[name].replace('*/', '* /')} */" for name in TEXTS if name in found]
    for name, value in found.items():
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
        if name in found:
            row = ", ".join(found[name])
            lines.append(f"static const int {prefix}_{name}[{len(found[name])}] = {{{row}}};")
    return ("\n".join(lines) + "\n").encode()


def _cells_of(row: list[str], roots: str) -> str:
    return ", ".join(_cell(x, roots) for x in row)


def _cell(spelled: str, roots: str) -> str:
    value = repr(nearest(spelled, roots))
    return value if coefficient(value) == spelled or value == f"{spelled}.0" else f"{value} /* {spelled} */"


def read(content: bytes, where: str) -> dict[str, Any]:
    """Return the keys of a tableau file.

    >>> read(b"double m_A[1][1] = {{1.0/2}}; double m_b[1] = {1};", "m.c")["A"]
    [['1.0/2']]
    """
    try:
        text = content.decode()
    except UnicodeDecodeError:
        raise TableauError("bytes that are no UTF-8", where=where, expected="C source") from None
    found: Arrays = {name: value for name, value in _TEXT.findall(text) if name in TEXTS}
    text = _TEXT.sub("", re.sub(r"//.*", "", text))
    for name, brackets, value in _ARRAY.findall(text):
        key = next(
            (k for k in sorted(ROWS + MATRICES, key=len, reverse=True) if re.search(rf"(^|_){k}$", name)),
            None,
        )
        if key is None or not brackets:
            continue
        if key in found:
            raise TableauError(f"two arrays {key}", where=where, expected="one")
        found[key] = _cells(nested(value.strip(), "{", "}", f"{where}: {name}"))
    if not found.keys() - set(TEXTS):
        raise TableauError(
            "no arrays", where=where, expected="definitions such as  double NAME_A[2][2] = {...};"
        )
    return data_of(found, where)


def _cells(value: Any) -> Any:
    if isinstance(value, list):
        return [_cells(x) for x in value]
    exact = re.search(r"/\*\s*(.*?)\s*\*/", value, re.DOTALL)
    return exact[1] if exact else coefficient(value)
