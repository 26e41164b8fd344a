"""Lie-Butcher series of products of exponentials, and of the exact flow.

A series has one coefficient for each ordered forest, which is a word of ordered trees. In a product
exp(X_m) ... exp(X_1), each exponent X_J is a linear combination of trees. In the series of this product, the
coefficient of the forest t_1 ... t_n is a sum over all sequences of indices J_1 <= ... <= J_n. The summand of
a sequence is

x_{J_1}(t_1) ... x_{J_n}(t_n) / (r_1! r_2! ...).

Here x_J(t) is the coefficient of the tree t in X_J, and r_1, r_2, ... are the multiplicities of the distinct
indices in the sequence. The factor exp(X_1) and the tree t_1 act first (Owren and Marthinsen, BIT 39 (1999)
116; Hairer, Lubich and Wanner, *Geometric Numerical Integration*, IV.8).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from math import factorial
from typing import Protocol

from orderconds.ring.protocol import Element, Ring
from orderconds.trees.levels import Forest, Tree, branches, trees_of
from orderconds.trees.ordered import ordered_forests

SparseRow = Sequence[tuple[int, Element]]
"""The exponent of one exponential: a linear combination of stage values. The exponent is stored as pairs
(j, c), where c is the non-zero coefficient of the stage value with index j."""


class ForestSeries(Protocol):
    """A function that returns the coefficient of an ordered forest in a series."""

    def __call__(self, forest: Forest) -> Element:
        """Return the coefficient of a forest in the series."""


class ExponentialsSeries:
    """The series of a commutator-free method, which may be implicit.

    The exponentials in ``stages[i]`` map y0 to the point of stage i, and the exponentials in ``update`` map
    y0 to the result of the step. Each exponential is given by its exponent, as pairs (index of a stage,
    coefficient of the stage value). In each product, the exponential with index 0 acts first.

    >>> from orderconds.ring import QQ
    >>> one = ((0, QQ.one),)
    >>> implicit = ExponentialsSeries(QQ, [[one]], [one])
    >>> str(implicit(bytes((0, 1)))), str(implicit(bytes((0, 0))))
    ('1', '1/2')
    """

    def __init__(
        self, ring: Ring, stages: Sequence[Sequence[SparseRow]], update: Sequence[SparseRow]
    ) -> None:
        self._ring = ring
        self._rows: list[SparseRow] = []
        self._places: list[tuple[int, int, int]] = []
        """A stage or update that is the product E_m ... E_1 of exponentials has the partial products I, E_1,
        E_2 E_1, ..., E_m ... E_1. All distinct partial products of all stages and of the update form one list
        P_0, P_1, .... The product P_0 is the identity I. For every other product P_p there is one triple
        (p, q, r). The triple states that P_p = exp(X_r) P_q, where X_r is the exponent ``_rows[r]``."""
        known: dict[tuple[int, int], int] = {}
        numbers: dict[tuple[tuple[int, int], ...], int] = {}

        def end(rows: Sequence[SparseRow]) -> int:
            place = 0
            for row in rows:
                key = tuple((j, id(x)) for j, x in row)
                if key not in numbers:
                    numbers[key] = len(self._rows)
                    self._rows.append(row)
                step = (place, numbers[key])
                if step not in known:
                    known[step] = len(self._places) + 1
                    self._places.append((known[step], *step))
                place = known[step]
            return place

        self._ends = [end(rows) for rows in stages]
        self._end = end(update)
        self._way = self._way_to(self._end)
        self._words: dict[Forest, list[Element]] = {b"": [ring.one] * (len(self._places) + 1)}
        self._updates: dict[Forest, Element] = {}
        self._values: dict[Tree, list[Element]] = {}
        self._letters: dict[Tree, list[Element | None]] = {}
        self._inverse_factorials: list[Element] = [ring.one]

    def __call__(self, forest: Forest) -> Element:
        """Return the coefficient of a forest in the Lie-Butcher series of the step."""
        if forest in self._words:
            return self._words[forest][self._end]
        if forest not in self._updates:
            self._updates[forest] = self._along(forest, self._way)[self._end]
        return self._updates[forest]

    def stage(self, i: int, forest: Forest) -> Element:
        """Return the coefficient of a forest in the product of the exponentials of stage i. Stages are
        counted from 0."""
        return self._word(forest)[self._ends[i]]

    def stage_values(self, tree: Tree) -> list[Element]:
        """Return the coefficients of a tree in the series of the stage values k_1, ..., k_s."""
        values = self._values.get(tree)
        if values is None:
            word = self._word(branches(tree))
            values = self._values[tree] = [word[end] for end in self._ends]
        return values

    def _way_to(self, end: int) -> list[tuple[int, int, int]]:
        way = []
        while end:
            way.append(self._places[end - 1])
            end = way[-1][1]
        return way[::-1]

    def _word(self, word: Forest) -> list[Element]:
        """A partial product consists of the first n exponentials of a stage or of the update, with n >= 0.
        Let P_0, P_1, ... be all partial products. Return a list whose entry p is the coefficient of ``word``
        in P_p."""
        values = self._words.get(word)
        if values is None:
            values = self._words[word] = self._along(word, self._places)
        return values

    def _along(self, word: Forest, places: Sequence[tuple[int, int, int]]) -> list[Element]:
        """Return a list with one entry for each partial product P_0, P_1, ... of exponentials. A triple
        (p, q, r) in ``places`` means that P_p = exp(X_r) P_q, where X_r is the exponent ``self._rows[r]``.
        For each triple, entry p is the coefficient of the non-empty ``word`` in P_p. For products without a
        triple in ``places``, the coefficient is not computed, and the entry is zero."""
        starts = [place for place, level in enumerate(word) if level == 0]
        whole = len(starts)
        # Remove the last r trees from ``word``. The remaining word has the coefficient ``heads[r - 1][p]`` in
        # the partial product P_p.
        heads = [self._word(word[:start]) for start in starts[:0:-1]]
        letters = [self._letter(tree) for tree in trees_of(word)[::-1]]
        factorials = [self._inverse_factorial(r) for r in range(whole + 1)]
        values = [self._ring.zero] * (len(self._places) + 1)
        for place, before, row in places:
            coefficient, run = values[before], None
            for r, letter in enumerate(letters, start=1):
                number = letter[row]
                if number is None:
                    break
                run = number if r == 1 else run * number
                share = run if r == whole else heads[r - 1][before] * run
                coefficient = coefficient + (share if r == 1 else share * factorials[r])
            values[place] = coefficient
        return values

    def _letter(self, tree: Tree) -> list[Element | None]:
        """Each row in ``self._rows`` defines an exponent, which is a linear combination of stage values.
        Return the coefficient of ``tree`` in the Lie-Butcher series of each exponent. A coefficient is None
        if it is proved to be zero."""
        coefficients = self._letters.get(tree)
        if coefficients is None:
            values, zero = self.stage_values(tree), self._ring.zero
            sums = [sum([x * values[j] for j, x in row], zero) for row in self._rows]
            coefficients = [None if self._ring.is_zero(x) is True else x for x in sums]
            self._letters[tree] = coefficients
        return coefficients

    def _inverse_factorial(self, n: int) -> Element:
        while len(self._inverse_factorials) <= n:
            self._inverse_factorials.append(self._ring.rational(1, factorial(len(self._inverse_factorials))))
        return self._inverse_factorials[n]


@lru_cache(maxsize=1 << 16)
def exact_value(forest: Forest) -> Fraction:
    r"""Return the coefficient of a forest in the Lie-Butcher series of the exact flow.

    The exact flow is g(1), where g' = f(g y0) g and g(0) = 1. Let t_1, ..., t_n be the trees of the forest.
    If the root of t_l is removed, a forest remains. Let c_l(s) be the coefficient of this forest in the
    series of g(s). Then the coefficient of t_1 ... t_n in g(1) is the integral of c_1(s_1) ... c_n(s_n) over
    0 < s_1 < ... < s_n < 1.

    >>> str(exact_value(b"\0\1\1\2")), str(exact_value(b"\0\1\2\1"))
    ('1/12', '1/24')
    """
    if not forest:
        return Fraction(1)
    last = forest.rindex(0)
    return exact_value(forest[:last]) * exact_value(branches(forest[last:])) / len(forest)


def forest_values(series: ForestSeries, order: int) -> dict[Forest, Element]:
    """Return a map from each ordered forest w with ``order`` vertices to its coefficient a(w) in a series.

    For matrices, the step is y1 = g1 y0. The matrix g1 is the sum of h^|w| a(w) F(t_k) ... F(t_1) over all
    forests w = t_1 ... t_k. Here |w| is the number of vertices of w. The differential equation is
    y' = f(y) y, where f(y) is a matrix. The matrix F(t) of a tree t is defined recursively. If t has only one
    vertex, F(t) is f(y0). Otherwise, let s_1, ..., s_n be the subtrees at the root of t. Let M_l be the
    constant matrix F(s_l), and let X_l be the derivative along the vector field M_l y. Then
    F(t) = (X_1 ... X_n f)(y0).

    >>> {str(x) for x in forest_values(exact_value, 2).values()}
    {'1/2'}
    """
    return {forest: series(forest) for forest in ordered_forests(order)}


def forest_residuals(series: ForestSeries, ring: Ring, order: int) -> dict[Forest, Element]:
    """Return the coefficients in a series minus the coefficients in the exact flow, for all ordered forests
    with ``order`` vertices. For a method of order ``order`` - 1, the differences are the leading coefficients
    of the local error.

    >>> from orderconds.ring import QQ
    >>> one = ((0, QQ.one),)
    >>> [str(x) for x in forest_residuals(ExponentialsSeries(QQ, [[]], [one]), QQ, 2).values()]
    ['-1/2', '0']
    """
    residuals = {}
    for forest, value in forest_values(series, order).items():
        exact = exact_value(forest)
        residuals[forest] = value - ring.rational(exact.numerator, exact.denominator)
    return residuals
