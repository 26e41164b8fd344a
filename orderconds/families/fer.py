"""Fer methods for Y' = A(t) Y. A step is exp(F_1) exp(F_2). A method computes exp(F_2) as one exponential or
as a product of several exponentials.

Let A_i = h A(c_i h), where c_i are the nodes. Then F_1 = sum_i b_i A_i. The terms of F_2 are commutators.
If the commutators in F_2 are expanded, phi_ij is the coefficient of A_j A_i. In this product, A_i acts first.

There is one condition for each Lyndon word. The letter k denotes X_k in A(t) = X_1 + t X_2 + .... Let F be
the integral of A over one step, and let Y be the exact flow. For words with one letter, the conditions
compare F_1 with F. The conditions of longer words compare F_2 with the logarithm of exp(-F) Y.

Sources: Fer (1958); Iserles, Munthe-Kaas, Noersett and Zanna, Acta Numerica 9 (2000) 215, Section 4.3;
Blanes, Casas, Oteo and Ros, J. Phys. A 31 (1998) 259.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, ClassVar, Self

from orderconds.errors import InputError
from orderconds.families.base import expect
from orderconds.families.exponents import exponent_values
from orderconds.families.magnus import MagnusFamily, node_sum
from orderconds.families.registry import register
from orderconds.formula import Formula
from orderconds.ring.protocol import Element, Ring
from orderconds.series.linear_flow import product_logarithm
from orderconds.tableau.brackets import Bracket, Term
from orderconds.tableau.products import Magnus, Method
from orderconds.tableau.record import Tableau
from orderconds.words.expansions import fer_remainder
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


@register
class FerFamily(MagnusFamily):
    """Fer methods. The exponent F_1 contains no commutators. All terms of the other exponents are
    commutators.

    >>> for condition in FerFamily().conditions(3):
    ...     print(condition.tree, condition)
    1 2 sum_{i,j} phi_ij c_j = 1/12
    3 sum_i b_i c_i^2 = 1/3
    """

    name = "fer"
    description = (
        "Fer methods for Y' = A(t) Y: exp(F_1) exp(F_2), where F_1 = sum_i b_i A_i and F_2 contains "
        "only brackets."
    )
    implies: ClassVar[Mapping[str, str]] = {
        "magnus": "the product of the exponentials of a Fer method is equal to a single exponential"
    }

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return None for every tableau.

        A Fer method is also a method of the family ``magnus``. Therefore the tableau file of a Fer method
        should state an order in the family ``magnus``, and no order in the family ``fer``.
        """
        return None

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if ``method`` is not a Fer method.

        A step of a Fer method is a product of exponentials. The exponent that acts last contains no
        commutators, and all terms of the other exponents are commutators.
        """
        super().require(method, ring)
        *others, last = expect(method, Magnus).extents()
        if last[1] > 1 or any(least == 1 for least, _ in others):
            raise InputError(
                "the exponents are not those of a Fer method",
                where=f"family {self.name}",
                expected="the exponent that acts last contains no commutators, and all terms of the other "
                "exponents are commutators",
                hint="use the family 'magnus'",
            )

    def exact(self, word: Word) -> Fraction:
        """Return the right-hand side of the condition of a word.

        For a word that consists of one letter k, the right-hand side is 1/k. For a longer word, the
        right-hand side is the coefficient of the word in log(exp(-F) Y) (see the module docstring).
        """
        return Fraction(1, word[0]) if len(word) == 1 else fer_remainder(word)

    def formula(self, word: Word) -> Formula:
        """Return the left-hand side of the condition of a word as a sum over nodes.

        A step is exp(F_1) exp(F_2). Let A_i = h A(c_i h), where c_i are the nodes. Let b_i be the coefficient
        of A_i in F_1, and let phi_{ij...m} be the coefficient of the product A_m ... A_j A_i in F_2.

        For a word that consists of one letter k, the terms of the sum are b_i c_i^(k-1). For a longer word
        with the letters k_1, k_2, ..., the terms are phi_{ij...m} c_i^(k_1-1) c_j^(k_2-1) ....
        """
        return node_sum("b" if len(word) == 1 else "phi", word)

    def series(self, method: Method, ring: Ring) -> Callable[[Word], Element]:
        """Return a function that maps each word to the left-hand side of its condition.

        For words with one letter, the left-hand sides are coefficients of F_1. For longer words, they are
        coefficients of F_2. The module docstring defines F_1 and F_2.
        """
        *others, last = exponent_values(ring, expect(method, Magnus))
        rest = product_logarithm(ring, others)
        return lambda word: last(word) if len(word) == 1 else rest(word)

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Magnus:
        """Return a random method with two exponentials and random nodes."""
        c = tuple(ring.random(generator) for _ in range(order))
        terms = []
        for depth in range(2, order + 1):
            for _ in range(2**order):
                nodes = [int(i) for i in generator.integers(0, order, depth)]
                term: Term = nodes[0]
                for i in nodes[1:]:
                    term = Bracket(term, i)
                terms.append((term, ring.random(generator)))
        b = tuple((i, ring.random(generator)) for i in range(order))
        return Magnus(c, (tuple(terms), b))
