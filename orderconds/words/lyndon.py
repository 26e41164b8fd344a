"""Lyndon words: words that are lexicographically smaller than each of their proper suffixes.

With the shuffle product, every word is a polynomial in Lyndon words (Radford 1979; Reutenauer, Free Lie
Algebras, Thm 6.1). The Lyndon words are algebraically independent. Hence the coefficients of Lyndon words in
a group-like series are independent, and they determine the coefficients of all other words.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from orderconds.words.shuffle import Letter as Ordered

Letter = TypeVar("Letter")


def lyndon_words(
    letters: Sequence[Letter], weight: int, weigh: Callable[[Letter], int] = lambda letter: 1
) -> Iterator[tuple[Letter, ...]]:
    """Yield the Lyndon words of a given weight, in lexicographic order.

    The sequence ``letters`` defines the order of the letters: each letter is less than the next one.
    ``weigh`` returns the weight of a letter, a positive integer.

    >>> ["".join(word) for word in lyndon_words("AB", 4)]
    ['AAAB', 'AABB', 'ABBB']
    >>> list(lyndon_words((2, 1), 4, weigh=int))
    [(2, 1, 1)]
    """
    weights = [weigh(letter) for letter in letters]
    if any(w < 1 for w in weights):
        raise ValueError("every letter must have a positive weight")
    # The algorithm is that of K. Cattell et al., J. Algorithms 37 (2000) 267, with weights in place of
    # lengths. The list ``places`` contains the letters that have been chosen so far, as indices in
    # ``letters``. The argument ``period`` of ``extend`` is the length of the longest Lyndon word with which
    # these letters begin.
    places: list[int] = []

    def extend(period: int, left: int) -> Iterator[tuple[Letter, ...]]:
        if left == 0:
            if period == len(places):
                yield tuple(letters[place] for place in places)
            return
        least = places[-period] if places else 0
        for place in range(least, len(letters)):
            if weights[place] <= left:
                places.append(place)
                keeps = len(places) > 1 and place == least
                yield from extend(period if keeps else len(places), left - weights[place])
                places.pop()

    if weight > 0:
        yield from extend(1, weight)


def lyndon_factors(
    word: Sequence[Letter], key: Callable[[Letter], Ordered] | None = None
) -> list[tuple[Letter, ...]]:
    """Divide a word into a non-increasing sequence of Lyndon words (J.-P. Duval, J. Algorithms 4 (1983) 363).
    ``key`` returns the sort key of a letter.

    >>> ["".join(factor) for factor in lyndon_factors("BANANA")]
    ['B', 'AN', 'AN', 'A']
    """
    keys: list[Ordered] = [key(letter) if key else letter for letter in word]
    factors, start = [], 0
    while start < len(word):
        end, repeat = start + 1, start
        while end < len(word) and keys[repeat] <= keys[end]:
            repeat = start if keys[repeat] < keys[end] else repeat + 1
            end += 1
        while start <= repeat:
            factors.append(tuple(word[start : start + end - repeat]))
            start += end - repeat
    return factors


def is_lyndon(word: Sequence[Letter], key: Callable[[Letter], Ordered] | None = None) -> bool:
    """Return True if a word is a Lyndon word. The empty word is not a Lyndon word.

    >>> is_lyndon("AAB"), is_lyndon("ABAB")
    (True, False)
    """
    return len(lyndon_factors(word, key)) == 1
