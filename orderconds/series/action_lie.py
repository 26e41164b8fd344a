"""The action series of variational Runge-Kutta-Munthe-Kaas methods (VRKMK). The group element of each stage,
and of the update, is one exponential of a Lie series in the stage velocities.

The exponent of stage i is ``X_i = h sum_j a_ij dexpinv_{(r),X_j} xi_j``. In the exponent ``Y`` of the update,
b_j replaces a_ij (Bogfjellmo and Marthinsen, equation (3.16)). Here xi_j is the velocity of stage j, and
dexpinv_{(r),X} is dexpinv_X truncated after the r-th power of X.

The exponents are expanded in words of trees (:mod:`orderconds.series.action`). If one velocity xi_j is
replaced by xi_j + x with an additional letter x, the exponents also contain words (u, x, v), where u and v
are words of trees. The momentum of each stage is a sum over trees. The coefficients in this sum are computed
from the coefficients of the words (u, x, v).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from math import comb, factorial

from orderconds.ring.protocol import Element, Ring
from orderconds.series.action import ActionSeries, Exponential, Stages
from orderconds.series.action_trees import Word
from orderconds.series.b_series import Sums, sparse
from orderconds.series.dexpinv import dexpinv_terms

Terms = tuple[tuple[Fraction, int, int], ...]
"""The terms of dexpinv_X xi. A triple (q, m, n) denotes the term q X^n xi X^m. The rightmost factor of a
product acts first. Hence X^m acts before xi, and X^n acts after xi."""

Varied = dict[int, Element]
"""A map from stage indices to coefficients. If a key is missing, the coefficient is zero."""


class MuntheKaasActionSeries(ActionSeries):
    """The action series of the variational Runge-Kutta-Munthe-Kaas method (VRKMK) of a tableau (A, b). The
    series dexpinv_X is truncated after the r-th power of X, where r is ``cutoff``. If ``cutoff`` is None, the
    series is not truncated.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.action_enumeration import velocities
    >>> midpoint = MuntheKaasActionSeries(QQ, [[QQ.rational(1, 2)]], [QQ.one], cutoff=0)
    >>> [str(midpoint.condition(tree)) for tree in velocities(2)]  # o(o), o(|f(*)), o(|L(o))
    ['1/2', '1/2', '1/2']
    """

    def __init__(
        self, ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element], cutoff: int | None
    ) -> None:
        super().__init__(ring, b)
        self._cutoff = cutoff
        # ``_rows[0]`` contains the rows of A, and ``_rows[1]`` contains the row b.
        self._rows: tuple[list[Exponential], ...] = ([sparse(ring, row) for row in A], [sparse(ring, b)])
        self._sums = tuple(Sums(rows, ring.zero) for rows in self._rows)
        self._powers: dict[tuple[int, int, Word], Stages] = {}
        self._varied_powers: dict[tuple[int, int, Word, Word], list[Varied]] = {}
        self._summands: dict[Word, Stages] = {}
        self._varied_summands: dict[tuple[Word, Word], list[Varied]] = {}
        self._exponentials: dict[tuple[int, Word], Stages] = {}
        self._varied_exponentials: dict[tuple[int, Word, Word], list[Varied]] = {}
        self._in_sight: dict[tuple[int, int], list[tuple[Element, int, int]]] = {}
        self._inverse_factorials: list[Element] = []

    def coefficient(self, row: int, word: Word) -> Element:
        """Return the coefficient of a word in the group element of stage ``row``. If ``row`` is the number of
        stages, return the coefficient in the group element of the update."""
        update, place = (1, 0) if row == self.stages else (0, row)
        return self._exponential(update, word)[place] if word else self.ring.one

    def stage_coefficients(self, word: Word) -> Stages:
        """Return the coefficient of ``word`` in exp(X_i) for each stage i."""
        return self._exponential(0, word) if word else [self.ring.one] * self.stages

    def insertion(self, row: int, stage: int, before: Word, after: Word) -> Element:
        """The letters of words are trees. The velocity xi of stage ``stage`` is a linear combination of
        letters. Replace xi by xi + x, where x is an additional letter. Then expand the group element with
        index ``row`` (0, ..., s - 1 for the s stages, and s for the update). Return the coefficient of the
        word that consists of the letters ``before``, the letter x, and the letters ``after``."""
        update, place = (1, 0) if row == self.stages else (0, row)
        return self._varied_exponential(update, before, after)[place].get(stage, self.ring.zero)

    def _stage_insertions(self, before: Word, after: Word) -> list[Stages]:
        zero, every = self.ring.zero, range(self.stages)
        rows = self._varied_exponential(0, before, after)
        return [[row.get(i, zero) for i in every] for row in rows]

    def _exponential(self, update: int, word: Word) -> Stages:
        values = self._exponentials.get((update, word))
        if values is None:
            values = self._power(update, 1, word)
            for n in range(2, len(word) + 1):
                q = self._inverse_factorial(n)
                values = [x + y * q for x, y in zip(values, self._power(update, n, word), strict=True)]
            self._exponentials[update, word] = values
        return values

    def _varied_exponential(self, update: int, before: Word, after: Word) -> list[Varied]:
        """Return coefficients of the word (``before``, x, ``after``), as a list of maps (:data:`Varied`).

        The keys of each map are stages i. For key i, a new letter x is added to the velocity of stage i.

        - If ``update`` is 0, the list has one map for each stage j. The value for key i is the coefficient of
          the word in the group element of stage j.
        - If ``update`` is 1, the list has one map. The value for key i is the coefficient of the word in the
          group element of the update.
        """
        key = (update, before, after)
        totals = self._varied_exponentials.get(key)
        if totals is None:
            totals = [dict(row) for row in self._varied_power(update, 1, before, after)]
            for n in range(2, len(before) + len(after) + 2):
                q = self._inverse_factorial(n)
                for total, power in zip(totals, self._varied_power(update, n, before, after), strict=True):
                    _add(total, [(i, x * q) for i, x in power.items()])
            self._varied_exponentials[key] = totals
        return totals

    def _power(self, update: int, n: int, word: Word) -> Stages:
        """If ``update`` is 0, return a list with one entry for each stage i: the coefficient of ``word`` in
        X_i^n, where exp(X_i) is the group element of stage i. If ``update`` is 1, return a list with one
        entry: the coefficient of ``word`` in Y^n, where exp(Y) is the group element of the update."""
        values = self._powers.get((update, n, word))
        if values is None:
            if n == 1:
                values = self._sums[update](self._summand(word))
            else:
                values = [self.ring.zero] * len(self._rows[update])
                for cut in range(1, len(word) - n + 2):
                    heads, tails = self._power(update, 1, word[:cut]), self._power(update, n - 1, word[cut:])
                    values = [total + x * y for total, x, y in zip(values, heads, tails, strict=True)]
            self._powers[update, n, word] = values
        return values

    def _varied_power(self, update: int, n: int, before: Word, after: Word) -> list[Varied]:
        key = (update, n, before, after)
        totals = self._varied_powers.get(key)
        if totals is None:
            totals = [{} for _ in self._rows[update]]
            if n == 1:
                summands = self._varied_summand(before, after)
                for total, row in zip(totals, self._rows[update], strict=True):
                    for j, a in row:
                        _add(total, [(i, a * x) for i, x in summands[j].items()])
            else:
                self._add_products(totals, update, n, before, after)
            self._varied_powers[key] = totals
        return totals

    def _add_products(self, totals: list[Varied], update: int, n: int, before: Word, after: Word) -> None:
        """Add the result of :meth:`_varied_power` to ``totals``. The power n must be at least 2."""
        for cut in range(1, len(before) + len(after) + 3 - n):
            rest = cut - len(before) - 1
            if rest >= 0:
                varied = self._varied_power(update, 1, before, after[:rest])
                plain = self._power(update, n - 1, after[rest:])
            else:
                plain = self._power(update, 1, before[:cut])
                varied = self._varied_power(update, n - 1, before[cut:], after)
            for total, power, y in zip(totals, varied, plain, strict=True):
                _add(total, [(i, x * y) for i, x in power.items()])

    def _summand(self, word: Word) -> Stages:
        """Return a list with one entry for each stage j: the coefficient of ``word`` in the series for
        dexpinv_{X_j} xi_j. Here xi_j is the velocity of stage j, and exp(X_j) is the group element of stage
        j. The method :meth:`_terms` defines the series."""
        values = self._summands.get(word)
        if values is None:
            values = [self.ring.zero] * self.stages
            for place, letter in enumerate(word):
                inner = self._around(word[:place], word[place + 1 :])
                if inner is not None:
                    values = [
                        total + x * y for total, x, y in zip(values, inner, self.tau(letter), strict=True)
                    ]
            self._summands[word] = values
        return values

    def _varied_summand(self, before: Word, after: Word) -> list[Varied]:
        totals = self._varied_summands.get((before, after))
        if totals is None:
            totals = [{} for _ in range(self.stages)]
            for place, letter in enumerate(before):
                rows = self._varied_behind(before[:place], before[place + 1 :], after)
                self._add_multiples(totals, rows, self.tau(letter))
            for j, x in enumerate(self._around(before, after) or ()):
                _add(totals[j], [(j, x)])
            for place, letter in enumerate(after):
                rows = self._varied_before(before, after[:place], after[place + 1 :])
                self._add_multiples(totals, rows, self.tau(letter))
            self._varied_summands[before, after] = totals
        return totals

    def _add_multiples(self, totals: list[Varied], rows: list[Varied], scales: Stages) -> None:
        for total, row, scale in zip(totals, rows, scales, strict=True):
            _add(total, [(i, x * scale) for i, x in row.items()])

    def _around(self, before: Word, behind: Word) -> Stages | None:
        """Let exp(X_j) be the group element of stage j, and let z be a letter that does not occur in X_j.
        Consider the word that consists of the letters ``before``, the letter z, and the letters ``behind``.
        Return a list with one entry for each stage j: the coefficient of this word in the series for
        dexpinv_{X_j} z (:meth:`_terms`). Return None if no term of the series can contain this word."""
        values = None
        for q, m, n in self._present(len(before), len(behind)):
            if m and n:
                around = zip(self._power(0, m, before), self._power(0, n, behind), strict=True)
                term = [q * x * y for x, y in around]
            elif m or n:
                powers = self._power(0, m, before) if m else self._power(0, n, behind)
                term = [q * x for x in powers]
            else:
                term = [q] * self.stages
            values = term if values is None else [x + y for x, y in zip(values, term, strict=True)]
        return values

    def _varied_before(self, before: Word, after: Word, behind: Word) -> list[Varied]:
        """Return a list with one map (:data:`Varied`) for each stage j. The map takes each stage i to a
        coefficient w_ij. The coefficient is defined in three steps:

        1. Add a new letter x to the velocity of stage i.
        2. With this changed velocity, compute the exponent of the group element of stage j. Let X_ij be the
           result.
        3. Apply the series dexpinv_{X_ij} (:meth:`_terms`) to another new letter z. In the result, w_ij is
           the coefficient of the word that consists of the letters ``before``, the letter x, the letters
           ``after``, the letter z, and the letters ``behind``."""
        totals: list[Varied] = [{} for _ in range(self.stages)]
        for q, m, n in self._present(len(before) + 1 + len(after), len(behind)):
            varied = self._varied_power(0, m, before, after)
            last = self._power(0, n, behind) if n else None
            for j, (total, power) in enumerate(zip(totals, varied, strict=True)):
                _add(total, [(i, q * x * last[j] if last else q * x) for i, x in power.items()])
        return totals

    def _varied_behind(self, first: Word, before: Word, after: Word) -> list[Varied]:
        """Return the coefficients of :meth:`_varied_before` for another word. This word consists of the
        letters ``first``, the letter z, the letters ``before``, the letter x, and the letters ``after``."""
        totals: list[Varied] = [{} for _ in range(self.stages)]
        for q, m, n in self._present(len(first), len(before) + 1 + len(after)):
            scales = [q * x for x in self._power(0, m, first)] if m else [q] * self.stages
            for total, y, power in zip(totals, scales, self._varied_power(0, n, before, after), strict=True):
                _add(total, [(i, y * x) for i, x in power.items()])
        return totals

    def _present(self, before: int, behind: int) -> list[tuple[Element, int, int]]:
        known = self._in_sight.get((before, behind))
        if known is None:
            known = self._in_sight[before, behind] = [
                (self.ring.rational(q.numerator, q.denominator), m, n)
                for q, m, n in self._terms(before + behind)
                if m <= before and n <= behind and bool(m) is bool(before) and bool(n) is bool(behind)
            ]
        return known

    def _inverse_factorial(self, n: int) -> Element:
        while len(self._inverse_factorials) <= n:
            self._inverse_factorials.append(self.ring.rational(1, factorial(len(self._inverse_factorials))))
        return self._inverse_factorials[n]

    def _terms(self, most: int) -> Terms:
        """Return the terms of the truncated series dexpinv_X xi. Terms with more than ``most`` factors X are
        omitted."""
        return dexpinv_terms(most if self._cutoff is None else min(most, self._cutoff))


def _add(total: Varied, terms: Iterable[tuple[int, Element]]) -> None:
    for i, x in terms:
        total[i] = total[i] + x if i in total else x


class PadeActionSeries(MuntheKaasActionSeries):
    """The action series of variational Runge-Kutta-Munthe-Kaas methods with a truncated series dexp.

    Let dexp_{(r),X} be the sum of ad_X^j / (j + 1)! over j = 0, ..., r, where r is ``cutoff``. The exponent
    of stage i is X_i = h sum_j a_ij v_j. The vector v_j solves the equation dexp_{(r),X_j} v_j = xi_j, where
    xi_j is the velocity of stage j.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.action_enumeration import velocities
    >>> midpoint = PadeActionSeries(QQ, [[QQ.rational(1, 2)]], [QQ.one], cutoff=1)
    >>> [str(midpoint.condition(tree)) for tree in velocities(2)]
    ['1/2', '1/2', '1/2']
    """

    def _terms(self, most: int) -> Terms:
        return pade_terms(self._cutoff or 0, most)


@lru_cache(maxsize=64)
def pade_terms(cutoff: int, most: int) -> Terms:
    """Solve the equation dexp_{(r),X} v = xi, and return the terms of v up to degree ``most`` in X. The map
    dexp_{(r),X} is dexp_X truncated after the r-th power of X, where r is ``cutoff``. A triple (q, m, n)
    denotes the term q X^n xi X^m. In this term, X^m acts first, and X^n acts last.

    Let S(z) be the sum of z^j/(j+1)! for j = 0, ..., r, and let c_k be the coefficient of z^k in the power
    series of 1/S(z). The coefficient of the term X^n xi X^m is q = (-1)^m comb(m + n, m) c_{m+n}. Terms with
    q = 0 are omitted.

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
