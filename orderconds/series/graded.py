"""Products and brackets of polynomials in non-commuting letters.

A polynomial is a map from words in the letters 0, 1, 2, ... to coefficients. The grade of a word is the sum
of the grades of its letters. Words above a given grade are omitted.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from math import factorial
from typing import TypeVar

from orderconds.ring.protocol import Element, Ring
from orderconds.series.dexpinv import bernoulli

Word = tuple[int, ...]
Polynomial = dict[Word, Element]
Key = TypeVar("Key", bound=Hashable)


class GradedAlgebra:
    """The algebra of non-commutative polynomials in letters with the given ``grades``. Words whose grade is
    greater than ``largest`` are set to zero.

    >>> from orderconds.ring import QQ
    >>> algebra = GradedAlgebra(QQ, (1, 2), 3)
    >>> sorted((w, str(x)) for w, x in algebra.bracket({(0,): QQ.one}, {(1,): QQ.one, (0,): QQ.one}).items())
    [((0, 1), '1'), ((1, 0), '-1')]
    """

    def __init__(self, ring: Ring, grades: Sequence[int], largest: int) -> None:
        self.ring, self.grades, self.largest = ring, tuple(grades), largest

    def grade(self, word: Word) -> int:
        """Return the grade of a word: the sum of the grades of its letters."""
        return sum(self.grades[letter] for letter in word)

    def combine(self, *scaled: tuple[Element, Mapping[Word, Element]]) -> Polynomial:
        """Return the sum of the products ``scale * x`` for the given pairs (scale, x), where x is a
        polynomial."""
        result: Polynomial = {}
        for scale, x in scaled:
            for word, value in x.items():
                result[word] = result.get(word, self.ring.zero) + scale * value
        return {word: value for word, value in result.items() if self.ring.is_zero(value) is not True}

    def multiply(self, x: Mapping[Word, Element], y: Mapping[Word, Element]) -> Polynomial:
        """Return the product x y without the words whose grade is greater than ``largest``."""
        result: Polynomial = {}
        heavy = {word: self.grade(word) for word in (*x, *y)}
        for u, a in x.items():
            for v, b in y.items():
                if heavy[u] + heavy[v] <= self.largest:
                    result[u + v] = result.get(u + v, self.ring.zero) + a * b
        return {word: value for word, value in result.items() if self.ring.is_zero(value) is not True}

    def bracket(self, x: Mapping[Word, Element], y: Mapping[Word, Element]) -> Polynomial:
        """Return [x, y] = x y - y x."""
        one = self.ring.one
        return self.combine((one, self.multiply(x, y)), (self.ring.zero - one, self.multiply(y, x)))

    def dexpinv(self, u: Mapping[Word, Element], x: Mapping[Word, Element]) -> Polynomial:
        """Return dexpinv_u x = sum_k B_k/k! ad_u^k x with ad_u x = [u, x] and the Bernoulli numbers B_k
        (Hairer, Lubich and Wanner, *Geometric Numerical Integration*, III.4, (4.3))."""
        result, term = dict(x), dict(x)
        for k in range(1, self.largest):
            term = self.bracket(u, term)
            number = bernoulli(k) / factorial(k)
            scale = self.ring.rational(number.numerator, number.denominator)
            result = self.combine((self.ring.one, result), (scale, term))
        return result

    def cut(self, x: Mapping[Word, Element], limit: int) -> Polynomial:
        """Return the polynomial x without the words whose grade is above ``limit``."""
        return {word: value for word, value in x.items() if self.grade(word) <= limit}


def solve(
    ring: Ring, columns: Sequence[Mapping[Key, Element]], target: Mapping[Key, Element]
) -> list[Element] | None:
    """Return numbers x_n with ``sum_n x_n columns[n] = target``, or None if there is no solution.

    If ``columns[n]`` is a linear combination of earlier columns, x_n is zero. The ring must have division.

    >>> from orderconds.ring import QQ
    >>> [str(x) for x in solve(QQ, [{"a": QQ.rational(2)}, {"a": QQ.one}], {"a": QQ.one})]
    ['1/2', '0']
    """
    keys = list(dict.fromkeys(key for column in (*columns, target) for key in column))
    width = len(columns)
    rows = [[column.get(key, ring.zero) for column in (*columns, target)] for key in keys]
    pivots: list[int] = []
    for n in range(width):
        done = len(pivots)
        pivot_row = next((r for r in range(done, len(rows)) if ring.is_zero(rows[r][n]) is not True), None)
        if pivot_row is None:
            continue
        rows[done], rows[pivot_row] = rows[pivot_row], rows[done]
        pivot = rows[done][n]
        rows[done] = [x if ring.is_zero(x) is True else x / pivot for x in rows[done]]
        for r, row in enumerate(rows):
            if r != done and ring.is_zero(row[n]) is not True:
                factor = row[n]
                rows[r] = [x - factor * y for x, y in zip(row, rows[done], strict=True)]
        pivots.append(n)
    if any(ring.is_zero(row[width]) is not True for row in rows[len(pivots) :]):
        return None
    result = [ring.zero] * width
    for row, n in zip(rows, pivots, strict=False):
        result[n] = row[width]
    return result
