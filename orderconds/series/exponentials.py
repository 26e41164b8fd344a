"""Coefficients of words in a product of exponentials, over any ring.

Let the exponents X_1, ..., X_m be linear combinations of letters, where x_J(k) is the coefficient of the
letter k in X_J. The word k_1 ... k_n denotes the product k_n ... k_1 of letters, because the first letter of
a word and the rightmost factor of a product act first. The coefficient of this word in the product
exp(X_m) ... exp(X_1) is the sum, over all indices J_1 <= ... <= J_n, of

x_{J_1}(k_1) ... x_{J_n}(k_n) / (r_1! r_2! ...).

A run is a maximal sequence of equal indices, and r_1, r_2, ... are the lengths of the runs of J_1, ..., J_n
(Hairer, Lubich and Wanner, *Geometric Numerical Integration*, III.5; Reutenauer, Free Lie Algebras,
Chapter 3).
"""

from __future__ import annotations

from collections.abc import Callable
from math import factorial

from orderconds.ring.protocol import Element, Ring
from orderconds.words.shuffle import Word


class ProductOfExponentials:
    """The coefficients of words in the product exp(X_(count-1)) ... exp(X_0), where exp(X_0) acts first.

    ``letter(J, k)`` returns the coefficient of letter k in X_J, or None if X_J does not contain letter k.

    >>> from orderconds.ring import QQ
    >>> strang = [(1, QQ.rational(1, 2)), (0, QQ.one), (1, QQ.rational(1, 2))]
    >>> values = ProductOfExponentials(QQ, 3, lambda J, k: strang[J][1] if strang[J][0] == k else None)
    >>> values((0, 1)), values((0, 0, 1))
    (1/2, 1/4)
    """

    def __init__(self, ring: Ring, count: int, letter: Callable[[int, int], Element | None]) -> None:
        self._ring, self._count, self._letter = ring, count, letter
        self._known: dict[int, list[Element | None]] = {}
        self._inverse_factorials: list[Element] = []
        self._partial: dict[Word, list[Element]] = {(): [ring.one] * (count + 1)}

    def __call__(self, word: Word) -> Element:
        """Return the coefficient of a word in the product of all exponentials."""
        return self._sweep(word)[-1]

    def _sweep(self, word: Word) -> list[Element]:
        """Return the coefficients of ``word`` in the products of the first 0, 1, 2, ... exponentials."""
        values = self._partial.get(word)
        if values is None:
            whole = len(word)
            heads = [self._sweep(word[:end]) for end in range(whole - 1, -1, -1)]
            letters = [self._letters(k) for k in word[::-1]]
            factorials = [self._inverse_factorial(r) for r in range(whole + 1)]
            values = [self._ring.zero]
            for J in range(self._count):
                value, run = values[-1], None
                # In summand r, the last r letters of ``word`` come from exp(X_J), and the other letters come
                # from exp(X_(J-1)) ... exp(X_0).
                for r, letter in enumerate(letters, start=1):
                    x = letter[J]
                    if x is None:
                        break
                    run = x if r == 1 else run * x
                    share = run if r == whole else heads[r - 1][J] * run
                    value = value + (share if r == 1 else share * factorials[r])
                values.append(value)
            self._partial[word] = values
        return values

    def _letters(self, k: int) -> list[Element | None]:
        """Return the coefficients of letter k in the exponents X_0, X_1, .... A coefficient is None if the
        exponent does not contain letter k."""
        coefficients = self._known.get(k)
        if coefficients is None:
            coefficients = self._known[k] = [self._letter(J, k) for J in range(self._count)]
        return coefficients

    def _inverse_factorial(self, n: int) -> Element:
        while len(self._inverse_factorials) <= n:
            self._inverse_factorials.append(self._ring.rational(1, factorial(len(self._inverse_factorials))))
        return self._inverse_factorials[n]
