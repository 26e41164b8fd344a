"""Magnus methods exp(Omega) for Y' = A(t) Y. The exponent Omega is a linear combination of the values
A_i = h A(c_i h) and of their brackets, where c_i are the nodes.

If all brackets are expanded, Omega = sum_i omega_i A_i + sum_{ij} omega_ij A_j A_i + .... In the product
A_j A_i, the factor A_i acts first. If a step is a product of several exponentials, Omega is the logarithm of
the product.

Each condition belongs to a Lyndon word. The letters 1, 2, ... denote the coefficients X_1, X_2, ... of the
series A(t) = X_1 + t X_2 + .... The condition states that the coefficient of the word in Omega equals its
coefficient in the Magnus expansion (Iserles, Munthe-Kaas, Noersett and Zanna, Acta Numerica 9 (2000) 215,
Section 5).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, ClassVar, Self

from orderconds.errors import InputError
from orderconds.families.base import Family, expect
from orderconds.families.exponents import exponent_values
from orderconds.families.registry import get, register
from orderconds.families.relations import Polynomial
from orderconds.families.word_family import WordFamily
from orderconds.formula import Formula, coefficient, fresh, index_sum, product
from orderconds.ring.protocol import Element, Ring
from orderconds.series.linear_flow import product_logarithm
from orderconds.tableau.products import Magnus, Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work, magnus_work
from orderconds.words import expansions
from orderconds.words.radford import in_lyndon_words
from orderconds.words.shuffle import Word

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues


@register
class MagnusFamily(WordFamily):
    """Magnus methods exp(Omega), and products of such exponentials. Omega is a linear combination of the
    values A_i = h A(c_i h) and of their brackets.

    >>> for condition in MagnusFamily().conditions(3):
    ...     print(condition.tree, condition)
    1 2 sum_{i,j} omega_ij c_j = 1/12
    3 sum_i omega_i c_i^2 = 1/3
    """

    name = "magnus"
    description = (
        "Magnus methods for Y' = A(t) Y: the exponential of a linear combination of the values "
        "A_i = h A(c_i h) and of their brackets."
    )
    formats = ("magnus",)
    symbols: ClassVar[Mapping[str, str]] = {
        "omega": r"$\omega_{i\dots j}$ is the coefficient of the product $A_j \cdots A_i$ in $\Omega$, where "
        r"$A_i = h A(c_i h)$",
        "c": r"$c_i$ are the nodes",
        "b": r"$b_i$ are the coefficients of $A_i = h A(c_i h)$ in the exponent $F_1$",
        "phi": r"$\phi_{i\dots j}$ is the coefficient of $A_j \cdots A_i$ in the exponent $F_2$",
        "beta": r"$\beta_{Ii}$ is the coefficient of $A_i = h A(c_i h)$ in exponential $I$",
    }
    implies: ClassVar[Mapping[str, str]] = dict.fromkeys(
        ("cf_magnus", "fer"),
        "a product of exponentials has the same order in the families magnus, cf_magnus and fer",
    )
    transform: ClassVar[str] = "exp"

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if ``method.transform`` and ``self.transform`` differ.
        The possible values are "exp" (exponentials) and "cay" (Cayley transforms)."""
        transform = expect(method, Magnus).transform
        if transform != self.transform:
            raise InputError(
                f'map = "{transform}"',
                where=f"family {self.name}",
                expected=f'map = "{self.transform}"',
                hint=f"use the family {self.for_method(method).name!r}",
            )

    def for_method(self, method: Method) -> Family:
        """Return the family ``magnus`` for a method with exponentials, else the family ``cayley``."""
        return get("magnus" if expect(method, Magnus).transform == "exp" else "cayley")

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if ``tableau`` contains a Magnus method with the map :attr:`transform`, else
        None."""
        method = tableau.method
        return cls() if isinstance(method, Magnus) and method.transform == cls.transform else None

    def work(self, tableau: Tableau) -> Work | None:
        """Return the cost of a step of a Magnus method: the numbers of nodes, commutators and exponentials
        (or Cayley transforms). Equal commutators and equal exponentials are counted once. If ``tableau``
        contains no Magnus method, return None."""
        return magnus_work(tableau)

    def words(self, order: int) -> tuple[Word, ...]:
        """Return all words of weight ``order``. The weight of a word is the sum of its letters."""
        return tuple(expansions.words_of_weight(order))

    def exact(self, word: Word) -> Fraction:
        """Return the coefficient of a word in the Magnus expansion."""
        return expansions.magnus(word)

    def formula(self, word: Word) -> Formula:
        """Return the left-hand side of the condition of a word, for example sum_{i,j} omega_ij c_j for the
        word 1 2. The numbers c_j are the quadrature nodes."""
        return node_sum("omega", word)

    def polynomial(self, word: Word) -> Polynomial:
        """Express the coefficient of ``word`` in Omega as a linear combination of coefficients of Lyndon
        words."""
        return linear_in_lyndon_words(word)

    def series(self, method: Method, ring: Ring) -> Callable[[Word], Element]:
        """Return a function that maps each word to its coefficient in Omega, the logarithm of one step."""
        return product_logarithm(ring, exponent_values(ring, expect(method, Magnus)), self.transform)

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Magnus:
        """Return a random method: a product of ``order`` exponentials, or of ``order`` Cayley transforms."""
        return random_product(ring, generator, order, self.transform)


def node_sum(name: str, word: Word) -> Formula:
    """Return the index sum of a word. There is one summation index for each letter.

    Let p, q, ... be the letters of the word. If ``name`` is "omega", the terms of the sum are
    omega_{ij...} c_i^(p - 1) c_j^(q - 1) ....

    >>> from orderconds.formula import named
    >>> named(node_sum("omega", (2, 1, 3))).text()
    'sum_{i,j,k} omega_ijk c_i c_k^2'
    """
    indices = [fresh() for _ in word]
    powers = [coefficient("c", i) for i, k in zip(indices, word, strict=True) for _ in range(k - 1)]
    return index_sum(indices, (), product(coefficient(name, *indices), *powers))


def linear_in_lyndon_words(word: Word) -> Polynomial:
    """Express the coefficient of ``word`` in a Lie element x as a linear combination of the coefficients of
    Lyndon words in x. The linear combination is the same for all Lie elements x.

    >>> linear_in_lyndon_words((2, 1))
    {((1, 2),): Fraction(-1, 1)}
    """
    return {monomial: value for monomial, value in in_lyndon_words(word).items() if len(monomial) == 1}


def random_product(ring: Residues, generator: np.random.Generator, size: int, transform: str) -> Magnus:
    """Return a random product of ``size`` exponentials (``transform`` is "exp") or Cayley transforms ("cay").

    The number of nodes c_i is also ``size``, and the nodes are random. The argument of each factor is a
    random linear combination of all values A_i = h A(c_i h).

    >>> import numpy as np
    >>> from orderconds.ring import Residues
    >>> random_product(Residues(101, 1), np.random.default_rng(1), 2, "exp").s
    2
    """
    rows = [tuple((i, ring.random(generator)) for i in range(size)) for _ in range(size)]
    return Magnus(tuple(ring.random(generator) for _ in range(size)), tuple(rows), (), transform)
