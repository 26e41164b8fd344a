"""Cayley methods for Y' = A(t) Y on quadratic groups. One step is the Cayley transform of an element Omega.

The step is Y_1 = cay(Omega) Y_0, where cay(x) = (1 - x/2)^-1 (1 + x/2).

Omega is a sum of brackets and of symmetric sums of products, such as A_i A_j A_k + A_k A_j A_i. Here A_i = h
A(c_i h), and c_i are the nodes. Omega is an element of the algebra {X: X^T P + P X = 0}, where the matrix P
defines the quadratic group.

A word denotes a product. If a word of length n is reversed, its coefficient in Omega is multiplied by
(-1)^(n+1). The conditions of a word and of its reverse are therefore equivalent, and one of them is kept. A
palindrome of even length has the coefficient zero and no condition (Iserles, Found. Comput. Math. 1 (2001)
129; Diele, Lopez and Peluso, Adv. Comput. Math. 8 (1998) 317).
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, ClassVar

from orderconds.families.magnus import MagnusFamily
from orderconds.families.registry import register
from orderconds.families.relations import Polynomial
from orderconds.tableau.brackets import Product
from orderconds.tableau.products import Magnus
from orderconds.words import expansions
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


@register
class CayleyFamily(MagnusFamily):
    """Cayley methods: a step is a Cayley transform cay(Omega) or a product of Cayley transforms. In printed
    conditions, omega_{ij...} is the coefficient of the product ... A_j A_i in Omega.

    >>> for condition in CayleyFamily().conditions(3):
    ...     print(condition.tree, condition)
    3 sum_i omega_i c_i^2 = 1/3
    1 2 sum_{i,j} omega_ij c_j = 1/12
    1 1 1 sum_{i,j,k} omega_ijk = -1/12
    """

    name = "cayley"
    description = (
        "Cayley methods for Y' = A(t) Y on quadratic groups: Y_1 = cay(Omega) Y_0 with the Cayley transform "
        "cay."
    )
    implies: ClassVar[Mapping[str, str]] = {}
    transform = "cay"

    def independent(self, order: int) -> tuple[Word, ...]:
        """Return the words of weight ``order`` whose conditions are independent.

        If a word differs from its reverse, the result contains one of the two words. If a word is a
        palindrome, the result contains it only for odd length.
        """
        return tuple(
            word
            for word in self.words(order)
            if word < word[::-1] or (word == word[::-1] and len(word) % 2 == 1)
        )

    def exact(self, word: Word) -> Fraction:
        """Return the coefficient of a word in Omega, where cay(Omega) is the exact flow."""
        return expansions.cayley(word)

    def polynomial(self, word: Word) -> Polynomial:
        """Return the coefficient of a word in Omega as a multiple of the coefficient of an independent word.

        The method :meth:`independent` returns the independent words.
        """
        if word == word[::-1]:
            return {(word,): Fraction(1)} if len(word) % 2 else {}
        return {(min(word, word[::-1]),): Fraction(1 if word < word[::-1] or len(word) % 2 else -1)}

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Magnus:
        """Return a random method with one Cayley transform."""
        terms = []
        for length in range(1, order + 1):
            for _ in range(2**order):
                nodes = tuple(int(i) for i in generator.integers(0, order, length))
                x = ring.random(generator)
                paired = x if length % 2 else -x
                terms += [(Product(nodes), x), (Product(nodes[::-1]), paired)]
        return Magnus(tuple(ring.random(generator) for _ in range(order)), (tuple(terms),), (), "cay")
