"""Words as polynomials in Lyndon words, with the shuffle product as multiplication (Radford 1979).

Every word w is a concatenation l_1^(i_1) ... l_k^(i_k) of powers of Lyndon words l_1 > ... > l_k. Let S be
the shuffle product of i_1 copies of l_1, ..., and i_k copies of l_k. Then S / (i_1! ... i_k!) is the sum of w
and a combination of smaller words (Reutenauer, Free Lie Algebras, Thm 6.1).

In a group-like series, the coefficient of a shuffle product is the product of the coefficients of the
factors.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from functools import lru_cache
from math import factorial, prod

from orderconds.words.lyndon import lyndon_factors
from orderconds.words.shuffle import Word, shuffle

Monomial = tuple[Word, ...]
"""The factors of a shuffle product of Lyndon words, in non-increasing order."""


@lru_cache(maxsize=1 << 14)
def in_lyndon_words(word: Word) -> dict[Monomial, Fraction]:
    """Return a word as a polynomial in Lyndon words, where the product is the shuffle product (Reutenauer,
    Thm 6.1). Letters are compared by Python's operator ``<``.

    >>> for monomial, value in in_lyndon_words(("B", "A")).items():
    ...     print(value, *("".join(word) for word in monomial))
    1 B A
    -1 AB
    """
    factors = tuple(lyndon_factors(word))
    if len(factors) <= 1:
        return {factors: Fraction(1)}
    shuffled: Counter[Word] = Counter({(): 1})
    for factor in factors:
        shuffled = _shuffled(shuffled, factor)
    repeats = prod(map(factorial, Counter(factors).values()))
    result: dict[Monomial, Fraction] = {factors: Fraction(1, repeats)}
    for other, times in shuffled.items():
        if other != word:
            for monomial, value in in_lyndon_words(other).items():
                result[monomial] = result.get(monomial, Fraction(0)) - Fraction(times, repeats) * value
    return {monomial: value for monomial, value in result.items() if value}


def _shuffled(words: Counter[Word], factor: Word) -> Counter[Word]:
    result: Counter[Word] = Counter()
    for word, times in words.items():
        for shuffled, again in shuffle(word, factor).items():
            result[shuffled] += times * again
    return result
