"""Format the keys and values of a tableau file as TOML text, in the layout of a file written by hand."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeGuard

WIDTH = 110
"""The maximal length of a line with a matrix. A longer matrix is written with one line for each row."""

_BARE = re.compile(r"[A-Za-z0-9_-]+", re.ASCII)


def toml_text(data: Mapping[str, object]) -> str:
    """Return the TOML text of ``data``. The values may be strings, integers, booleans, lists and tables.

    >>> print(toml_text({"b": ["1"], "stage": [{}, {"exp": [["1"]]}], "claims": {"rk": 1}}), end="")
    b = ["1"]
    [[stage]]
    [[stage]]
    exp = [["1"]]
    [claims]
    rk = 1
    """
    return "\n".join([*_entries(data), *_headings("", data)]) + "\n"


def _entries(table: Mapping[str, object]) -> Iterator[str]:
    for key, value in table.items():
        if not _headed(key, value):
            yield _line(key, value)


def _headed(key: str, value: object) -> bool:
    """Return True if a value is written below a line ``[key]`` or ``[[key]]``."""
    if _blocks(value, key):
        return True
    return isinstance(value, Mapping) and not (key == "embedded" and len(_line(key, value)) <= WIDTH)


def _line(key: str, value: object) -> str:
    line = f"{_key(key)} = {inline(value)}"
    if len(line) <= WIDTH or not _rows(value):
        return line
    return "\n".join([f"{_key(key)} = [", *(f"  {inline(row)}," for row in value), "]"])


def _headings(prefix: str, table: Mapping[str, object]) -> Iterator[str]:
    for key, value in table.items():
        name = f"{prefix}{_key(key)}"
        if _blocks(value, key):
            for entry in value:
                yield f"[[{name}]]"
                yield from (_line(inner, x) for inner, x in entry.items())
        elif isinstance(value, Mapping) and _headed(key, value):
            yield f"[{name}]"
            yield from _entries(value)
            yield from _headings(f"{name}.", value)


def _blocks(value: object, key: str) -> TypeGuard[list[Mapping[str, object]]]:
    """Return True if the key is ``stage`` and the value is a list of tables, one for each stage."""
    return key == "stage" and isinstance(value, list) and all(isinstance(x, Mapping) for x in value)


def _rows(value: object) -> TypeGuard[list[object]]:
    return isinstance(value, list) and any(isinstance(row, list) for row in value)


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else quoted(key)


def inline(value: object) -> str:
    """Return a value as TOML text on one line.

    >>> inline([["1/2"], {"order": 2}, True])
    '[["1/2"], { order = 2 }, true]'
    """
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        entries = ", ".join(f"{_key(key)} = {inline(x)}" for key, x in value.items())
        return f"{{ {entries} }}" if entries else "{}"
    if isinstance(value, Sequence):
        return f"[{', '.join(map(inline, value))}]"
    return str(value)


def quoted(text: str) -> str:
    r"""Return a text as a TOML string in quotation marks.

    >>> print(quoted('a "b"'))
    "a \"b\""
    """
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(map(_character, escaped)) + '"'


def _character(c: str) -> str:
    return c if c.isprintable() else f"\\u{ord(c):04x}" if ord(c) < 0x10000 else f"\\U{ord(c):08x}"
