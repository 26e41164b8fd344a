r"""Tableaux in LaTeX, as a Butcher tableau or as named matrices.

A Butcher tableau is an array with rules: ``\begin{array}{c|cc} ... \end{array}``. A named matrix has
the form ``A = \begin{pmatrix} ... \end{pmatrix}``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from orderconds.errors import TableauError
from orderconds.exchange.arrays import (
    MATRICES,
    ROWS,
    TEXTS,
    Arrays,
    butcher,
    coefficient,
    from_arrays,
    to_arrays,
)
from orderconds.exchange.comments import escaped, unescaped
from orderconds.exchange.notation import from_latex
from orderconds.tableau.butcher_text import entry
from orderconds.tableau.coefficient_latex import to_latex
from orderconds.tableau.file_format import Data
from orderconds.tableau.record import from_data

_TEXT = re.compile(r"% (\w{1,64}): (.*)")
_COMMENT = re.compile(r"(?<!\\)%.*")
_ENVIRONMENT = re.compile(r"\\(begin|end)\{(array|[bp]matrix)\}")
_COLUMNS = re.compile(r"\{\s{0,9}[lcr]\s{0,9}\|[lcr\s]{1,200}\}")
_NAMED = re.compile(r"([A-Za-z_\\{}]{1,64})\s{0,9}=\s{0,9}$")


def write(data: Data) -> bytes:
    r"""Return a tableau as LaTeX source for math mode. The name and other texts become comments.

    >>> print(write({"name": "m", "family": "rk", "A": [["1/2"]], "b": ["1"]}).decode())
    % name: m
    % family: rk
    \begin{array}{c|c}
    \frac{1}{2} & \frac{1}{2} \\
    \hline
    & 1 \\
    \end{array}
    <BLANKLINE>
    """
    entries = to_arrays(data, "LaTeX")
    lines = [f"% {name}: {escaped(entries[name])}" for name in TEXTS if name in entries]
    if "A" in entries and "A_hat" not in entries:
        tableau = from_data(data)
        nodes = [entry(tableau, x) for x in tableau.abelian().c]
        lines.append(rf"\begin{{array}}{{c|{'c' * len(entries['b'])}}}")
        lines += [
            " & ".join([to_latex(c), *map(to_latex, row)]) + r" \\"
            for c, row in zip(nodes, entries["A"], strict=True)
        ]
        for key in ("b", "embedded_b"):
            if key in entries:
                lines += [r"\hline", " & ".join(["", *map(to_latex, entries[key])]).lstrip() + r" \\"]
        return ("\n".join([*lines, r"\end{array}"]) + "\n").encode()
    for name in ROWS + MATRICES:
        if name in entries:
            rows = entries[name] if name in MATRICES else [entries[name]]
            body = " \\\\\n".join(" & ".join(map(to_latex, row)) for row in rows)
            lines += [rf"{name} = \begin{{pmatrix}}", body, r"\end{pmatrix}"]
    return ("\n".join(lines) + "\n").encode()


def read(content: bytes, where: str) -> Data:
    r"""Read a tableau from LaTeX, and return it as the keys and values of a tableau file.

    >>> read(rb"\begin{array}{c|c} \frac12 & \frac12 \\ \hline & 1 \end{array}", "m.tex")["A"]
    [['(1/2)']]
    """
    try:
        text = content.decode()
    except UnicodeDecodeError:
        raise TableauError("bytes that are not UTF-8", where=where, expected="LaTeX") from None
    entries = _texts(text)
    environments = list(_environments(_COMMENT.sub("", text), where))
    if (array := next((body for name, body in environments if name is None), None)) is not None:
        return from_arrays({**entries, **_butcher(array, where)}, where)
    for name, body in environments:
        if name is None:
            continue
        if name in entries:
            raise TableauError(f"two matrices {name}", where=where, expected="one")
        rows = _rows(body, where)
        entries[name] = rows[0] if name in ROWS and rows else rows
    if not entries.keys() - set(TEXTS):
        raise TableauError(
            "no tableau", where=where, expected=r"\begin{array}{c|cc} ... or A = \begin{pmatrix} ..."
        )
    return from_arrays(entries, where)


def _texts(text: str) -> Arrays:
    """Read the comments at the beginning of a file, for example ``% name: heun`` as {"name": "heun"}."""
    entries: Arrays = {}
    for line in text.split("\n"):
        if line.strip() and not line.startswith("%"):
            break
        if (match := _TEXT.fullmatch(line.rstrip("\r"))) and match[1] in TEXTS:
            entries.setdefault(match[1], unescaped(match[2]))
    return entries


def _environments(text: str, where: str) -> Iterator[tuple[str | None, str]]:
    """Yield a pair (name, rows) for each Butcher tableau and each named matrix in the LaTeX source ``text``.

    ``rows`` is the LaTeX source of the rows. ``name`` is the text before the equals sign of a matrix, such as
    ``A``. For a Butcher tableau, ``name`` is None.
    """
    opened: re.Match[str] | None = None
    for token in _ENVIRONMENT.finditer(text):
        if token[1] == "begin":
            if opened is not None:
                raise TableauError("a matrix within a matrix", where=where, expected="rows of numbers")
            opened = token
            continue
        if opened is None or opened[2] != token[2]:
            raise TableauError(f"{token[0]} without its \\begin", where=where, expected="rows of numbers")
        columns = _COLUMNS.match(text, opened.end())
        named = _NAMED.search(text, max(0, opened.start() - 84), opened.start())
        if opened[2] == "array" and columns is not None:
            yield None, text[columns.end() : token.start()]
        elif opened[2] != "array" and named is not None:
            yield named[1], text[opened.end() : token.start()]
        opened = None
    if opened is not None:
        raise TableauError(f"{opened[0]} without its \\end", where=where, expected="rows of numbers")


def _butcher(body: str, where: str) -> Arrays:
    parts = [_rows(part, where) for part in re.split(r"\\hline", body) if part.strip()]
    weights = [row for part in parts[1:] for row in part]
    if not 1 <= len(weights) <= 2 or len({len(row) for row in weights}) != 1:
        raise TableauError(
            "the rows of weights below the horizontal line differ in length, or their number is not 1 or 2",
            where=where,
            expected=r"a row `c_i & a_i1 & ...` for each stage, then `\hline`, then weights `& b_1 & ...`, "
            r"and at most one row of embedded weights",
        )
    return butcher(parts[0], [row[1:] for row in weights])


def _rows(body: str, where: str) -> list[list[str]]:
    rows = [row for row in re.split(r"\\\\(?:\[[^\]]*\])?", body) if row.strip()]
    return [[coefficient(from_latex(cell, where)) for cell in row.split("&")] for row in rows]
