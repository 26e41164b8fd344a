"""Free Lie elements and their coordinates in the Lyndon basis.

The standard bracketing of a Lyndon word w expands to w plus a combination of greater words. Therefore
the coefficients of Lyndon words determine the coordinates, which are computed by forward substitution
(Reutenauer, Free Lie Algebras, Thm 5.1).

In this module, a word denotes the product of its letters in the written order. In the Magnus, Fer and Cayley
expansions, a word denotes the product in reverse order. The function :func:`backwards` converts between these
conventions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import TypeVar

from orderconds.ring.protocol import Element
from orderconds.words.lyndon import is_lyndon
from orderconds.words.shuffle import Letter, Series, Word, add, concatenate

Bracket = Letter
"""A letter, or a pair (x, y) that denotes the bracket [x, y], where x and y are letters or pairs."""

Key = Callable[[Letter], Letter]
"""A function that returns the sort key of a letter."""

S = TypeVar("S", str, Word)


def standard_factors(word: S, key: Key | None = None) -> tuple[S, S]:
    """Split a Lyndon word of two or more letters into its standard factors. The second factor is the longest
    proper suffix that is a Lyndon word.

    >>> standard_factors("AABB")
    ('A', 'ABB')
    """
    cut = next(place for place in range(1, len(word)) if is_lyndon(word[place:], key))
    return word[:cut], word[cut:]


def standard_bracketing(word: Sequence[Letter], key: Key | None = None) -> Bracket:
    """Return the bracket of a Lyndon word. The function :func:`standard_factors` splits the word, and both
    factors are bracketed recursively (Reutenauer, Section 5.1).

    >>> standard_bracketing("AABB")
    ('A', (('A', 'B'), 'B'))
    """
    if len(word) == 1:
        return word[0]
    left, right = standard_factors(tuple(word), key)
    return standard_bracketing(left, key), standard_bracketing(right, key)


def expand(bracket: Bracket) -> Series:
    """Return a bracket as a series of words, where [x, y] = xy - yx.

    >>> {"".join(word): int(value) for word, value in expand(("A", "B")).items()}
    {'AB': 1, 'BA': -1}
    """
    if not isinstance(bracket, tuple):
        return {(bracket,): Fraction(1)}
    x, y = expand(bracket[0]), expand(bracket[1])
    length = max(map(len, x), default=0) + max(map(len, y), default=0)
    return add((1, concatenate(x, y, length)), (-1, concatenate(y, x, length)))


def backwards(series: Mapping[Word, Fraction]) -> Series:
    """Reverse every word of a series.

    >>> backwards({("A", "B"): Fraction(1)})
    {('B', 'A'): Fraction(1, 1)}
    """
    return {word[::-1]: value for word, value in series.items()}


def coordinates_from_values(
    value: Callable[[Word], Element], words: Iterable[Word], key: Key | None = None
) -> dict[Word, Element]:
    """Return the coordinates of a Lie element in the Lyndon basis, from its coefficients at Lyndon words.

    ``value`` returns the coefficient of a word. The ring of coefficients is arbitrary. A word denotes the
    product of its letters in the written order.

    ``words`` contains Lyndon words in ascending order: all words of one weight, or all words with given
    multiplicities of the letters. ``key`` returns the sort key of a letter. The function does not check that
    the values belong to a Lie element.

    >>> element = expand(("A", ("A", "B")))
    >>> coordinates_from_values(lambda word: element.get(word, Fraction(0)), [tuple("AAB"), tuple("ABB")])
    {('A', 'A', 'B'): Fraction(1, 1), ('A', 'B', 'B'): Fraction(0, 1)}
    """
    coordinates: dict[Word, Element] = {}
    expanded: dict[Word, Series] = {}
    for word in words:
        x = value(word)
        for smaller, series in expanded.items():
            if word in series:
                x = x - coordinates[smaller] * int(series[word])
        coordinates[word] = x
        expanded[word] = expand(standard_bracketing(word, key))
    return coordinates


def lyndon_coordinates(element: Mapping[Word, Fraction], key: Key | None = None) -> dict[Word, Fraction]:
    """Return the coordinates of a Lie element in the basis of bracketed Lyndon words (Reutenauer, Thm 5.1).

    Letters are compared by their ``key``, or directly if there is no key. Raises :class:`ValueError` if
    ``element`` is not a Lie element.

    >>> element = expand((("A", "B"), "A"))
    >>> {"".join(word): int(value) for word, value in lyndon_coordinates(element).items()}
    {'AAB': -1}
    """
    rest, coordinates = dict(element), {}
    while rest:
        word = min(rest, key=lambda w: (len(w), tuple(map(key, w)) if key else w))
        if not is_lyndon(word, key):
            raise ValueError(
                f"not a Lie element: the coefficient of {word} contradicts the coefficients of Lyndon words"
            )
        coordinates[word] = rest[word]
        rest = add((1, rest), (-rest[word], expand(standard_bracketing(word, key))))
    return coordinates
