"""Convolution of functions on words, and power series of functions on words.

The values of a function on words are the coefficients of a series. The convolution of f and g on a word w is
the sum of f(u) g(v) over all divisions of w into a prefix u and the rest v. If f is zero on the empty word,
its m-fold convolution is zero on words of fewer than m letters.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import factorial

from orderconds.ring.protocol import Element
from orderconds.words.shuffle import Word

Function = Callable[[Word], Element]


def convolution(f: Function, g: Function, word: Word, zero: Element = Fraction(0)) -> Element:
    """Return the sum of f(u) g(v) over all divisions word = uv. ``zero`` is the zero of the ring of values.

    >>> convolution(len, len, ("A", "B", "C"), 0)
    4
    """
    result = zero
    for cut in range(len(word) + 1):
        result = result + f(word[:cut]) * g(word[cut:])
    return result


def power_series(f: Function, word: Word, scales: Sequence[Element], zero: Element = Fraction(0)) -> Element:
    """Return the value of sum_{m>=1} scales[m - 1] f^m on a non-empty word, where f^m is the m-fold
    convolution of f.

    The function treats the value of f on the empty word as zero. Hence the sum ends at m = len(word), and
    ``scales`` needs only len(word) entries. ``zero`` is the zero of the ring of values.

    >>> letters = {("A",): Fraction(2), ("B",): Fraction(3)}
    >>> power_series(lambda word: letters.get(word, Fraction(0)), ("A", "B"), exponential_scales(2))
    Fraction(3, 1)
    """
    n = len(word)
    # powers[end] is the value of the convolution power f^m on the first ``end`` letters. At first, m is 1.
    powers = [zero, *(f(word[:end]) for end in range(1, n + 1))]
    result = powers[n] * scales[0]
    # tails[end] contains the pairs (start, f(word[start:end])) with start >= 1. Pairs with the value ``zero``
    # are omitted.
    tails = [
        [(start, x) for start in range(1, end) if (x := f(word[start:end])) is not zero]
        for end in range(n + 1)
    ]
    for m in range(2, n + 1):
        shorter, powers = powers, [zero] * (n + 1)
        for end in range(m, n + 1):
            total = zero
            for start, x in tails[end]:
                if start >= m - 1 and (y := shorter[start]) is not zero:
                    total = total + y * x
            powers[end] = total
        if powers[n] is not zero:
            result = result + powers[n] * scales[m - 1]
    return result


def exponential_scales(n: int) -> tuple[Fraction, ...]:
    """Return 1/m! for m = 1, ..., n, the coefficients of exp(x) - 1.

    >>> [str(q) for q in exponential_scales(3)]
    ['1', '1/2', '1/6']
    """
    return tuple(Fraction(1, factorial(m)) for m in range(1, n + 1))


def logarithm_scales(n: int) -> tuple[Fraction, ...]:
    """Return (-1)^(m+1)/m for m = 1, ..., n, the coefficients of log(1 + z).

    >>> [str(q) for q in logarithm_scales(3)]
    ['1', '-1/2', '1/3']
    """
    return tuple(Fraction((-1) ** (m + 1), m) for m in range(1, n + 1))


def cayley_scales(n: int) -> tuple[Fraction, ...]:
    """Return 1/2^(m-1) for m = 1, ..., n. This is the coefficient of x^m in cay(x) - 1, where
    cay(x) = (1 + x/2) / (1 - x/2) is the Cayley transform.

    >>> [str(q) for q in cayley_scales(3)]
    ['1', '1/2', '1/4']
    """
    return tuple(Fraction(1, 2 ** (m - 1)) for m in range(1, n + 1))


def inverse_cayley_scales(n: int) -> tuple[Fraction, ...]:
    """Return the coefficients (-1)^(m+1)/2^(m-1) of z^m in 2 z/(2 + z) for m = 1, ..., n. The function
    2 z/(2 + z) maps z = cay(x) - 1 to x (see :func:`cayley_scales`).

    >>> [str(q) for q in inverse_cayley_scales(3)]
    ['1', '-1/2', '1/4']
    """
    return tuple(Fraction((-1) ** (m + 1), 2 ** (m - 1)) for m in range(1, n + 1))
