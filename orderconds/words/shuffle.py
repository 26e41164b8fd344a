"""The shuffle product of words, and the product of series by concatenation of words. In a group-like series,
the coefficient of the shuffle product of two words u and v is the product of the coefficients of u and v."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import factorial
from typing import Any

Letter = Any
"""A letter is a hashable value. If no function ``key`` is given, the operator ``<`` compares letters."""

Word = tuple[Letter, ...]
Series = dict[Word, Fraction]
"""A series, as a map from words to their non-zero coefficients."""


def shuffle(u: Sequence[Letter], v: Sequence[Letter]) -> Counter[Word]:
    """Return the shuffle product of u and v: all words that interleave u and v, with multiplicities.

    >>> sorted(("".join(word), times) for word, times in shuffle("AB", "A").items())
    [('AAB', 2), ('ABA', 1)]
    """
    row: list[Counter[Word]] = [Counter({tuple(v[:n]): 1}) for n in range(len(v) + 1)]
    for letter in u:
        below = row
        row = [Counter({(*word, letter): times for word, times in below[0].items()})]
        for place, other in enumerate(v, start=1):
            words: Counter[Word] = Counter()
            for word, times in below[place].items():
                words[(*word, letter)] += times
            for word, times in row[place - 1].items():
                words[(*word, other)] += times
            row.append(words)
    return row[len(v)]


def add(*scaled: tuple[Fraction | int, Mapping[Word, Fraction]]) -> Series:
    """Return the sum of scale * series over all pairs (scale, series) in ``scaled``. Words with coefficient
    zero are removed.

    >>> add((2, {("A",): Fraction(1)}), (-1, {("A",): Fraction(2), ("B",): Fraction(3)}))
    {('B',): Fraction(-3, 1)}
    """
    result: Series = {}
    for scale, series in scaled:
        for word, value in series.items():
            result[word] = result.get(word, Fraction(0)) + scale * value
    return {word: value for word, value in result.items() if value}


def concatenate(
    x: Mapping[Word, Fraction],
    y: Mapping[Word, Fraction],
    weight: int,
    weigh: Callable[[Letter], int] = lambda a: 1,
) -> Series:
    """Return the product of two series by concatenation. Words of weight above ``weight`` are omitted.

    >>> concatenate({("A",): Fraction(2)}, {("B",): Fraction(3), ("B", "B"): Fraction(1)}, 2)
    {('A', 'B'): Fraction(6, 1)}
    """
    result: Series = {}
    heavy = {word: sum(map(weigh, word)) for word in (*x, *y)}
    for u, a in x.items():
        for v, b in y.items():
            if heavy[u] + heavy[v] <= weight:
                result[u + v] = result.get(u + v, Fraction(0)) + a * b
    return {word: value for word, value in result.items() if value}


def exponential(
    x: Mapping[Word, Fraction], weight: int, weigh: Callable[[Letter], int] = lambda a: 1
) -> Series:
    """Return the terms of exp(x) up to ``weight``, for a series x without constant term. ``weigh`` returns
    the weight of a letter.

    >>> {"".join(word): str(value) for word, value in exponential({("A",): Fraction(1)}, 2).items()}
    {'': '1', 'A': '1', 'AA': '1/2'}
    """
    result: Series = {(): Fraction(1)}
    power: Series = {(): Fraction(1)}
    for n in range(1, weight + 1):
        power = concatenate(power, x, weight, weigh)
        result = add((1, result), (Fraction(1, factorial(n)), power))
    return result


def logarithm(
    x: Mapping[Word, Fraction], weight: int, weigh: Callable[[Letter], int] = lambda a: 1
) -> Series:
    """Return the terms of log(x) up to ``weight``, for a series x with constant term 1. ``weigh`` returns the
    weight of a letter.

    >>> logarithm(exponential({("A",): Fraction(2)}, 3), 3)
    {('A',): Fraction(2, 1)}
    """
    rest = add((1, x), (-1, {(): Fraction(1)}))
    result: Series = {}
    power: Series = {(): Fraction(1)}
    for n in range(1, weight + 1):
        power = concatenate(power, rest, weight, weigh)
        result = add((1, result), (Fraction((-1) ** (n + 1), n), power))
    return result
