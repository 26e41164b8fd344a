"""Free Lie elements: the Lyndon basis, and the Baker-Campbell-Hausdorff series in it.

The standard bracketing of a Lyndon word w is w plus greater words of the same letters, so that coordinates
follow from the coefficients of Lyndon words by forward substitution (Reutenauer, Free Lie Algebras, Thm
5.1).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from orderconds.words.lyndon import is_lyndon
from orderconds.words.shuffle import Series, Word, add, concatenate, exponential, logarithm

Bracket = Any
"""A letter, or a pair of brackets."""


def standard_bracketing(word: Sequence[Any], key: Callable[[Any], Any] | None = None) -> Bracket:
    """Bracket a Lyndon word at its longest proper Lyndon suffix.

    >>> standard_bracketing("AABB")
    ('A', (('A', 'B'), 'B'))
    """
    if len(word) == 1:
        return word[0]
    cut = next(place for place in range(1, len(word)) if is_lyndon(word[place:], key))
    return standard_bracketing(word[:cut], key), standard_bracketing(word[cut:], key)


def expand(bracket: Bracket) -> Series:
    """Write a bracket as a series of words, [x, y] = xy - yx.

    >>> {"".join(word): int(value) for word, value in expand(("A", "B")).items()}
    {'AB': 1, 'BA': -1}
    """
    if not isinstance(bracket, tuple):
        return {(bracket,): Fraction(1)}
    x, y = expand(bracket[0]), expand(bracket[1])
    length = max(map(len, x)) + max(map(len, y))
    return add((1, concatenate(x, y, length)), (-1, concatenate(y, x, length)))


def lyndon_coordinates(
    element: Mapping[Word, Fraction], key: Callable[[Any], Any] | None = None
) -> dict[Word, Fraction]:
    """Return the coordinates of a Lie element in the basis of bracketed Lyndon words.

    Raises :class:`ValueError` for a series that is no Lie element.
    """
    rest, found = dict(element), {}
    spell: Callable[[Word], Any] = lambda word: tuple(map(key, word)) if key else word  # noqa: E731
    while rest:
        word = min(rest, key=lambda w: (len(w), spell(w)))
        if not is_lyndon(word, key):
            raise ValueError(f"not a Lie element: least word {word} is no Lyndon word")
        found[word] = rest[word]
        rest = add((1, rest), (-rest[word], expand(standard_bracketing(word, key))))
    return found


def bch(length: int) -> dict[Word, Fraction]:
    """Return log(exp A exp B) in the Lyndon basis, to brackets of this length.

    >>> {"".join(word): str(value) for word, value in bch(3).items()}
    {'A': '1', 'B': '1', 'AB': '1/2', 'AAB': '1/12', 'ABB': '1/12'}
    """
    one = Fraction(1)
    both = concatenate(exponential({("A",): one}, length), exponential({("B",): one}, length), length)
    return lyndon_coordinates(logarithm(both, length))
