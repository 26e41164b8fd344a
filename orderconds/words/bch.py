"""The Baker-Campbell-Hausdorff series log(exp A exp B), from Goldberg's formula for the coefficients.

Goldberg's formula gives the coefficient of each word in closed form (Duke Math. J. 23 (1956) 13). The
expansion of a bracketed Lyndon word is the word without brackets plus a combination of greater words. Hence
the coordinates in the basis of bracketed Lyndon words follow by forward substitution (Reutenauer, Free Lie
Algebras, Thm 5.1).
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from itertools import groupby

from orderconds.ring.univariate import (
    ONE,
    VARIABLE,
    UnivariatePolynomial,
    derivative,
    integral_from_zero,
    value_at_one,
)
from orderconds.words.lie import standard_factors
from orderconds.words.lyndon import lyndon_words
from orderconds.words.shuffle import Word

Expansion = dict[str, int]


def bch(length: int) -> dict[Word, Fraction]:
    """Return log(exp A exp B) in the basis of bracketed Lyndon words. Words with more than ``length`` letters
    are omitted.

    A Lyndon word denotes its standard bracketing, where [A, B] = A B - B A. Zero coefficients are omitted.

    >>> {"".join(word): str(value) for word, value in bch(3).items()}
    {'A': '1', 'B': '1', 'AB': '1/2', 'AAB': '1/12', 'ABB': '1/12'}
    """
    expansions: dict[str, Expansion] = {"A": {"A": 1}, "B": {"B": 1}}
    result: dict[Word, Fraction] = {("A",): Fraction(1), ("B",): Fraction(1)} if length > 0 else {}
    for n in range(2, length + 1):
        words = ["".join(word) for word in lyndon_words("AB", n)]
        of_degree = _coordinates(words, expansions)
        result |= {tuple(word): value for word, value in of_degree.items() if value}
        if n < length:
            expansions |= {word: _commutator(*standard_factors(word), expansions) for word in words}
    return result


def goldberg(word: str) -> Fraction:
    """Return the coefficient of a non-empty word over A and B in log(exp A exp B).

    Let s_1, ..., s_m be the lengths of the runs of equal letters in the word, and let [x] be the integer part
    of x. Let G_1(t) = 1. For s > 1, let G_s(t) be the derivative of t (t - 1) G_{s-1}(t) / s. If the first
    letter is A, the coefficient is the integral of t^[m/2] (t - 1)^[(m-1)/2] G_{s_1}(t) ... G_{s_m}(t) from
    t = 0 to t = 1. If the first letter is B, the coefficient is (-1)^(n-1) times the integral, where n is the
    number of letters (Goldberg 1956, Thm 1 and Cor. 2).

    >>> str(goldberg("AB")), str(goldberg("BAA")), goldberg("AA") == 0
    ('1/2', '1/12', True)
    """
    runs = tuple(sorted(len(list(run)) for _, run in groupby(word)))
    value = _integral(runs)
    return -value if word[0] == "B" and len(word) % 2 == 0 else value


@lru_cache(maxsize=1 << 14)
def _integral(runs: tuple[int, ...]) -> Fraction:
    t, m = VARIABLE, len(runs)
    integrand = t ** (m // 2) * (t - 1) ** ((m - 1) // 2)
    for run in runs:
        integrand = integrand * _run_polynomial(run)
    return value_at_one(integral_from_zero(integrand))


@lru_cache(maxsize=64)
def _run_polynomial(s: int) -> UnivariatePolynomial:
    if s == 1:
        return ONE
    return derivative(VARIABLE * (VARIABLE - 1) * _run_polynomial(s - 1)) / s


def _coordinates(words: list[str], expansions: dict[str, Expansion]) -> dict[str, Fraction]:
    """Return the coordinates of log(exp A exp B) with respect to the bracketed Lyndon words in ``words``. The
    list ``words`` contains all Lyndon words of one length in ascending order."""
    coordinates: dict[str, Fraction] = {}
    of_multidegree: dict[int, list[str]] = {}
    for word in words:
        lower = of_multidegree.setdefault(word.count("A"), [])
        value = goldberg(word)
        for smaller in lower:
            if coordinates[smaller]:
                value -= coordinates[smaller] * _coefficient(smaller, word, expansions)
        coordinates[word] = value
        lower.append(word)
    return coordinates


def _coefficient(bracketed: str, word: str, expansions: dict[str, Expansion]) -> int:
    """Return the coefficient of ``word`` in the expansion of a nested bracket. This bracket is the standard
    bracketing of the Lyndon word ``bracketed``."""
    left, right = standard_factors(bracketed)
    x, y, i, j = expansions[left], expansions[right], len(left), len(right)
    return x.get(word[:i], 0) * y.get(word[i:], 0) - y.get(word[:j], 0) * x.get(word[j:], 0)


def _commutator(left: str, right: str, expansions: dict[str, Expansion]) -> Expansion:
    result: Expansion = {}
    for u, a in expansions[left].items():
        for v, b in expansions[right].items():
            result[u + v] = result.get(u + v, 0) + a * b
            result[v + u] = result.get(v + u, 0) - a * b
    return {word: value for word, value in result.items() if value}
