"""Lie-Butcher series: values on ordered forests of products of exponentials and of the exact flow.

A forest is a word of ordered trees, the first acting first. For g = exp(X_m) ... exp(X_1) with X_J a
combination of trees, and k = f(g y0), the coefficient of a word is

    sum over J_1 <= ... <= J_k of prod x_{J_l}(t_l) / prod (run lengths)!

and the tree whose branches are that word has this value in k (Owren and Marthinsen, BIT 39 (1999) 116; HLW
IV.8).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import lru_cache
from math import factorial
from typing import Protocol

from orderconds.ring.protocol import Element, Ring
from orderconds.trees.levels import Forest, Tree, branches, trees_of
from orderconds.trees.ordered import ordered_forests

SparseRow = Sequence[tuple[int, Element]]
"""The stages that one exponential combines, each with its coefficient."""


class ForestSeries(Protocol):
    """Anything that has a value on each ordered forest."""

    def __call__(self, forest: Forest) -> Element:
        """Return the value on a forest."""


class WordCoefficients:
    """Coefficients of words of trees in one product of exponentials, the first one acting first.

    ``letter(J, tree)`` is the coefficient of a tree in the exponent of number J. For each word the partial
    sums over the first exponentials are kept, so that one word more costs one sweep over the exponentials.

    >>> from orderconds.ring import QQ
    >>> twice = WordCoefficients(QQ, 2, lambda number, tree: QQ.one)
    >>> str(twice(bytes((0, 0))))  # 1/2 + 1 + 1/2
    '2'
    """

    def __init__(self, ring: Ring, exponentials: int, letter: Callable[[int, Tree], Element]) -> None:
        self._ring, self._letter = ring, letter
        self._prefixes: dict[Forest, tuple[Element, ...]] = {b"": (ring.one,) * (exponentials + 1)}
        self._exponentials = exponentials
        self._inverse_factorials: list[Element] = []

    def __call__(self, word: Forest) -> Element:
        """Return the coefficient of a word."""
        return self._partial(word)[-1]

    def _partial(self, word: Forest) -> tuple[Element, ...]:
        """Return the coefficients of ``word`` in the products of the first 0, 1, ... exponentials."""
        if word not in self._prefixes:
            found = [self._ring.zero]
            starts = [place for place, level in enumerate(word) if level == 0]
            heads = [self._partial(word[:start]) for start in reversed(starts)]
            letters = trees_of(word)[::-1]
            is_zero, whole = self._ring.is_zero, len(letters)
            while len(self._inverse_factorials) <= whole:
                n = len(self._inverse_factorials)
                self._inverse_factorials.append(self._ring.rational(1, factorial(n)))
            for number in range(self._exponentials):
                coefficient, run = found[-1], self._ring.one
                # The last r letters of the word come from this exponential, the others from before it.
                for r, (head, tree) in enumerate(zip(heads, letters, strict=True), start=1):
                    letter = self._letter(number, tree)
                    run = letter if r == 1 else run * letter
                    if is_zero(run) is True:
                        break
                    share = run if r == whole else head[number] * run
                    coefficient = coefficient + (share if r == 1 else share * self._inverse_factorials[r])
                found.append(coefficient)
            self._prefixes[word] = tuple(found)
        return self._prefixes[word]


class ExponentialsSeries:
    """The series of a commutator-free method: products of exponentials of combinations of stage values.

    ``stages[i]`` are the exponentials that lead from y0 to stage i, ``update`` those of the step, each a
    sparse row of coefficients over the stages; the first acts first. Stages may depend on each other in any
    way (implicit).

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
        self._values: dict[Tree, tuple[Element, ...]] = {}
        self._stages = [self._words(rows) for rows in stages]
        self._update = self._words(update)

    def __call__(self, forest: Forest) -> Element:
        """Return the value of the step on a forest."""
        return self._update(forest)

    def stage(self, i: int, forest: Forest) -> Element:
        """Return the value on a forest of the product that leads to stage i (counted from 0)."""
        return self._stages[i](forest)

    def stage_values(self, tree: Tree) -> tuple[Element, ...]:
        """Return the coefficient of a tree in k_1, ..., k_s."""
        if tree not in self._values:
            word = branches(tree)
            self._values[tree] = tuple(words(word) for words in self._stages)
        return self._values[tree]

    def _words(self, rows: Sequence[SparseRow]) -> WordCoefficients:
        known: dict[tuple[int, Tree], Element] = {}

        def letter(number: int, tree: Tree) -> Element:
            if (number, tree) not in known:
                values = self.stage_values(tree)
                known[number, tree] = sum((x * values[j] for j, x in rows[number]), self._ring.zero)
            return known[number, tree]

        return WordCoefficients(self._ring, len(rows), letter)


@lru_cache(maxsize=1 << 16)
def exact_value(forest: Forest) -> Fraction:
    r"""Return the value of the exact flow on a forest, by left grafting.

    The flow g of g' = f(g y0) g has the iterated integral of its letters on each word, the first letter
    earliest; by homogeneity the integral over [0, s] is e s^n for n vertices, and d/ds removes the last
    letter, whose own value is that of the word of its branches.

    >>> str(exact_value(b"\0\1\1\2")), str(exact_value(b"\0\1\2\1"))
    ('1/12', '1/24')
    """
    if not forest:
        return Fraction(1)
    last = forest.rindex(0)
    return exact_value(forest[:last]) * exact_value(branches(forest[last:])) / len(forest)


def forest_values(series: ForestSeries, order: int) -> dict[Forest, Element]:
    """Return the value a(w) of a series on every ordered forest w with ``order`` vertices.

    They predict steps: a function phi has phi(y1) = sum_w h^|w| a(w) (X_1 ... X_k phi)(y0) for w = t_1 ...
    t_k, where X_l differentiates along the fixed element F(t_l) of the Lie algebra and F([t_1 ... t_k]) =
    (X_1 ... X_k f)(y0); for matrices g1 = sum_w h^|w| a(w) F(t_k) ... F(t_1).

    >>> {str(x) for x in forest_values(exact_value, 2).values()}
    {'1/2'}
    """
    return {forest: series(forest) for forest in ordered_forests(order)}


def forest_residuals(series: ForestSeries, ring: Ring, order: int) -> dict[Forest, Element]:
    """Return values less the exact flow's: at order p + 1 the leading coefficients of the local error.

    >>> from orderconds.ring import QQ
    >>> one = ((0, QQ.one),)
    >>> [str(x) for x in forest_residuals(ExponentialsSeries(QQ, [[]], [one]), QQ, 2).values()]
    ['-1/2', '0']
    """
    found = {}
    for forest, value in forest_values(series, order).items():
        exact = exact_value(forest)
        found[forest] = value - ring.rational(exact.numerator, exact.denominator)
    return found
