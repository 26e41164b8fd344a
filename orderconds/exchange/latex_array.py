r"""LaTeX: a Butcher tableau as an ``array`` with rules, other methods as matrices by name.

Read back are ``\begin{array}{c|cc}`` with c, A (blank cells are zeros), a rule and b, and
``A = \begin{pmatrix} ... \end{pmatrix}``.
"""

from __future__ import annotations

import re
from typing import Any

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, arrays, butcher, coefficient, data_of
from orderconds.exchange.spelling import from_latex, latex
from orderconds.ring import Ball, Balls
from orderconds.tableau import Tableau
from orderconds.tableau.file import from_data

SHORT = Balls(64)
_TEXT = re.compile(r"^% (\w+): (.*)$", re.MULTILINE)
_BUTCHER = re.compile(r"\\begin\{array\}\{\s*[lcr]\s*\|[lcr\s]+\}(.*?)\\end\{array\}", re.DOTALL)
_MATRIX = re.compile(r"([A-Za-z_\\{}]+)\s*=\s*\\begin\{[bp]matrix\}(.*?)\\end\{[bp]matrix\}", re.DOTALL)


def write(data: Any) -> bytes:
    r"""Return LaTeX for a display.

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
    found = arrays(data, "LaTeX")
    lines = [f"% {name}: {found[name]}" for name in TEXTS if name in found]
    if "A" in found and "A_hat" not in found:
        tableau = from_data(data)
        nodes = [_node(tableau, x) for x in tableau.abelian().c]
        lines.append(rf"\begin{{array}}{{c|{'c' * len(found['b'])}}}")
        lines += [
            " & ".join([latex(c), *map(latex, row)]) + r" \\"
            for c, row in zip(nodes, found["A"], strict=True)
        ]
        for key in ("b", "embedded_b"):
            if key in found:
                lines += [r"\hline", " & ".join(["", *map(latex, found[key])]).lstrip() + r" \\"]
        return ("\n".join([*lines, r"\end{array}"]) + "\n").encode()
    for name in ROWS + MATRICES:
        if name in found:
            rows = found[name] if name in MATRICES else [found[name]]
            body = " \\\\\n".join(" & ".join(map(latex, row)) for row in rows)
            lines += [rf"{name} = \begin{{pmatrix}}", body, r"\end{pmatrix}"]
    return ("\n".join(lines) + "\n").encode()


def _node(tableau: Tableau, x: Any) -> str:
    """Spell an abscissa; a ball with the digits of a double and a few more, which determine nothing."""
    return SHORT.text(SHORT.enclose(x.value) + 0) if isinstance(x, Ball) else tableau.ring.text(x)


def read(content: bytes, where: str) -> dict[str, Any]:
    r"""Return the keys of a tableau file.

    >>> read(rb"\begin{array}{c|c} \frac12 & \frac12 \\ \hline & 1 \end{array}", "m.tex")["A"]
    [['(1/2)']]
    """
    try:
        text = content.decode()
    except UnicodeDecodeError:
        raise TableauError("bytes that are no UTF-8", where=where, expected="LaTeX") from None
    found: Arrays = {name: value for name, value in _TEXT.findall(text) if name in TEXTS}
    if butcher := _BUTCHER.search(text):
        return data_of({**found, **_butcher(butcher[1], where)}, where)
    for name, body in _MATRIX.findall(text):
        rows = _rows(body, where)
        found[name] = rows[0] if name in ROWS and rows else rows
    if not found.keys() - set(TEXTS):
        raise TableauError(
            "no tableau", where=where, expected=r"\begin{array}{c|cc} ... or A = \begin{pmatrix} ..."
        )
    return data_of(found, where)


def _butcher(body: str, where: str) -> Arrays:
    parts = [_rows(part, where) for part in re.split(r"\\hline", body) if part.strip()]
    if not 2 <= len(parts) <= 3 or any(len(part) != 1 for part in parts[1:]):
        raise TableauError(
            "rules that part no tableau", where=where, expected=r"rows c & A, \hline, a row & b"
        )
    return butcher(parts[0], [row[1:] for (row,) in parts[1:]])


def _rows(body: str, where: str) -> list[list[str]]:
    rows = [row for row in re.split(r"\\\\(?:\[[^\]]*\])?", body) if row.strip()]
    return [[coefficient(from_latex(cell, where)) for cell in row.split("&")] for row in rows]
