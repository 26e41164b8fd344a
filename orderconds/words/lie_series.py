"""Named Lie series as sums of brackets: BCH, symmetric BCH, Magnus, dexp and inverse dexp.

The brackets are bracketed Lyndon words or elements of a Hall basis. The bracket is [x, y] = x y - y x.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby
from math import factorial

from orderconds.errors import UnknownName
from orderconds.words.bch import bch
from orderconds.words.convolution import logarithm_scales, power_series
from orderconds.words.expansions import dexp, dexp_inverse, magnus
from orderconds.words.hall import HallBasis
from orderconds.words.lie import Bracket, coordinates_from_values, standard_bracketing
from orderconds.words.lyndon import lyndon_words
from orderconds.words.shuffle import Letter, Word

Coordinates = dict[Word, Fraction]
"""The coefficients of bracketed Lyndon words. A Lyndon word that is missing has the coefficient zero."""


@dataclass(frozen=True)
class LieSeries:
    """A Lie series.

    ``coordinates`` returns the coefficients of bracketed Lyndon words up to a given weight. ``letters``
    returns all letters up to a given weight, in ascending order. ``weigh`` returns the weight of a letter.

    >>> SERIES["bch"].letters(5), SERIES["magnus"].letters(3)
    (('A', 'B'), ('X1', 'X2', 'X3'))
    """

    summary: str
    letters: Callable[[int], tuple[str, ...]]
    weigh: Callable[[Letter], int]
    coordinates: Callable[[int], Coordinates]


@dataclass(frozen=True)
class LieTerm:
    """One term of a Lie series: ``coefficient`` times ``bracket``. The bracket [x, y] is represented by the
    pair (x, y). A single letter represents itself."""

    weight: int
    bracket: Bracket
    coefficient: Fraction


def lie_terms(name: str, weight: int, basis: str = "lyndon") -> tuple[LieTerm, ...]:
    """Return the non-zero terms of a series up to a weight, in the basis ``lyndon`` or ``hall``.

    Raises :class:`~orderconds.errors.UnknownName` if the series or the basis is unknown.

    >>> [(term.bracket, str(term.coefficient)) for term in lie_terms("bch", 2)]
    [('A', '1'), ('B', '1'), (('A', 'B'), '1/2')]
    >>> [(term.bracket, str(term.coefficient)) for term in lie_terms("dexpinv", 3, "hall")]
    [('X', '1'), (('U', 'X'), '-1/2'), (('U', ('U', 'X')), '1/12')]
    """
    series = named_series(name)
    coordinates = series.coordinates(weight)
    if basis == "hall":
        hall = HallBasis(series.letters(weight), weight, series.weigh)
        by_bracket = hall.from_lyndon(coordinates)
    elif basis == "lyndon":
        place = {letter: number for number, letter in enumerate(series.letters(weight))}.__getitem__
        by_bracket = {standard_bracketing(word, place): value for word, value in coordinates.items()}
    else:
        raise UnknownName(f"there is no basis {basis!r}", expected="lyndon or hall")
    return tuple(
        LieTerm(_weight(bracket, series.weigh), bracket, value)
        for bracket, value in by_bracket.items()
        if value
    )


def named_series(name: str) -> LieSeries:
    """Return the series with the name ``name``.

    Raises :class:`~orderconds.errors.UnknownName` if there is no such series.

    >>> named_series("bch").summary
    'log(exp A exp B)'
    """
    if name not in SERIES:
        raise UnknownName(f"there is no series {name!r}", expected=f"one of {', '.join(SERIES)}")
    return SERIES[name]


def _weight(bracket: Bracket, weigh: Callable[[Letter], int]) -> int:
    if isinstance(bracket, tuple):
        return sum(_weight(part, weigh) for part in bracket)
    return weigh(bracket)


def _one(letter: Letter) -> int:
    return 1


def _number(letter: Letter) -> int:
    """Return the weight k of the letter Xk."""
    return int(letter[1:])


def _from_values(
    value: Callable[[Word], Fraction],
    letters: Callable[[int], tuple[str, ...]],
    weigh: Callable[[Letter], int],
) -> Callable[[int], Coordinates]:
    def coordinates(weight: int) -> Coordinates:
        place = {letter: number for number, letter in enumerate(letters(weight))}.__getitem__
        all_weights: Coordinates = {}
        for n in range(1, weight + 1):
            all_weights |= coordinates_from_values(value, lyndon_words(letters(weight), n, weigh), place)
        return all_weights

    return coordinates


def _strang(word: Word) -> Fraction:
    """Return the coefficient of a word in exp(A/2) exp(B) exp(A/2)."""
    runs = [(letter, len(list(run))) for letter, run in groupby(word)]
    if all(letter == "A" for letter, _ in runs):
        return Fraction(1, factorial(len(word)))
    if sum(letter == "B" for letter, _ in runs) != 1:
        return Fraction(0)
    result = Fraction(1)
    for letter, length in runs:
        result *= Fraction(1, factorial(length) * (2**length if letter == "A" else 1))
    return result


def _log_strang(word: Word) -> Fraction:
    return Fraction(power_series(_strang, word, logarithm_scales(len(word))))


def _magnus(word: Word) -> Fraction:
    """Return the coefficient of ``word`` in the Magnus expansion."""
    return magnus(tuple(_number(letter) for letter in reversed(word)))


def _ab(weight: int) -> tuple[str, ...]:
    return ("A", "B")


def _ux(weight: int) -> tuple[str, ...]:
    return ("U", "X")


def _numbered(weight: int) -> tuple[str, ...]:
    return tuple(f"X{k}" for k in range(1, weight + 1))


def _linear_in_x(expand: Callable[[int], dict[Word, Fraction]]) -> Callable[[int], Coordinates]:
    # In the series sum_k c_k ad_U^k X, the word U^k X has the coefficient c_k.
    def coordinates(weight: int) -> Coordinates:
        series = expand(weight)
        words = (("U",) * k + ("X",) for k in range(weight))
        return {word: series.get(word, Fraction(0)) for word in words}

    return coordinates


SERIES = {
    "bch": LieSeries("log(exp A exp B)", _ab, _one, bch),
    "symmetric-bch": LieSeries(
        "log(exp(A/2) exp(B) exp(A/2))", _ab, _one, _from_values(_log_strang, _ab, _one)
    ),
    "magnus": LieSeries(
        "log Y(1) for Y' = (X1 + t X2 + t^2 X3 + ...) Y, Y(0) = 1; Xk has weight k",
        _numbered,
        _number,
        _from_values(_magnus, _numbered, _number),
    ),
    "dexp": LieSeries("dexp_U(X) = sum_k ad_U^k X/(k+1)!", _ux, _one, _linear_in_x(dexp)),
    "dexpinv": LieSeries("dexp_U^-1(X) = sum_k B_k/k! ad_U^k X", _ux, _one, _linear_in_x(dexp_inverse)),
}
"""All Lie series that are available by name."""
