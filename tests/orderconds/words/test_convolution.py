"""Products and power series of functions on words."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import product

import pytest

from orderconds.words.convolution import (
    cayley_scales,
    convolution,
    exponential_scales,
    inverse_cayley_scales,
    logarithm_scales,
    power_series,
)
from orderconds.words.shuffle import Word, exponential

WORDS = [word for n in range(1, 5) for word in product("AB", repeat=n)]


def random_function(seed: int, at_empty: int = 0) -> dict[Word, Fraction]:
    numbers = random.Random(seed)
    values = {word: Fraction(numbers.randint(-4, 4), numbers.randint(1, 3)) for word in WORDS}
    return {(): Fraction(at_empty), **values}


def test_convolution_is_associative_with_the_empty_word_as_one() -> None:
    f, g, h = (random_function(seed, at_empty=seed) for seed in (1, 2, 3))
    one = {(): Fraction(1)}

    def times(x: dict[Word, Fraction], y: dict[Word, Fraction]) -> dict[Word, Fraction]:
        return {
            word: convolution(lambda w: x.get(w, Fraction(0)), lambda w: y.get(w, Fraction(0)), word)
            for word in [(), *WORDS]
        }

    assert times(times(f, g), h) == times(f, times(g, h))
    assert times(one, f) == times(f, one) == f


@pytest.mark.parametrize(
    ("forward", "backward"),
    [(exponential_scales, logarithm_scales), (cayley_scales, inverse_cayley_scales)],
    ids=["exp and log", "cay and its inverse"],
)
def test_a_map_and_its_inverse_give_the_function_back(forward: object, backward: object) -> None:
    f = random_function(4)
    there = {word: power_series(f.__getitem__, word, forward(len(word))) for word in WORDS}  # type: ignore[operator]
    back = {word: power_series(there.__getitem__, word, backward(len(word))) for word in WORDS}  # type: ignore[operator]
    assert back == {word: f[word] for word in WORDS}
    assert there != back


def test_the_exponential_is_that_of_concatenated_series() -> None:
    f = random_function(5)
    expected = exponential({word: x for word, x in f.items() if x}, 4)
    for word in WORDS:
        assert power_series(f.__getitem__, word, exponential_scales(4)) == expected.get(word, 0)


def test_the_inverse_cayley_transform_solves_its_equation() -> None:
    # x = cay^-1(1 + z) means (1 - x/2)(1 + z) = 1 + x/2.
    z = random_function(6)
    x = {word: power_series(z.__getitem__, word, inverse_cayley_scales(len(word))) for word in WORDS}
    x[()] = Fraction(0)
    for word in WORDS:
        product_of_both = convolution(x.__getitem__, z.__getitem__, word)
        assert z[word] - x[word] / 2 - product_of_both / 2 == x[word] / 2
