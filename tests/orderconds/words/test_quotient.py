"""Functionals on words that vanish on an ideal."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest

from orderconds.words.lie import expand
from orderconds.words.quotient import Functional, independent_on_lie, orthogonal
from orderconds.words.shuffle import Series, Word

COMMUTING = expand((0, 1))
NILPOTENT = expand((0, (0, 1)))


def value(functional: Functional, series: Series) -> Fraction:
    return sum((scale * series.get(word, Fraction(0)) for word, scale in functional), Fraction(0))


def ideal(generator: Series, letters: tuple[int, ...], length: int) -> list[Series]:
    degree = len(next(iter(generator)))
    around: list[tuple[Word, Word]] = [
        (word[:cut], word[cut:])
        for word in product(letters, repeat=length - degree)
        for cut in range(length - degree + 1)
    ]
    return [{u + word + v: x for word, x in generator.items()} for u, v in around]


@pytest.mark.parametrize("generator", [COMMUTING, NILPOTENT])
@pytest.mark.parametrize("length", [3, 4, 5])
def test_functionals_vanish_on_the_ideal(generator: Series, length: int) -> None:
    functionals = orthogonal([generator], (0, 1), length)
    for element in ideal(generator, (0, 1), length):
        assert all(value(functional, element) == 0 for functional in functionals)


@pytest.mark.parametrize("length", range(1, 6))
def test_letters_that_commute_leave_one_functional_for_each_content(length: int) -> None:
    functionals = orthogonal([COMMUTING], (0, 1), length)
    contents = [{tuple(sorted(word)) for word, _ in functional} for functional in functionals]
    assert len(functionals) == length + 1
    assert all(len(content) == 1 for content in contents)
    assert all(scale == 1 for functional in functionals for _, scale in functional)


@pytest.mark.parametrize("length", range(1, 6))
def test_without_generators_every_word_is_a_functional(length: int) -> None:
    words = product((0, 1), repeat=length)
    assert orthogonal([], (0, 1), length) == tuple(((word, 1),) for word in words)


def test_modulo_a_double_bracket_one_bracket_of_each_weight_remains() -> None:
    # Of the brackets of weight two to four, [[[0, 1], 1] ..., 1] alone survive [0, [0, 1]] = 0.
    dimensions = [len(independent_on_lie(orthogonal([NILPOTENT], (0, 1), n), n)) for n in range(1, 5)]
    assert dimensions == [2, 1, 1, 1]


def test_each_functional_is_named_after_a_word_of_its_own() -> None:
    functionals = orthogonal([NILPOTENT], (0, 1), 5)
    names = [functional[0][0] for functional in functionals]
    assert len(set(names)) == len(names)
    for functional in functionals:
        assert not {word for word, _ in functional[1:]} & set(names)
