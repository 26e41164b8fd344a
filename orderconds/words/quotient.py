"""Linear functionals on words that vanish on a two-sided ideal of the free algebra.

The values of these functionals determine an element of the quotient of the free algebra by the ideal. In
particular, the values determine each group-like element of the quotient. Two functionals are called
equivalent if their difference is a combination of products of functionals of lower weight. The equivalence
classes form the dual space of the Lie algebra of the quotient (Reutenauer, Free Lie Algebras, Chapters 1 and
6; Milnor and Moore, Ann. Math. 81 (1965) 211).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product as tuples
from math import lcm

from orderconds.ring.rational_matrix import kernel, rank
from orderconds.words.lie import expand, standard_bracketing
from orderconds.words.lyndon import is_lyndon
from orderconds.words.shuffle import Series, Word

Functional = tuple[tuple[Word, int], ...]
"""A linear functional on words, as pairs of a word and the value at this word. The values are coprime
integers. The value at every other word is zero."""


def orthogonal(generators: Sequence[Series], letters: Sequence[int], length: int) -> tuple[Functional, ...]:
    """Return a basis of the functionals on words of length ``length`` that vanish on the two-sided ideal with
    the given generators.

    The first word of a functional does not occur in the other functionals. Lyndon words are preferred as
    first words.

    >>> commuting = {(0, 1): Fraction(1), (1, 0): Fraction(-1)}
    >>> orthogonal([commuting], (0, 1), 2)
    ((((0, 0), 1),), (((0, 1), 1), ((1, 0), 1)), (((1, 1), 1),))
    """
    functionals: list[Functional] = []
    for content, words in sorted(_by_content(letters, length).items()):
        # Each row of the matrix is an element of the ideal. Each column is a word. A column without a pivot
        # gives a functional that has the word of the column as first word. Elimination chooses pivots from
        # the left. Hence Lyndon words are placed at the right, such that they often become first words.
        columns = sorted(words, key=lambda word: (is_lyndon(word), word))
        rows = list(_ideal(generators, letters, length, content))
        functionals += _kernel(rows, columns)
    return tuple(sorted(functionals))


def independent_on_lie(functionals: Sequence[Functional], length: int) -> tuple[Functional, ...]:
    """Return a largest set of given functionals that are linearly independent on Lie elements. Functionals
    whose first word is a Lyndon word are preferred.

    >>> independent_on_lie([(((0, 1), 1),), (((1, 0), 1),)], 2)
    ((((0, 1), 1),),)
    """
    chosen: list[Functional] = []
    contents = {tuple(sorted(f[0][0])): None for f in functionals}
    for content in sorted(contents):
        of_content = [f for f in functionals if tuple(sorted(f[0][0])) == content]
        brackets = [expand(standard_bracketing(word)) for word in _lyndon(content, length)]
        kept: list[list[Fraction]] = []
        for functional in sorted(of_content, key=lambda f: (not is_lyndon(f[0][0]), f)):
            value = [_at(functional, bracket) for bracket in brackets]
            if rank([*kept, value]) > len(kept):
                kept.append(value)
                chosen.append(functional)
    return tuple(sorted(chosen))


def _at(functional: Functional, series: Mapping[Word, Fraction]) -> Fraction:
    return sum((scale * series.get(word, Fraction(0)) for word, scale in functional), Fraction(0))


def _lyndon(content: Word, length: int) -> Iterator[Word]:
    letters = sorted(set(content))
    return (w for w in tuples(letters, repeat=length) if tuple(sorted(w)) == content and is_lyndon(w))


def _by_content(letters: Sequence[int], length: int) -> dict[Word, list[Word]]:
    groups: dict[Word, list[Word]] = {}
    for word in tuples(letters, repeat=length):
        groups.setdefault(tuple(sorted(word)), []).append(word)
    return groups


def _ideal(
    generators: Sequence[Series], letters: Sequence[int], length: int, content: Word
) -> Iterator[Series]:
    """Yield the products u g v of a word u, a generator g and a word v. Each product contains only
    rearrangements of ``content``."""
    for generator in generators:
        some = next(iter(generator))
        left = list(content)
        for letter in some:
            if letter not in left:
                break
            left.remove(letter)
        else:
            for around in sorted(w for w in tuples(letters, repeat=len(left)) if sorted(w) == left):
                for cut in range(len(around) + 1):
                    u, v = around[:cut], around[cut:]
                    yield {u + word + v: value for word, value in generator.items()}


def _kernel(rows: Sequence[Series], columns: Sequence[Word]) -> Iterator[Functional]:
    place = {word: k for k, word in enumerate(columns)}
    entries = [[Fraction(0)] * len(columns) for _ in rows]
    for row, series in zip(entries, rows, strict=True):
        for word, value in series.items():
            row[place[word]] = value
    for vector in kernel(entries, len(columns)):
        clear = lcm(*(x.denominator for _, x in vector))
        yield tuple((columns[k], int(x * clear)) for k, x in vector)
