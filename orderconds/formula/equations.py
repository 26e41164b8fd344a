r"""Numbered equations in LaTeX for a paper. A picture of a tree may precede each equation.

Long left-hand sides are broken into lines that are narrow enough for a two-column article.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

LINE = 32
"""The largest width of a line of a left-hand side, in characters. A wider line would leave too little space
for the tree, the right-hand side and the equation number in a column of a two-column article."""

_TOKEN = re.compile(r"\\[A-Za-z]+ ?|\\.|[{}]| [+-] |.")


@dataclass(frozen=True)
class Equation:
    """An equation in LaTeX: both sides, a label, a comment, and a picture of a tree. The picture is printed
    in a column before the equation."""

    left: str
    right: str
    picture: str = ""
    label: str = ""
    comment: str = ""


def numbered(equations: Sequence[Equation]) -> str:
    r"""Return the equations in an environment of the LaTeX package amsmath.

    The environment is ``alignat``, with alignment at the equality signs. If a left-hand side is broken into
    several lines, the environment is ``align``, with alignment at the left margin.

    >>> print(numbered([Equation(r"\sum_{i} b_{i}", "1", label="rk:1:1", comment="order 1")]))
    \begin{alignat}{1}
      % order 1
      \sum_{i} b_{i} &= 1 \label{rk:1:1}
    \end{alignat}
    """
    rows = [broken(equation.left) for equation in equations]
    flush = any(len(lines) > 1 for lines in rows)
    pictures = any(equation.picture for equation in equations)
    written = []
    for number, (equation, lines) in enumerate(zip(equations, rows, strict=True), start=1):
        written += [f"  % {line}" for line in equation.comment.splitlines()]
        end = (rf" \label{{{equation.label}}}" if equation.label else "") + r" \\" * (number < len(rows))
        first = equation.picture
        column = r"&\quad " if pictures else "& "
        if not flush:
            start = rf"{first} &\quad& " if pictures else ""
            written.append(f"  {start}{lines[0]} &= {equation.right}{end}")
            continue
        *above, last = [(r"\quad " if k else "") + line for k, line in enumerate(lines)]
        shown = [*(rf"{line} \notag \\" for line in above), f"{last} = {equation.right}{end}"]
        written += [f"  {first if k == 0 else ''} {column}{line}" for k, line in enumerate(shown)]
    name, columns = ("align", "") if flush else ("alignat", f"{{{1 + pictures}}}")
    return "\n".join([rf"\begin{{{name}}}{columns}", *written, rf"\end{{{name}}}"])


def broken(latex: str, line: int = LINE) -> list[str]:
    r"""Break a formula into lines of about ``line`` characters. Each new line begins with a plus or minus
    sign. Signs outside brackets are preferred.

    >>> broken("a_{1} + b_{2} - c_{3}", line=7)
    ['a_{1} + b_{2}', '- c_{3}']
    >>> broken(r"a_{1} \Bigl(b_{2} - c_{3}\Bigr)", line=3)
    ['a_{1} \\Bigl(b_{2}', '- c_{3}\\Bigr)']
    """
    for within in range(latex.count(r"\Bigl") + 1):
        terms = _terms(latex, within)
        if all(_width(term) <= line for term in terms):
            break
    lines, current, width = [], "", 0.0
    for term in terms:
        if current and width + _width(term) > line:
            lines.append(current.strip())
            current, width = "", 0.0
        current += term
        width += _width(term)
    return [*lines, current.strip()]


def _terms(latex: str, within: int) -> list[str]:
    """Split a LaTeX formula before plus and minus signs. Signs inside braces are skipped. A sign inside n
    nested pairs of brackets is skipped if n > ``within``."""
    terms, brackets, braces = [""], 0, 0
    for token in _TOKEN.findall(latex):
        braces += (token == "{") - (token == "}")
        brackets += (token == r"\Bigl") - (token == r"\Bigr")
        if brackets <= within and not braces and token in (" + ", " - "):
            terms.append("")
        terms[-1] += token
    return terms


def _width(latex: str) -> float:
    """Return an estimate of the printed width of a formula, in characters. A character in a subscript or
    superscript has the width 0.6."""
    scripts = sum(len(script) for script in re.findall(r"[_^]\{([^}]*)\}", latex))
    plain = re.sub(r"[_^]\{[^}]*\}|\\hat|\\Big[lr]", "", latex)
    plain = re.sub(r"\\tfrac\{(\d+)\}\{(\d+)\}", lambda m: max(m.groups(), key=len), plain)
    plain = re.sub(r"\\sum", "xx", plain)
    plain = re.sub(r" [+-] ", "xxx", plain)
    return len(re.sub(r"\\[A-Za-z]+ ?", "x", re.sub(r"[{} ]", "", plain))) + 0.6 * scripts
