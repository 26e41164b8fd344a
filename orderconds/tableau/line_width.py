r"""Functions that estimate the printed width of LaTeX formulas, and that break equations into lines for a
two-column article.

All widths are in points, for the font Computer Modern at 10 points.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

COLUMN = 210.0
"""The available width of a line, in points. COLUMN is the column width of the LaTeX class ``article`` (229
points) minus the indentation of a paragraph."""

INDENT = r"\quad "

_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|[{}_^]|.")
_WIDTHS = {
    **dict.fromkeys(("+", "-"), 7.8),
    "=": 13.3,
    **dict.fromkeys(("(", ")", "[", "]"), 4.0),
    **dict.fromkeys((",", "."), 2.8),
    r"\,": 1.67,
    " ": 2.2,
    "&": 0.0,
    r"\!": -1.67,
    r"\cdot": 2.8,
    r"\ldots": 13.3,
    r"\quad": 10.0,
    r"\exp": 18.0,
    r"\text": 0.0,
    r"\hat": 0.0,
    r"\bigl": 0.6,
    r"\bigr": 0.6,
    r"\Omega": 7.3,
}
_OTHER = 5.2
"""The assumed width of a character that is not in ``_WIDTHS``. A digit is 5 points wide, and most letters are
4 to 6 points wide."""

_SMALLER = 0.8
"""The size of characters in a fraction, an index or an exponent, relative to the surrounding text."""

_SMALLEST = 0.68
"""The smallest size of a character relative to normal text."""


def width(latex: str) -> float:
    r"""Return the width of a formula in points.

    >>> width("12") < width(r"\frac{123}{12}") < width("12 + 3") < width(r"\sqrt{12} + 3")
    True
    """
    return _Reader(latex).formula()


class _Reader:
    """Reads the tokens of a formula and adds their widths."""

    def __init__(self, latex: str) -> None:
        self.tokens = _TOKEN.findall(latex)
        self.position = 0

    def formula(self, scale: float = 1.0) -> float:
        """Return the width of the text from the current position up to the closing brace of the current
        group, or up to the end of the formula. ``scale`` is the font size relative to normal text."""
        total = 0.0
        while self.position < len(self.tokens):
            token = self._next()
            if token == "}":
                break
            total += self._atom(token, scale)
        return total

    def _atom(self, token: str, scale: float) -> float:
        if token in ("_", "^"):
            return self._argument(self._smaller(scale))
        if token == "{":
            return self.formula(scale)
        if token in (r"\frac", r"\tfrac"):
            return max(self._argument(self._smaller(scale)), self._argument(self._smaller(scale))) + 2.4
        if token == r"\sqrt":
            index = 0.0
            if self.position < len(self.tokens) and self.tokens[self.position] == "[":
                self.position = self.tokens.index("]", self.position) + 1
                index = 2.0
            return 8.4 * scale + index + self._argument(scale)
        return scale * _WIDTHS.get(token, _OTHER)

    @staticmethod
    def _smaller(scale: float) -> float:
        return max(_SMALLER * scale, _SMALLEST)

    def _argument(self, scale: float) -> float:
        return self._atom(self._next(), scale) if self.position < len(self.tokens) else 0.0

    def _next(self) -> str:
        self.position += 1
        return str(self.tokens[self.position - 1])


def at_top(latex: str, token: str) -> bool:
    """Return True if the formula ``latex`` contains ``token`` outside of braces. A token is a LaTeX command
    or a single character.

    >>> at_top("a + b", " "), at_top(r"\\frac{a + b}{c}", " ")
    (True, False)
    """
    return any(outside and x == token for x, outside in _tokens(latex))


def with_small_fractions(latex: str) -> str:
    r"""Return a formula with small fractions: every ``\frac`` outside of braces becomes ``\tfrac``.

    >>> print(with_small_fractions(r"\frac{\frac{1}{2} + x}{3}"))
    \tfrac{\frac{1}{2} + x}{3}
    """
    return "".join(r"\tfrac" if x == r"\frac" and outside else x for x, outside in _tokens(latex))


def _tokens(latex: str) -> Iterator[tuple[str, bool]]:
    """Yield a pair for each token of a formula: the token, and True if the token is outside of braces."""
    depth = 0
    for token in _TOKEN.findall(latex):
        depth += (token == "{") - (token == "}")
        yield token, depth == 0


def lines(left: str, parts: Sequence[str], free: float) -> Iterator[str]:
    r"""Yield the lines of an equation for the LaTeX environment ``aligned``. The right-hand side is the
    concatenation of the strings ``parts``. Line breaks are possible only between two strings. ``free`` is the
    available width for the right-hand side, in points.

    >>> list(lines("x", ["a + b", " + c"], 30))
    ['x &= a + b', '&\\quad  + c']
    """
    line, used = f"{left} &= ", 0.0
    for part in parts:
        size = width(part)
        if used and used + size > free:
            yield line.rstrip()
            line, used = f"&{INDENT}", width(INDENT)
        line += part
        used += size
    yield line.rstrip()


def separated(entries: Sequence[str], opening: str = "(", closing: str = ")") -> list[str]:
    """Return one string for each entry of a list. The joined strings form the list with its brackets.

    >>> separated(["1", "2"])
    ['(1, ', '2)']
    """
    if not entries:
        return [opening + closing]
    *before, last = entries
    parts = [*(f"{entry}, " for entry in before), f"{last}{closing}"]
    return [opening + parts[0], *parts[1:]]
