"""Commutator-free Magnus methods for Y' = A(t) Y.

The step with m exponentials is exp(sum_i beta_mi A_i) ... exp(sum_i beta_1i A_i). Here A_i = h A(c_i h), and
c_i are the nodes.

The letter k of a word denotes X_k in the expansion A(t) = X_1 + t X_2 + .... The order condition of a word
states that the word has the same coefficient in the step as in the exact flow (Blanes and Moan, Appl. Numer.
Math. 56 (2006) 1519; Alvermann and Fehske, J. Comput. Phys. 230 (2011) 5930).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import factorial
from typing import TYPE_CHECKING, ClassVar

from orderconds.errors import InputError
from orderconds.families.base import expect
from orderconds.families.composition import composition_formula
from orderconds.families.exponents import exponent_values
from orderconds.families.magnus import MagnusFamily, random_product
from orderconds.families.registry import register
from orderconds.families.word_family import WordFamily
from orderconds.formula import Formula, coefficient, fresh, index_sum, product
from orderconds.ring.protocol import Element, Ring
from orderconds.series.exponentials import ProductOfExponentials
from orderconds.tableau.products import Magnus, Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work, magnus_work
from orderconds.words.expansions import iterated_integral, words_of_weight
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


@register
class CommutatorFreeMagnusFamily(WordFamily):
    """Commutator-free Magnus methods for Y' = A(t) Y: products of exponentials without commutators.

    >>> for condition in CommutatorFreeMagnusFamily().conditions(3):
    ...     print(condition.tree, condition)
    1 2 sum_{I,i,j} beta_Ii beta_Ij c_j + 2 sum_{I<J,i,j} beta_Ii beta_Jj c_j = 2/3
    3 sum_{I,i} beta_Ii c_i^2 = 1/3
    """

    name = "cf_magnus"
    description = (
        "Commutator-free Magnus methods for Y' = A(t) Y: products of exponentials of linear combinations of "
        "A_i = h A(c_i h)."
    )
    formats = ("magnus",)
    symbols = MagnusFamily.symbols
    implies: ClassVar[Mapping[str, str]] = {"magnus": "a commutator-free Magnus method is a Magnus method"}

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` for a method with commutators or Cayley transforms."""
        product = expect(method, Magnus)
        if product.transform != "exp" or not product.is_commutator_free(ring):
            raise InputError(
                f'map = "{product.transform}"'
                if product.transform != "exp"
                else "an exponent that contains commutators",
                where=f"family {self.name}",
                expected="exponentials of linear combinations of A_i, without commutators",
                hint=f"use the family {'cayley' if product.transform != 'exp' else 'magnus'!r}",
            )

    def work(self, tableau: Tableau) -> Work | None:
        """Return the numbers of nodes and exponentials in one step."""
        return magnus_work(tableau)

    def words(self, order: int) -> tuple[Word, ...]:
        """Return all words of weight ``order``. Letters are positive integers, and the weight of a word is
        the sum of its letters."""
        return tuple(words_of_weight(order))

    def exact(self, word: Word) -> Fraction:
        """Return the coefficient of a word in the series of the exact flow. This coefficient is an iterated
        integral of powers of t."""
        return iterated_integral(word)

    def scale(self, word: Word) -> int:
        """Return n! for a word of length n, so that the numbers in :meth:`formula` are integers."""
        return factorial(len(word))

    def formula(self, word: Word) -> Formula:
        """Return an index sum: the left-hand side of the condition of a word.

        The indices I, J, ... number the exponentials, and i, j, ... number the nodes.
        """
        return composition_formula(word, _exponential, "J")

    def series(self, method: Method, ring: Ring) -> Callable[[Word], Element]:
        """Return a function that maps each word to its coefficient in the series of one step."""
        rows = exponent_values(ring, expect(method, Magnus))
        return ProductOfExponentials(ring, len(rows), lambda J, k: rows[J]((k,)))

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Magnus:
        """Return a product of ``order`` exponentials with random exponents."""
        return random_product(ring, generator, order, "exp")


def _exponential(letters: Word, J: str) -> tuple[Formula, int]:
    factors = []
    for k in letters:
        i = fresh()
        powers = [coefficient("c", i)] * (k - 1)
        factors.append(index_sum((i,), (), product(coefficient("beta", J, i), *powers)))
    return product(*factors), factorial(len(letters))
