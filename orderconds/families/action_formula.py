"""Action conditions as index sums that people read: the tree walked once, symbols instead of numbers.

A word's coefficient in a product of exponentials is a sum over indices ``j_1 <= ... <= j_k`` with 1/run! for
each run of equal ones; here it is written with strict inequalities, one sum for each way of forming runs. A
word that repeats one letter needs none: its coefficient is a power of one sum, divided by k!. That factor is
left out on both sides of a condition (:func:`multiplier`), so that ``sum_i b_i c_i^2 = 1/3`` is printed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from math import factorial, prod

from orderconds.formula import Formula, Power, coefficient, fresh, index_sum, one, product, total
from orderconds.formula.nodes import Relation
from orderconds.series.action_trees import Force, Momenta, Momentum, Velocity, Word


def multiplier(tree: Velocity) -> int:
    """Return the factor that clears the factorials of repeated letters from a tree's condition.

    >>> from orderconds.series.action_trees import velocity
    >>> multiplier(velocity((velocity(), velocity())))
    2
    """
    repeated = factorial(len(tree.word)) if len(set(tree.word)) == 1 else 1
    return repeated * prod(map(multiplier, tree.word)) * prod(map(_momentum_multiplier, tree.momenta))


def _momentum_multiplier(tree: Momentum) -> int:
    if isinstance(tree, Force):
        letters = tree.before + tree.after
        return prod(map(multiplier, letters)) * prod(map(_momentum_multiplier, tree.momenta))
    return prod(map(multiplier, tree.word))


class ActionFormula(ABC):
    """Writes the conditions of a method whose stages and update are products of exponentials.

    Subclasses name the coefficients. ``row`` is the index of a stage, None for the update; ``place`` is the
    index of an exponential in it.
    """

    @abstractmethod
    def place(self) -> str:
        """Return a new index for exponentials."""

    @abstractmethod
    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return the tree's coefficient in one exponent."""

    @abstractmethod
    def whole_exponent(self, row: str, tree: Velocity) -> Formula:
        """Return the sum of :meth:`exponent` over all places of a stage."""

    @abstractmethod
    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of u x v, x where a stage's velocity stands in an exponent."""

    def condition(self, tree: Velocity) -> Formula:
        """Return ``sum_i b_i tau_t(i)`` times :func:`multiplier`."""
        stage = fresh("i")
        return index_sum((stage,), (), product(coefficient("b", stage), self.tau(tree, stage)))

    def tau(self, tree: Velocity, stage: str) -> Formula:
        """Return tau_t at a stage, times its multiplier."""
        return product(self._phi(stage, tree.word), self._psi_product(tree.momenta, stage))

    def _psi_product(self, momenta: Momenta, stage: str) -> Formula:
        return product(*(self._psi(p, stage) for p in momenta))

    def _psi(self, tree: Momentum, stage: str) -> Formula:
        weight = Power(coefficient("b", stage), -1)
        if not isinstance(tree, Force):
            return product(weight, self.through(None, stage, (), tree.word[::-1]))
        other = fresh("i")
        inner = product(
            coefficient("b", other),
            self._psi_product(tree.momenta, other),
            self.through(other, stage, tree.before, tree.after),
        )
        return product(weight, index_sum((other,), (), inner))

    def _phi(self, stage: str, word: Word) -> Formula:
        if len(set(word)) > 1:
            return self.ordered(stage, word, None, None)
        factors = [self.whole_exponent(stage, letter) for letter in word]
        return product(*factors)

    def ordered(self, row: str | None, word: Word, above: str | None, below: str | None) -> Formula:
        """Return a word's coefficient in the exponentials strictly between two places (None: no bound)."""
        if not word:
            return one()
        return total(*(self._runs(row, word, lengths, above, below) for lengths in _compositions(len(word))))

    def _runs(
        self, row: str | None, word: Word, lengths: tuple[int, ...], above: str | None, below: str | None
    ) -> tuple[Fraction, Formula]:
        """Return 1/prod run! and the sum over strictly increasing places for given run lengths."""
        places = [self.place() for _ in lengths]
        bounds = [*([above] if above else []), *places, *([below] if below else [])]
        relations: list[Relation] = [(low, "<", high) for low, high in pairwise(bounds)]
        letters, factors = iter(word), []
        for place, length in zip(places, lengths, strict=True):
            factors += [self.exponent(row, place, next(letters)) for _ in range(length)]
        return Fraction(1, prod(map(factorial, lengths))), index_sum(places, relations, product(*factors))

    def around(self, row: str | None, place: str, before: Word, after: Word) -> Formula:
        """Return the coefficient of u x v with x in the exponential at ``place``, x's own factor left out."""
        terms = []
        for r in range(len(before) + 1):
            for q in range(len(after) + 1):
                run = before[len(before) - r :] + after[:q]
                inside = [self.exponent(row, place, letter) for letter in run]
                earlier = self.ordered(row, before[: len(before) - r], None, place)
                later = self.ordered(row, after[q:], place, None)
                terms.append((Fraction(1, factorial(1 + len(run))), product(earlier, *inside, later)))
        return total(*terms)


class CrouchGrossmanFormula(ActionFormula):
    """One exponential for each a_ij and each b_j: places are stages."""

    def place(self) -> str:
        """Return a new stage index."""
        return fresh("i")

    def exponent(self, row: str | None, place: str, tree: Velocity) -> Formula:
        """Return ``a_ij tau_t(j)`` or ``b_j tau_t(j)``."""
        factor = coefficient("b", place) if row is None else coefficient("a", row, place)
        return product(factor, self.tau(tree, place))

    def whole_exponent(self, row: str, tree: Velocity) -> Formula:
        """Return ``sum_j a_ij tau_t(j)``, ``c_i`` for the leaf."""
        if tree.vertices == 1:
            return coefficient("c", row)
        place = self.place()
        return index_sum((place,), (), self.exponent(row, place, tree))

    def through(self, row: str | None, stage: str, before: Word, after: Word) -> Formula:
        """Return ``a_ji`` or ``b_i`` times the words on both sides of place i."""
        factor = coefficient("b", stage) if row is None else coefficient("a", row, stage)
        return product(factor, self.around(row, stage, before, after))


def _compositions(n: int) -> Iterator[tuple[int, ...]]:
    """Yield the ordered sums that make n, longest first: all different indices come first."""
    if n == 0:
        yield ()
    for first in range(1, n + 1):
        for rest in _compositions(n - first):
            yield (first, *rest)
