r"""Equations in LaTeX: one ``align*`` environment. Long left-hand sides are broken between terms."""

from __future__ import annotations

import re
from collections.abc import Iterable

LINE = 60
"""The largest width of a line in characters; it is about the text width of an article."""

_TOKEN = re.compile(r"\\[A-Za-z]+ ?|\\.|[{}]| [+-] |.")


def aligned(equations: Iterable[tuple[str, str, str]]) -> str:
    r"""Return an ``align*`` environment (package amsmath) of equations, each given as (comment, left-hand
    side, right-hand side).

    The signs of equality are aligned. If a left-hand side is broken into several lines, all lines are aligned
    at the left margin and not at the signs.

    >>> print(aligned([("order 1", r"\sum_{i} b_{i}", "1")]))
    \begin{align*}
      % order 1
      \sum_{i} b_{i} &= 1
    \end{align*}
    """
    rows = [(comment, broken(left), right) for comment, left, right in equations]
    flush = any(len(lines) > 1 for _, lines, _ in rows)
    written = []
    for number, (comment, lines, right) in enumerate(rows, start=1):
        end = r" \\" if number < len(rows) else ""
        *above, last = [(r"\quad " if k else "") + line for k, line in enumerate(lines)]
        written += [f"  % {line}" for line in comment.splitlines()]
        written += [rf"  & {line} \\" for line in above]
        written.append(f"  & {last} = {right}{end}" if flush else f"  {last} &= {right}{end}")
    return "\n".join([r"\begin{align*}", *written, r"\end{align*}"])


def broken(latex: str, line: int = LINE) -> list[str]:
    r"""Break a formula into lines about ``line`` characters wide. Breaks are at plus and minus signs inside
    as few brackets as possible.

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
    """Split before plus and minus signs that are inside at most ``within`` brackets and outside braces."""
    terms, brackets, braces = [""], 0, 0
    for token in _TOKEN.findall(latex):
        braces += (token == "{") - (token == "}")
        brackets += (token == r"\Bigl") - (token == r"\Bigr")
        if brackets <= within and not braces and token in (" + ", " - "):
            terms.append("")
        terms[-1] += token
    return terms


def _width(latex: str) -> float:
    """Estimate the width of a formula in characters; fractions and scripts are narrower."""
    scripts = sum(len(script) for script in re.findall(r"[_^]\{([^}]*)\}", latex))
    plain = re.sub(r"[_^]\{[^}]*\}|\\hat|\\Big[lr]", "", latex)
    plain = re.sub(r"\\tfrac\{(\d+)\}\{(\d+)\}", lambda m: max(m.groups(), key=len), plain)
    plain = re.sub(r"\\sum", "xx", plain)
    plain = re.sub(r" [+-] ", "xxx", plain)
    return len(re.sub(r"\\[A-Za-z]+ ?", "x", re.sub(r"[{} ]", "", plain))) + 0.6 * scripts
