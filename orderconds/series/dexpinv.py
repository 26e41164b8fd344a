"""The series of a Runge-Kutta-Munthe-Kaas method (RKMK), computed from the definition of the method.

The stage arguments are ``u_i = h sum_j a_ij dexpinv_{(r),u_j} k_j`` with ``k_j = f(exp(u_j) y0)``. The step
is ``exp(h sum_j b_j dexpinv_{(r),u_j} k_j)``. Here dexpinv_{(r),u} x = sum_{k<=r} B_k/k! ad_u^k x, where ad_u
x = [u, x]. The numbers B_k are the Bernoulli numbers with B_1 = -1/2 (Hairer, Lubich and Wanner, *Geometric
Numerical Integration*, IV.8.3).

A Lie-Butcher series has a coefficient for each word of ordered trees. Words are read from left to right, so
the leftmost tree acts first. Products of series are read from right to left, so the rightmost factor acts
first.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache, lru_cache
from itertools import pairwise
from math import comb, factorial

from orderconds.ring.protocol import Element, Ring
from orderconds.series.b_series import Sums, sparse
from orderconds.trees.levels import Forest, Tree, branches


class DexpinvSeries:
    """The Lie-Butcher series of a Runge-Kutta-Munthe-Kaas method (RKMK) with the tableau (A, b) over
    ``ring``.

    The series dexpinv is truncated after the power ``cutoff``. If ``cutoff`` is None, the series is not
    truncated. The tableau may be implicit.

    >>> from orderconds.ring import QQ
    >>> midpoint = DexpinvSeries(QQ, [[QQ.rational(1, 2)]], [QQ.one])
    >>> str(midpoint(bytes((0, 1, 1))))
    '1/8'
    """

    def __init__(
        self, ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element], cutoff: int | None = None
    ) -> None:
        self._ring, self._cutoff = ring, cutoff
        # ``_rows[0]`` contains the rows of A, and ``_rows[1]`` contains b.
        self._rows = (Sums([sparse(ring, row) for row in A], ring.zero), Sums([sparse(ring, b)], ring.zero))
        self._stages = len(b)
        self._powers: dict[tuple[int, int, Forest], list[Element]] = {}
        self._summands: dict[Forest, list[Element]] = {}
        self._exponentials: dict[tuple[int, Forest], list[Element]] = {}
        self._in_sight: dict[tuple[int, int], list[tuple[Element, int, int]]] = {}
        self._inverse_factorials: list[Element] = []

    def __call__(self, forest: Forest) -> Element:
        """Return the coefficient of a forest in the Lie-Butcher series of the step."""
        return self._exponential(1, forest)[0]

    def stage(self, i: int, forest: Forest) -> Element:
        """Return the coefficient of a forest in exp(u_i), where u_i is the argument of stage i. Stages are
        counted from 0."""
        return self._exponential(0, forest)[i]

    def argument(self, i: int, word: Forest) -> Element:
        """Return the coefficient of a word in the argument u_i of stage i. Stages are counted from 0. If i
        is ``len(b)``, return the coefficient in the argument u of the update y1 = exp(u) y0."""
        if not word:
            return self._ring.zero
        return self._power(1, 1, word)[0] if i == self._stages else self._power(0, 1, word)[i]

    def _exponential(self, step: int, word: Forest) -> list[Element]:
        """Return a list of coefficients of ``word``. If ``step`` is 0, the list contains the coefficient in
        exp(u_i) for each stage i, where u_i is the argument of stage i. If ``step`` is 1, the list contains
        only the coefficient in exp(u), where u is the argument of the step."""
        if not word:
            return [self._ring.one] * len(self._rows[step])
        values = self._exponentials.get((step, word))
        if values is None:
            values = self._power(step, 1, word)
            for n in range(2, word.count(0) + 1):
                q = self._inverse_factorial(n)
                values = [x + y * q for x, y in zip(values, self._power(step, n, word), strict=True)]
            self._exponentials[step, word] = values
        return values

    def _power(self, step: int, n: int, word: Forest) -> list[Element]:
        """If ``step`` is 0, return a list with one entry for each stage i: the coefficient of ``word`` in the
        power u_i^n, where u_i is the argument of stage i. If ``step`` is 1, return a list with one entry: the
        coefficient of ``word`` in u^n, where u is the argument of the step."""
        values = self._powers.get((step, n, word))
        if values is None:
            if n == 1:
                values = self._rows[step](self._dexpinv(word))
            else:
                values = [self._ring.zero] * len(self._rows[step])
                cuts = _cuts(word)
                for cut in cuts[: len(cuts) + 2 - n]:
                    heads, tails = self._power(step, 1, word[:cut]), self._power(step, n - 1, word[cut:])
                    values = [total + x * y for total, x, y in zip(values, heads, tails, strict=True)]
            self._powers[step, n, word] = values
        return values

    def _dexpinv(self, word: Forest) -> list[Element]:
        """Return the coefficient of ``word`` in the truncated series dexpinv_{u_j} k_j for each stage j."""
        sums = self._summands.get(word)
        if sums is None:
            sums = [self._ring.zero] * self._stages
            pointed = _pointed(word)
            for place, (first, tree, rest) in enumerate(pointed):
                inner = self._around(place, word[:first], len(pointed) - 1 - place, word[rest:])
                if inner is not None:
                    values = self._exponential(0, branches(tree))
                    sums = [total + x * y for total, x, y in zip(sums, inner, values, strict=True)]
            self._summands[word] = sums
        return sums

    def _around(self, before: int, start: Forest, behind: int, end: Forest) -> list[Element] | None:
        """Let exp(u_i) y0 be the value of stage i, and let x be a letter. Consider the word that consists of
        the letters of ``start``, the letter x, and the letters of ``end``, in this order. Return a list with
        one entry for each stage i: the coefficient of this word in the truncated series dexpinv_{u_i} x.
        Return None if no term of the series can contain this word. ``before`` and ``behind`` are the numbers
        of letters in ``start`` and ``end``."""
        values = None
        for q, m, n in self._present(before, behind):
            if m and n:
                around = zip(self._power(0, m, start), self._power(0, n, end), strict=True)
                term = [q * x * y for x, y in around]
            elif m or n:
                term = [q * x for x in (self._power(0, m, start) if m else self._power(0, n, end))]
            else:
                term = [q] * self._stages
            values = term if values is None else [x + y for x, y in zip(values, term, strict=True)]
        return values

    def _present(self, before: int, behind: int) -> list[tuple[Element, int, int]]:
        """Let u be a linear combination of non-empty words. Let (v, x, w) be a word that consists of a word v
        of length ``before``, a letter x, and a word w of length ``behind``. Return the terms of the truncated
        series dexpinv_u x that can contain the word (v, x, w). A word lists the factors of a product from
        right to left. Therefore a term q u^n x u^m can contain the word (v, x, w) if u^m contains v and u^n
        contains w. The method returns the triple (q, m, n) for this term, where q is the coefficient.

        - If ``before`` is zero, m is zero. If ``before`` is positive, m is one of the numbers 1, ...,
          ``before``.
        - If ``behind`` is zero, n is zero. If ``behind`` is positive, n is one of the numbers 1, ...,
          ``behind``.
        """
        terms_kept = self._in_sight.get((before, behind))
        if terms_kept is None:
            longest = before + behind
            terms = dexpinv_terms(longest if self._cutoff is None else min(longest, self._cutoff))
            terms_kept = self._in_sight[before, behind] = [
                (self._ring.rational(q.numerator, q.denominator), m, n)
                for q, m, n in terms
                if m <= before and n <= behind and bool(m) is bool(before) and bool(n) is bool(behind)
            ]
        return terms_kept

    def _inverse_factorial(self, n: int) -> Element:
        while len(self._inverse_factorials) <= n:
            self._inverse_factorials.append(self._ring.rational(1, factorial(len(self._inverse_factorials))))
        return self._inverse_factorials[n]


@lru_cache(maxsize=64)
def dexpinv_terms(longest: int) -> tuple[tuple[Fraction, int, int], ...]:
    """Return the terms q u^n x u^m of dexpinv_u x with m + n <= ``longest``. A triple (q, m, n) contains the
    coefficient, the right exponent m, and the left exponent n.

    The coefficient is q = (-1)^m B_{m+n} / (m! n!) with the Bernoulli numbers B_k. Terms with q = 0 are
    omitted.

    >>> [(str(q), m, n) for q, m, n in dexpinv_terms(1)]
    [('1', 0, 0), ('-1/2', 0, 1), ('1/2', 1, 0)]
    """
    return tuple(
        (bernoulli(k) / factorial(k) * comb(k, m) * (-1) ** m, m, k - m)
        for k in range(longest + 1)
        for m in range(k + 1)
        if bernoulli(k)
    )


@cache  # The cache has no size limit, because the recursion for B_k uses all values B_0, ..., B_(k-1).
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
    """Return the positions at which a word can be divided into two non-empty words."""
    return [place for place in range(1, len(word)) if word[place] == 0]


def _pointed(word: Forest) -> list[tuple[int, Tree, int]]:
    """Divide a word into letters (ordered trees). For each letter ``word[start:end]``, return the triple
    (start, letter, end)."""
    cuts = [0, *_cuts(word), len(word)]
    return [(start, word[start:end], end) for start, end in pairwise(cuts)]
