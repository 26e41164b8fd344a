"""Exponents of methods for Y' = A(t) Y as series over words.

The exponents are linear combinations of products of the values A_i = h A(c_i h), where c_i are the nodes. If
A(t) = X_1 + t X_2 + ..., then A_i = sum_k c_i^(k-1) h^k X_k. The word (k_1, ..., k_m) denotes the product
X_{k_m} ... X_{k_1}.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, partial

from orderconds.ring.protocol import Element, Ring
from orderconds.series.linear_flow import Values
from orderconds.tableau.brackets import Combination, Product, Term, extents
from orderconds.tableau.products import Magnus
from orderconds.words.shuffle import Word


def node_powers(ring: Ring, c: Sequence[Element]) -> Callable[[int, int], Element]:
    """Return the function (i, n) -> c_i^n for the given nodes c_i.

    >>> from orderconds.ring import QQ
    >>> node_powers(QQ, [QQ.rational(1, 2)])(0, 3)
    1/8
    """

    @cache
    def power(i: int, n: int) -> Element:
        return ring.one if n == 0 else power(i, n - 1) * c[i]

    return power


def exponent_values(ring: Ring, method: Magnus) -> tuple[Values, ...]:
    """Return, for each exponent of a method, the function that maps a word to its coefficient.

    The functions are in the order in which the exponentials act.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau.brackets import parse
    >>> commutator = Magnus((QQ.zero, QQ.one), (((parse("[2,1]", ""), QQ.one),),))
    >>> (value,) = exponent_values(QQ, commutator)
    >>> value((1, 2)), value((2, 1)), value((1,))
    (1, -1, 0)
    """
    power = node_powers(ring, method.c)
    elements = dict(method.elements)
    extent = extents(elements)

    def sum_over_cuts(first: Term, then: Term, word: Word) -> Element:
        """Return the coefficient of ``word`` in the product of two terms. The term ``first`` acts first."""
        result = ring.zero
        (least, most), (low, high) = extent(first), extent(then)
        for k in range(max(least, len(word) - high), min(most, len(word) - low) + 1):
            result = result + value(first, word[:k]) * value(then, word[k:])
        return result

    @cache
    def value(term: Term, word: Word) -> Element:
        if isinstance(term, int):
            return power(term, word[0] - 1) if len(word) == 1 else ring.zero
        if isinstance(term, str):
            return combination(elements[term], word)
        if isinstance(term, Product):
            *others, first = term.factors
            return sum_over_cuts(first, Product(tuple(others)), word) if others else value(first, word)
        return sum_over_cuts(term.right, term.left, word) - sum_over_cuts(term.left, term.right, word)

    def combination(terms: Combination, word: Word) -> Element:
        result = ring.zero
        for term, scale in terms:
            least, most = extent(term)
            if least <= len(word) <= most:
                result = result + scale * value(term, word)
        return result

    return tuple(cache(partial(combination, terms)) for terms in method.exponents)
