"""The Lie-Butcher series of a step in which the arguments of exponentials contain brackets.

In a word of ordered trees, the leftmost letter acts first. In a product of series, the rightmost factor acts
first.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import factorial

from orderconds.ring.protocol import Element, Ring
from orderconds.series.brackets import BracketProgram, Name
from orderconds.trees.levels import Forest, branches


class BracketedSeries:
    """The Lie-Butcher series of one step of a :class:`BracketProgram`, with coefficients in ``ring``. The
    series is called with an ordered forest and returns the coefficient of the forest.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.brackets import fewest_brackets
    >>> midpoint = fewest_brackets(QQ, [[QQ.zero] * 2, [QQ.rational(1, 2), QQ.zero]], [QQ.zero, QQ.one], 2)
    >>> str(BracketedSeries(QQ, midpoint)(b"\\0\\1"))
    '1/2'
    """

    def __init__(self, ring: Ring, program: BracketProgram) -> None:
        self._ring, self._program = ring, program
        self._rows = [*program.stages, program.update]
        self._brackets: dict[tuple[int, Forest], Element] = {}
        self._powers: dict[tuple[int, int, Forest], Element] = {}

    def __call__(self, forest: Forest) -> Element:
        """Return the coefficient of a forest in the Lie-Butcher series of the step."""
        return self.stage(len(self._rows) - 1, forest)

    def stage(self, i: int, forest: Forest) -> Element:
        """Return the coefficient of a forest in exp(u_i). Let s be the number of stages. For i = 0, ...,
        s - 1, exp(u_i) is the exponential of stage i, counted from 0. For i = s, exp(u_i) is the exponential
        of the step."""
        result = self._ring.zero if forest else self._ring.one
        for n in range(1, forest.count(0) + 1):
            result = result + self._power(i, n, forest) * self._ring.rational(1, factorial(n))
        return result

    def _power(self, i: int, n: int, word: Forest) -> Element:
        """Return the coefficient of a word in u_i^n. Let s be the number of stages. For i = 0, ..., s - 1,
        exp(u_i) is the exponential of stage i, counted from 0. For i = s, exp(u_i) is the exponential of the
        step."""
        if n == 1:
            return self._combination(self._rows[i], word)
        if (i, n, word) not in self._powers:
            result = self._ring.zero
            for cut in _cuts(word):
                result = result + self._power(i, 1, word[:cut]) * self._power(i, n - 1, word[cut:])
            self._powers[i, n, word] = result
        return self._powers[i, n, word]

    def _combination(self, row: Mapping[Name, Element], word: Forest) -> Element:
        result = self._ring.zero
        for (kind, number), x in row.items():
            if kind == "B":
                result = result + x * self._bracket(number, word)
            elif word.count(0) == 1:
                result = result + x * self.stage(number, branches(word))
        return result

    def _bracket(self, r: int, word: Forest) -> Element:
        if (r, word) not in self._brackets:
            left, right = self._program.brackets[r]
            result = self._ring.zero
            for cut in _cuts(word):
                first, then = word[:cut], word[cut:]
                result = result + self._combination(right, first) * self._combination(left, then)
                result = result - self._combination(left, first) * self._combination(right, then)
            self._brackets[r, word] = result
        return self._brackets[r, word]


def _cuts(word: Forest) -> list[int]:
    """Return the positions at which a word can be divided into two non-empty words."""
    return [place for place in range(1, len(word)) if word[place] == 0]
