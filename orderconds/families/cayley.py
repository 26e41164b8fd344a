"""Cayley methods for Y' = A(t) Y on quadratic groups.

The Cayley transform is cay(x) = (1 - x/2)^-1 (1 + x/2). One step is Y_1 = P Y_0, where P is a Cayley
transform or a product of several Cayley transforms. Let Omega be the matrix with cay(Omega) = P.

Omega is a linear combination of the values A_i = h A(c_i h) at the nodes c_i, of commutators such as
A_i A_j - A_j A_i, and of sums such as A_i A_j A_k + A_k A_j A_i.

Let A(t) = X_1 + t X_2 + .... A word is a product of letters, and the letters are the matrices X_k. If the n
letters of a word are reversed, the coefficient of the new word in Omega is (-1)^(n+1) times the coefficient
of the old word (Iserles, Found. Comput. Math. 1 (2001) 129; Diele, Lopez and Peluso, Adv. Comput. Math. 8
(1998) 317).
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
    """Cayley methods. One step is Y_1 = cay(Omega) Y_0, where cay is the Cayley transform.

    In printed conditions, omega_ij is the coefficient of A_j A_i in Omega, and omega_ijk is the coefficient
    of A_k A_j A_i.

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

        A word is in the result if it is smaller than its reverse in lexicographic order. A word that equals
        its reverse is in the result if its length is odd.
        """
        return tuple(
            word
            for word in self.words(order)
            if word < word[::-1] or (word == word[::-1] and len(word) % 2 == 1)
        )

    def exact(self, word: Word) -> Fraction:
        """Return the coefficient of ``word`` in the series Omega. The Cayley transform of Omega is the exact
        flow."""
        return expansions.cayley(word)

    def polynomial(self, word: Word) -> Polynomial:
        """Express the coefficient of ``word`` in the series Omega by coefficients of independent words.

        The method :meth:`independent` returns the independent words. The result is the polynomial x, -x or 0,
        where x is the coefficient of one independent word. The polynomial 0 is an empty dictionary.
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
