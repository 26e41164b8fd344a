"""Coefficients of words in Magnus, Fer and Cayley expansions and in series of dexp, dexp^-1 and dcay^-1.

The expansions solve Y' = A(t) Y with A(t) = X_1 + t X_2 + t^2 X_3 + .... Letter k denotes X_k and has weight
k. The first letter of a word acts first. Hence the word k_1 ... k_n denotes the product X_{k_n} ... X_{k_1}.
The expansions are evaluated at t = 1.

In the series of dexp_U(X), dexp_U^-1(X) and dcay_U^-1(X), a word denotes the product of its letters in the
written order.

Sources: Iserles, Munthe-Kaas, Noersett and Zanna, Acta Numerica 9 (2000) 215, Sections 4 to 6; Blanes, Casas,
Oteo and Ros, Physics Reports 470 (2009) 151.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate
from math import factorial, prod

from orderconds.words.compositions import compositions
from orderconds.words.convolution import (
    exponential_scales,
    inverse_cayley_scales,
    logarithm_scales,
    power_series,
)
from orderconds.words.shuffle import Series, Word


def iterated_integral(word: Word) -> Fraction:
    """Return the coefficient of a word in Y(1), where Y solves Y' = A(t) Y with Y(0) = I.

    Here A(t) = X_1 + t X_2 + t^2 X_3 + .... The word (k_1, ..., k_n) denotes the product X_{k_n} ... X_{k_1}.
    The coefficient is the integral of s_1^(k_1-1) ... s_n^(k_n-1) over 0 < s_1 < ... < s_n < 1. The integral
    equals the product of 1/(k_1 + ... + k_j) over j = 1, ..., n.

    >>> str(iterated_integral((1, 2)))
    '1/3'
    """
    return Fraction(1, prod(accumulate(word)))


@lru_cache(maxsize=1 << 14)
def magnus(word: Word) -> Fraction:
    """Return the coefficient of a word in the Magnus expansion Omega at t = 1.

    Let Y solve Y' = A(t) Y with Y(0) = I, where A(t) = X_1 + t X_2 + t^2 X_3 + .... Omega is the Lie element
    with Y = exp(Omega). The word (k_1, ..., k_n) denotes the product X_{k_n} ... X_{k_1}. For example, (2, 1)
    denotes X_1 X_2.

    >>> str(magnus((1, 2))), str(magnus((2, 1)))
    ('1/12', '-1/12')
    """
    return Fraction(power_series(iterated_integral, word, logarithm_scales(len(word))))


@lru_cache(maxsize=1 << 14)
def cayley(word: Word) -> Fraction:
    """Return the coefficient of a word in the Cayley expansion Omega at t = 1.

    Let Y solve Y' = A(t) Y with Y(0) = I, where A(t) = X_1 + t X_2 + t^2 X_3 + .... Omega is defined by
    Y = cay(Omega) with the Cayley transform cay(x) = (1 - x/2)^-1 (1 + x/2). Omega satisfies the equation
    Omega' = A - [Omega, A]/2 - Omega A Omega/4 (Iserles 2001, Found. Comput. Math. 1, 129). The word
    (k_1, ..., k_n) denotes the product X_{k_n} ... X_{k_1}. For example, (2, 1) denotes X_1 X_2.

    >>> str(cayley((1, 1))), str(cayley((1, 1, 1)))
    ('0', '-1/12')
    """
    return Fraction(power_series(iterated_integral, word, inverse_cayley_scales(len(word))))


@lru_cache(maxsize=1 << 14)
def fer(n: int, word: Word) -> Fraction:
    """Return the coefficient of a word in F_n(1), where F_n is the n-th exponent in the Fer expansion.

    Let Y solve Y' = A(t) Y with Y(0) = I, where A(t) = X_1 + t X_2 + t^2 X_3 + .... The Fer expansion is
    Y = exp(F_1) exp(F_2) ..., an infinite product of exponentials. The series F_n is the integral of a series
    A_n from 0 to t. Here A_1 = A and A_{n+1} = sum_{k>=1} (-1)^k k/(k+1)! ad_{F_n}^k A_n, where
    ad_F X = F X - X F. In a word, the letter k denotes X_k, and the first letter denotes the rightmost
    factor. For example, the word (2, 1) denotes the product X_1 X_2.

    >>> str(fer(1, (3,))), str(fer(2, (1, 2)))
    ('1/3', '1/12')
    """
    return _fer_field(n, word) / sum(word)


@lru_cache(maxsize=1 << 14)
def fer_remainder(word: Word) -> Fraction:
    """Return the coefficient of a word in log(exp(-F_1) Y), where F_n and Y are defined in :func:`fer`.

    The logarithm equals F_2 + F_3 + ... plus brackets of these series.

    >>> fer_remainder((1, 2)) == fer(2, (1, 2))
    True
    """
    return Fraction(power_series(_after_first, word, logarithm_scales(len(word))))


def dexp(length: int) -> Series:
    """Return the series dexp_U(X) = sum_k ad_U^k X/(k+1)! up to words with ``length`` letters.

    Here ad_U X = U X - X U, and the word UX denotes the product U X.

    >>> {"".join(word): str(value) for word, value in dexp(2).items()}
    {'X': '1', 'UX': '1/2', 'XU': '-1/2'}
    """
    return _adjoint_series(length, lambda k: Fraction(1, factorial(k + 1)))


def dexp_inverse(length: int) -> Series:
    """Return the series dexp_U^{-1}(X) = sum_k B_k/k! ad_U^k X up to words with ``length`` letters.

    Here B_k are the Bernoulli numbers with B_1 = -1/2, and ad_U X = U X - X U. The word UX
    denotes the product U X.

    >>> {"".join(word): str(value) for word, value in dexp_inverse(2).items()}
    {'X': '1', 'UX': '-1/2', 'XU': '1/2'}
    """
    numbers = [Fraction(1)]
    for n in range(1, length):
        # For n > 0, the Bernoulli numbers satisfy sum_{k<=n} B_k/(k! (n + 1 - k)!) = 0.
        numbers.append(-sum((q / factorial(n + 1 - k) for k, q in enumerate(numbers)), Fraction(0)))
    return _adjoint_series(length, numbers.__getitem__)


def dcay_inverse() -> Series:
    """Return dcay_U^{-1}(X) = X - [U, X]/2 - U X U/4, where dcay is the derivative of the Cayley map.

    The words have the letters U and X, and the word UX denotes the product U X.

    >>> {"".join(word): str(value) for word, value in dcay_inverse().items()}
    {'X': '1', 'UX': '-1/2', 'XU': '1/2', 'UXU': '-1/4'}
    """
    half = Fraction(1, 2)
    return {("X",): Fraction(1), ("U", "X"): -half, ("X", "U"): half, ("U", "X", "U"): -half * half}


def words_of_weight(weight: int) -> Iterator[Word]:
    """Yield all words of a given weight over the letters 1, 2, ..., where letter k has weight k. Short words
    come first.

    >>> list(words_of_weight(3))
    [(3,), (1, 2), (2, 1), (1, 1, 1)]
    """
    return compositions(weight)


def expansion(coefficient: Callable[[Word], Fraction], weight: int) -> Series:
    """Return the non-zero terms of a series up to a given weight. ``coefficient`` returns the coefficient of
    a word in the series, as :func:`magnus` does.

    >>> {word: str(value) for word, value in expansion(magnus, 3).items()}
    {(1,): '1', (2,): '1/2', (3,): '1/3', (1, 2): '1/12', (2, 1): '-1/12'}
    """
    words = (word for n in range(1, weight + 1) for word in words_of_weight(n))
    return {word: value for word in words if (value := coefficient(word))}


@lru_cache(maxsize=1 << 14)
def _fer_field(n: int, word: Word) -> Fraction:
    """Return the coefficient of a word in the series A_n(1) (see :func:`fer`)."""
    if n == 1:
        return Fraction(len(word) == 1)
    result = Fraction(0)
    for k in range(1, sum(word) // (2 ** (n - 1) - 1)):
        if value := _fer_bracket(n - 1, k, word):
            result += Fraction((-1) ** k * k, factorial(k + 1)) * value
    return result


@lru_cache(maxsize=1 << 14)
def _fer_bracket(n: int, k: int, word: Word) -> Fraction:
    """Return the coefficient of ``word`` in the series ad_{F_n}^k A_n at t = 1. A_n and F_n are defined in
    :func:`fer`."""
    if k == 0:
        return _fer_field(n, word)
    result = Fraction(0)
    for cut in range(1, len(word)):
        # A word lists the factors of a product in reverse order.
        head, tail = word[:cut], word[cut:]
        result += _fer_bracket(n, k - 1, head) * fer(n, tail) - fer(n, head) * _fer_bracket(n, k - 1, tail)
    return result


def _after_first(word: Word) -> Fraction:
    """Return the coefficient of a word in exp(-F_1) Y, where F_1 and Y are defined in :func:`fer`."""
    result = iterated_integral(word)
    for cut in range(len(word)):
        scale = exponential_scales(len(word) - cut)[-1]
        lasts = prod((Fraction(-1, letter) for letter in word[cut:]), start=Fraction(1))
        result += scale * lasts * (iterated_integral(word[:cut]) if cut else 1)
    return result


def _adjoint_series(length: int, scale: Callable[[int], Fraction]) -> Series:
    result: Series = {}
    for k in range(length):
        if factor := scale(k):
            for m in range(k + 1):
                # Store the terms of ad_U^k X = sum_m (-1)^m binomial(k, m) U^(k-m) X U^m.
                binomial = factorial(k) // factorial(m) // factorial(k - m)
                result[("U",) * (k - m) + ("X",) + ("U",) * m] = (-1) ** m * binomial * factor
    return result
