"""C arrays of correctly rounded doubles. A comment beside a rounded number contains the exact value.

The function ``read`` reads definitions such as ``double NAME_A[2][2] = {{0, 0}, {0.5, 0}};``. If a
number has such a comment, ``read`` returns the exact value.
"""

from __future__ import annotations

import re

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, coefficient, from_arrays, to_arrays
from orderconds.exchange.comments import escaped, unescaped
from orderconds.exchange.nested import Cells, nested
from orderconds.exchange.numpy_archive import nearest
from orderconds.tableau.file_format import Data

INTEGERS = ("count", "start", "embedded_order")
_ARRAY = re.compile(
    r"(?<!\w)(\w{1,128})\s{0,9}((?:\[[^\]\[=;]{0,64}\]\s{0,9}){1,3})=\s{0,9}([^;=]*);", re.ASCII
)
_TEXT = re.compile(r" (\w{1,64}): (.*) ", re.DOTALL)
_TOKEN = re.compile(r"/\*|//|[{}\"]")


def write(data: Data) -> bytes:
    """Return a tableau as definitions of C arrays. The array names begin with the name of the tableau.

    >>> print(write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode().splitlines()[-1])
    static const double m_b[1] = {1.0};
    """
    entries = to_arrays(data, "C arrays")
    roots = entries.get("numbers", "{}")
    prefix = re.sub(r"\W", "_", entries["name"], flags=re.ASCII)
    lines = [f"/* {name}: {escaped(entries[name])} */" for name in TEXTS if name in entries]
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
    """Read a tableau from C arrays, and return a dictionary with the keys of a tableau file.

    >>> read(b"double m_A[1][1] = {{1.0/2}}; double m_b[1] = {1};", "m.c")["A"]
    [['1.0/2']]
    """
    try:
        text = content.decode()
    except UnicodeDecodeError:
        raise TableauError("bytes that are not UTF-8", where=where, expected="C source") from None
    text, comments = _without_comments(text, where)
    entries: Arrays = {}
    for comment in comments:
        if (match := _TEXT.fullmatch(comment)) and match[1] in TEXTS and "\n" not in comment:
            entries.setdefault(match[1], unescaped(match[2]))
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


def _without_comments(text: str, where: str) -> tuple[str, list[str]]:
    """Remove strings and comments from C source. Return the remaining source and a list of texts.

    The texts are those of the removed comments ``/* ... */`` that precede the first array. Comments
    ``/* ... */`` inside arrays are not removed, because these comments contain exact values of numbers.
    """
    kept: list[str] = []
    comments: list[str] = []
    place, depth, arrays = 0, 0, False
    while (token := _TOKEN.search(text, place)) is not None:
        if token[0] in "{}":
            depth += 1 if token[0] == "{" else -1
            arrays = True
            end = token.end()
            kept.append(text[place:end])
        else:
            kept.append(text[place : token.start()])
            end = _end(text, token, where)
            if token[0] == "/*" and depth > 0:
                kept.append(text[token.start() : end].replace(";", ""))
            elif token[0] == "/*" and not arrays:
                comments.append(text[token.end() : end - 2])
        place = end
    return "".join([*kept, text[place:]]), comments


def _end(text: str, token: re.Match[str], where: str) -> int:
    """Return the index of the first character after the comment or string that begins with ``token``.

    Raise TableauError if ``*/`` or the closing quotation mark is missing.
    """
    if token[0] == "//":
        end = text.find("\n", token.end())
        return len(text) if end < 0 else end
    closing = "*/" if token[0] == "/*" else '"'
    end = text.find(closing, token.end())
    while closing == '"' and end > 0 and text[end - 1] == "\\":
        end = text.find(closing, end + 1)
    if end < 0:
        raise TableauError("a comment or string that is not closed", where=where, expected="C source")
    return end + len(closing)


def _cells(value: Cells) -> Cells:
    if isinstance(value, list):
        return [_cells(x) for x in value]
    exact = re.search(r"/\*\s*(.*?)\s*\*/", value, re.DOTALL)
    return exact[1] if exact else coefficient(value)
