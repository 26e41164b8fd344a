"""The series of a Runge-Kutta-Munthe-Kaas method, from its definition in the free associative algebra.

Stage arguments ``u_i = h sum_j a_ij dexpinv_{(r),u_j} k_j``, ``k_j = f(exp(u_j) y0)``, step ``exp(h sum_j
b_j dexpinv_{(r),u_j} k_j)``; dexpinv_{(r),u} x = sum_{k<=r} B_k/k! ad_u^k x with B_1 = -1/2 (HLW IV.8.3).
Letters are ordered trees. In a word the first letter acts first, so the product xy of two elements, in
which y acts first, reads y's word before x's.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache, lru_cache
from itertools import pairwise
from math import comb, factorial

from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import sparse
from orderconds.trees.levels import Forest, Tree, branches


class DexpinvSeries:
    """The series of RKMK with the tableau (A, b) over ``ring``; ``cutoff`` None keeps all of dexpinv.

    Only words shorter than the one asked for enter its value, so implicit tableaux need no iteration.

    >>> from orderconds.ring import QQ
    >>> midpoint = DexpinvSeries(QQ, [[QQ.rational(1, 2)]], [QQ.one])
    >>> str(midpoint(bytes((0, 1, 1))))
    '1/8'
    """

    def __init__(
        self, ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element], cutoff: int | None = None
    ) -> None:
        self._ring, self._cutoff = ring, cutoff
        self._rows = [sparse(ring, row) for row in A] + [sparse(ring, b)]
        self._step = len(b)
        self._powers: dict[tuple[int, int, Forest], Element] = {}
        self._summands: dict[tuple[int, Forest], Element] = {}
        self._exponentials: dict[tuple[int, Forest], Element] = {}
        self._in_ring: dict[int, list[tuple[Element, int, int]]] = {}
        self._inverse_factorials: list[Element] = []

    def __call__(self, forest: Forest) -> Element:
        """Return the value of the step on a forest."""
        return self._exponential(self._step, forest)

    def stage(self, i: int, forest: Forest) -> Element:
        """Return the value on a forest of exp(u_i), which leads to stage i (counted from 0)."""
        return self._exponential(i, forest)

    def argument(self, i: int, word: Forest) -> Element:
        """Return the coefficient of a word in u_i (0-based; i = s means the argument of the step)."""
        return self._power(i, 1, word)

    def _exponential(self, i: int, word: Forest) -> Element:
        """Return the coefficient of ``word`` in exp(u_i)."""
        if not word:
            return self._ring.one
        if (i, word) not in self._exponentials:
            result = self._ring.zero
            for n in range(1, word.count(0) + 1):
                power = self._power(i, n, word)
                result = result + (power if n == 1 else power * self._inverse_factorial(n))
            self._exponentials[i, word] = result
        return self._exponentials[i, word]

    def _power(self, i: int, n: int, word: Forest) -> Element:
        """Return the coefficient of ``word`` in u_i^n."""
        if n == 0 or not word:
            return self._ring.one if n == 0 and not word else self._ring.zero
        if (i, n, word) not in self._powers:
            result = self._ring.zero
            if n == 1:
                for j, weight in self._rows[i]:
                    result = result + weight * self._dexpinv(j, word)
            else:
                for cut in _cuts(word):
                    head = self._power(i, 1, word[:cut])
                    if self._ring.is_zero(head) is not True:
                        result = result + head * self._power(i, n - 1, word[cut:])
            self._powers[i, n, word] = result
        return self._powers[i, n, word]

    def _dexpinv(self, j: int, word: Forest) -> Element:
        """Return the coefficient of ``word`` in dexpinv_{(r),u_j} k_j."""
        if (j, word) not in self._summands:
            ring, result = self._ring, self._ring.zero
            letters = word.count(0)
            terms = self._terms(letters - 1 if self._cutoff is None else min(letters - 1, self._cutoff))
            for place, (first, tree, rest) in enumerate(_pointed(word)):
                before, behind = word[:first], word[rest:]
                inner = ring.zero
                for coefficient, m, n in terms:
                    # ad_u^k x = sum comb(k, m) (-1)^m u^(k-m) x u^m, and u^m, rightmost, acts first. A word
                    # is in u^m only if it has m letters at least, and the empty one in u^0 alone.
                    if bool(m) is bool(place) and m <= place:
                        behind_it = letters - 1 - place
                        if bool(n) is bool(behind_it) and n <= behind_it:
                            term = coefficient * self._power(j, m, before) if m else coefficient
                            inner = inner + (term * self._power(j, n, behind) if n else term)
                if ring.is_zero(inner) is not True:
                    result = result + inner * self._exponential(j, branches(tree))
            self._summands[j, word] = result
        return self._summands[j, word]

    def _terms(self, longest: int) -> list[tuple[Element, int, int]]:
        """Return :func:`dexpinv_terms` with coefficients in the ring."""
        if longest not in self._in_ring:
            self._in_ring[longest] = [
                (self._ring.rational(q.numerator, q.denominator), m, n) for q, m, n in dexpinv_terms(longest)
            ]
        return self._in_ring[longest]

    def _inverse_factorial(self, n: int) -> Element:
        while len(self._inverse_factorials) <= n:
            self._inverse_factorials.append(self._ring.rational(1, factorial(len(self._inverse_factorials))))
        return self._inverse_factorials[n]


@lru_cache(maxsize=64)
def dexpinv_terms(longest: int) -> tuple[tuple[Fraction, int, int], ...]:
    """Return (B_k/k! comb(k, m) (-1)^m, m, k - m) for the terms u^(k-m) x u^m of dexpinv, k <= ``longest``.

    >>> [(str(q), m, n) for q, m, n in dexpinv_terms(1)]
    [('1', 0, 0), ('-1/2', 0, 1), ('1/2', 1, 0)]
    """
    return tuple(
        (bernoulli(k) / factorial(k) * comb(k, m) * (-1) ** m, m, k - m)
        for k in range(longest + 1)
        for m in range(k + 1)
        if bernoulli(k)
    )


@cache  # each number is found from all before it, so that none of them may be forgotten
def bernoulli(k: int) -> Fraction:
    """Return the Bernoulli number B_k, with B_1 = -1/2.

    >>> [str(bernoulli(k)) for k in range(7)]
    ['1', '-1/2', '1/6', '0', '-1/30', '0', '1/42']
    """
    if k == 0:
        return Fraction(1)
    if k > 1 and k % 2:
        return Fraction(0)
    return -sum((comb(k + 1, n) * bernoulli(n) for n in range(k)), Fraction(0)) / (k + 1)


def _cuts(word: Forest) -> list[int]:
    """Return the places that cut a word in two words that are not empty."""
    return [place for place in range(1, len(word)) if word[place] == 0]


def _pointed(word: Forest) -> list[tuple[int, Tree, int]]:
    """Return each letter of a word with the places where it begins and where what follows it begins."""
    cuts = [0, *_cuts(word), len(word)]
    return [(start, word[start:end], end) for start, end in pairwise(cuts)]
