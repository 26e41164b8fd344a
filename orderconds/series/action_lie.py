"""The action series of VRKMK: group elements are single exponentials of a Lie series in the stage velocities.

``X_i = h sum_j a_ij dexpinv_{(r),X_j} xi_j``, the update ``Y`` alike with b_j (3.16). A variation of one
stage's velocity is one more letter: it stands for that stage alone and occurs once, so the coefficient of
``u x v`` is that of a word in which the letter x is written between u and v.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from math import comb, factorial

from orderconds.ring.protocol import Element, Ring
from orderconds.series.action import ActionSeries, Exponential
from orderconds.series.action_trees import Velocity, Word
from orderconds.series.b_series import sparse
from orderconds.series.dexpinv import dexpinv_terms

Terms = tuple[tuple[Fraction, int, int], ...]
"""Coefficients of X^n xi X^m, with m and n."""

Letters = tuple[Velocity | int, ...]
"""A word in which an int, at most one, is the variation of the velocity of that stage."""


class MuntheKaasActionSeries(ActionSeries):
    """The action series of the tableau (A, b) read as VRKMK with dexpinv cut after the power ``cutoff``.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.action_trees import velocities
    >>> midpoint = MuntheKaasActionSeries(QQ, [[QQ.rational(1, 2)]], [QQ.one], cutoff=0)
    >>> [str(midpoint.condition(tree)) for tree in velocities(2)]  # o(o), o(|f(*)), o(|L(o))
    ['1/2', '1/2', '1/2']
    """

    def __init__(
        self, ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element], cutoff: int | None
    ) -> None:
        super().__init__(ring, b)
        self._cutoff = cutoff
        self._rows: list[Exponential] = [sparse(ring, row) for row in (*A, b)]
        self._powers: dict[tuple[int, int, Letters], Element] = {}
        self._summands: dict[tuple[int, Letters], Element] = {}
        self._exponentials: dict[tuple[int, Letters], Element] = {}
        self._in_ring: dict[int, list[tuple[Element, int, int]]] = {}
        self._inverse_factorials: list[Element] = []

    def coefficient(self, row: int, word: Word) -> Element:
        """Return the coefficient of a word in exp(X_i), or exp(Y)."""
        return self._exponential(row, word)

    def insertion(self, row: int, stage: int, before: Word, after: Word) -> Element:
        """Return the coefficient of u x v there, x the variation of that stage's velocity."""
        return self._exponential(row, (*before, stage, *after))

    def _exponential(self, row: int, word: Letters) -> Element:
        if not word:
            return self.ring.one
        key = (row, word)
        if key not in self._exponentials:
            self._exponentials[key] = self._sum(
                self._power(row, n, word) * self._inverse_factorial(n) if n > 1 else self._power(row, 1, word)
                for n in range(1, len(word) + 1)
            )
        return self._exponentials[key]

    def _power(self, row: int, n: int, word: Letters) -> Element:
        """Return the coefficient of a word in X_i^n."""
        if n == 0 or len(word) < n:
            return self.ring.one if n == len(word) else self.ring.zero
        key = (row, n, word)
        if key not in self._powers:
            if n == 1:
                terms = [weight * self._summand(j, word) for j, weight in self._rows[row]]
            else:
                cuts = range(1, len(word) - n + 2)
                terms = [
                    self._power(row, 1, word[:cut]) * self._power(row, n - 1, word[cut:]) for cut in cuts
                ]
            self._powers[key] = self._sum(terms)
        return self._powers[key]

    def _summand(self, j: int, word: Letters) -> Element:
        """Return the coefficient of a word in dexpinv_{(r),X_j} xi_j."""
        key = (j, word)
        if key not in self._summands:
            terms, total, last = self._coefficients(len(word) - 1), self.ring.zero, len(word) - 1
            for place, letter in enumerate(word):
                varied = isinstance(letter, int)
                if varied and letter != j:
                    continue
                before, behind, after = word[:place], word[place + 1 :], last - place
                inner = self.ring.zero
                for q, m, n in terms:
                    # In a word the first letter acts first: X^(k-m) xi X^m reads the word of X^m first. A
                    # power of X has a word's coefficient only if the word is empty where the power is 1.
                    if m <= place and n <= after and bool(m) is bool(place) and bool(n) is bool(after):
                        term = q * self._power(j, m, before) if m else q
                        inner = inner + (term * self._power(j, n, behind) if n else term)
                total = total + (inner if varied else inner * self.tau(letter)[j])  # type: ignore[arg-type]
            self._summands[key] = total
        return self._summands[key]

    def _inverse_factorial(self, n: int) -> Element:
        while len(self._inverse_factorials) <= n:
            self._inverse_factorials.append(self.ring.rational(1, factorial(len(self._inverse_factorials))))
        return self._inverse_factorials[n]

    def _coefficients(self, most: int) -> list[tuple[Element, int, int]]:
        """Return :meth:`_terms` with coefficients in the ring."""
        if most not in self._in_ring:
            terms = self._terms(most)
            self._in_ring[most] = [
                (self.ring.rational(q.numerator, q.denominator), m, n) for q, m, n in terms
            ]
        return self._in_ring[most]

    def _terms(self, most: int) -> Terms:
        """Return (coefficient, m, n) for the terms X^n xi X^m with m + n <= ``most``."""
        return dexpinv_terms(most if self._cutoff is None else min(most, self._cutoff))


class PadeActionSeries(MuntheKaasActionSeries):
    """The action series with the inverse of dexp cut off: dexp_(r),X_j v_j = xi_j, X_i = h sum_j a_ij v_j.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.action_trees import velocities
    >>> midpoint = PadeActionSeries(QQ, [[QQ.rational(1, 2)]], [QQ.one], cutoff=1)
    >>> [str(midpoint.condition(tree)) for tree in velocities(2)]
    ['1/2', '1/2', '1/2']
    """

    def _terms(self, most: int) -> Terms:
        return pade_terms(self._cutoff or 0, most)


@lru_cache(maxsize=64)
def pade_terms(cutoff: int, most: int) -> Terms:
    """Return (q_k comb(k, m) (-1)^m, m, k - m), k <= ``most``, q_k of the inverse of sum_{j<=r} z^j/(j+1)!.

    >>> [(str(q), m, n) for q, m, n in pade_terms(1, 2)]
    [('1', 0, 0), ('-1/2', 0, 1), ('1/2', 1, 0), ('1/4', 0, 2), ('-1/2', 1, 1), ('1/4', 2, 0)]
    """
    inverse = [Fraction(1)]
    for k in range(1, most + 1):
        known = (inverse[k - j] * Fraction(1, factorial(j + 1)) for j in range(1, min(k, cutoff) + 1))
        inverse.append(-sum(known, Fraction(0)))
    return tuple(
        (q * comb(k, m) * (-1) ** m, m, k - m) for k, q in enumerate(inverse) if q for m in range(k + 1)
    )
