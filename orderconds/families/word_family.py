"""Families with one order condition for each word over an alphabet.

The step of a method is expanded in a series over words, and so is the exact flow. In a word, the letters
appear in the order in which they act. The coefficients of both series satisfy the shuffle relations.
Therefore the coefficients of Lyndon words are independent and determine the coefficients of all words
(Radford 1979; Reutenauer, Free Lie Algebras, Thm 6.1).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cached_property, partial
from math import prod
from typing import TYPE_CHECKING

from orderconds.conditions import OrderCondition
from orderconds.families.base import Family
from orderconds.families.memo import Memo
from orderconds.families.relations import Polynomial, with_relations
from orderconds.formula import Formula
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.products import Method
from orderconds.words.lyndon import lyndon_words
from orderconds.words.radford import in_lyndon_words
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


class WordFamily(Family):
    """A family with one condition for each word. Letters have positive weights. The order of a condition is
    the sum of the weights of the letters in the word."""

    trees = "graded"

    @abstractmethod
    def words(self, order: int) -> tuple[Word, ...]:
        """Return all words whose letters have the total weight ``order``."""

    @abstractmethod
    def exact(self, word: Word) -> Fraction:
        """Return the coefficient of a word in the series of the exact flow."""

    @abstractmethod
    def formula(self, word: Word) -> Formula:
        """Return the left-hand side of the condition that ``word`` defines. The result includes the factor
        ``scale(word)``."""

    @abstractmethod
    def series(self, method: Method, ring: Ring) -> Callable[[Word], Element]:
        """Return a function that maps a word to its coefficient in the series of one step of ``method``. The
        coefficient is an element of ``ring``."""

    @abstractmethod
    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Method:
        """Return a method whose coefficients are random elements of ``ring``. The number of coefficients
        grows with ``order``. With too few coefficients, independent conditions could seem dependent.

        An element of ``ring`` is a vector of n residues, so the result represents n methods.
        """

    def independent(self, order: int) -> tuple[Word, ...]:
        """Return the Lyndon words of weight ``order``. The conditions of Lyndon words are
        independent and imply the conditions of all words."""
        letters = sorted({letter for word in self.words(order) for letter in word})
        return tuple(lyndon_words(letters, order, self.weigh))

    def weigh(self, letter: int) -> int:
        """Return the weight of a letter. By default, letter k has the weight k."""
        return letter

    def scale(self, word: Word) -> int:
        """Return the integer by which both sides of the condition of a word are multiplied."""
        return 1

    def text(self, word: Word) -> str:
        """Return a word as text, with spaces between the letters."""
        return " ".join(map(str, word))

    def polynomial(self, word: Word) -> Polynomial:
        """Express the coefficient of ``word`` as a polynomial in the coefficients of Lyndon words. All these
        coefficients belong to the series of one step."""
        return {tuple(sorted(monomial)): value for monomial, value in in_lyndon_words(word).items()}

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of exactly the given order."""
        return tuple(map(self._condition, self.independent(order)))

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of all words of weight ``order``.

        The attribute ``relation`` of a dependent condition expresses the left-hand side as a polynomial in
        left-hand sides of independent conditions.
        """
        return with_relations(map(self._condition, self.words(order)), self._scaled, self.text)

    @cached_property
    def _memo(self) -> Memo[Callable[[Word], Element]]:
        return Memo(self.series)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the left-hand sides of ``conditions``, evaluated for ``method``. The left-hand side of the
        condition with the key ``word`` is ``scale(word) * series(method, ring)(word)``."""
        series = self._memo(method, ring)
        return tuple(series(c.key) * self.scale(c.key) for c in conditions)

    def _scaled(self, word: Word) -> Polynomial:
        """Express the left-hand side for ``word`` as a polynomial in the left-hand sides for Lyndon words."""
        return {
            monomial: value * self.scale(word) / prod(map(self.scale, monomial))
            for monomial, value in self.polynomial(word).items()
        }

    def _condition(self, word: Word) -> OrderCondition:
        return OrderCondition(
            self.label(),
            sum(map(self.weigh, word)),
            self.text(word),
            partial(self.formula, word),
            self.exact(word) * self.scale(word),
            word,
        )
