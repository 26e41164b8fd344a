"""Lyndon words: their definition, their number, and the factors of any word."""

from itertools import pairwise, product

import pytest

from orderconds.words.lyndon import is_lyndon, lyndon_factors, lyndon_words


@pytest.mark.parametrize(
    ("letters", "length"), [("AB", n) for n in range(1, 9)] + [("ABC", n) for n in range(1, 6)]
)
def test_lyndon_words_are_those_smaller_than_their_proper_suffixes(letters, length):
    smallest = [
        word for word in product(letters, repeat=length) if all(word < word[cut:] for cut in range(1, length))
    ]
    assert list(lyndon_words(letters, length)) == smallest


@pytest.mark.parametrize("weight", range(1, 8))
def test_lyndon_words_of_a_weight_are_found_for_any_order_of_the_letters(weight):
    weigh = {"A": 2, "B": 1, "C": 3}.get
    words = [
        word
        for length in range(1, weight + 1)
        for word in product("ABC", repeat=length)
        if sum(map(weigh, word)) == weight and all(word < word[cut:] for cut in range(1, length))
    ]
    assert list(lyndon_words("ABC", weight, weigh)) == sorted(words)


def test_two_letters_have_the_published_number_of_lyndon_words():
    assert [len(list(lyndon_words("AB", n))) for n in range(1, 11)] == [2, 1, 2, 3, 6, 9, 18, 30, 56, 99]


def test_every_word_falls_into_lyndon_words_that_do_not_rise():
    for word in product("ABC", repeat=5):
        factors = lyndon_factors(word)
        assert sum(factors, ()) == word
        assert all(map(is_lyndon, factors))
        assert all(x >= y for x, y in pairwise(factors))


def test_letters_need_positive_weights():
    with pytest.raises(ValueError, match="positive"):
        list(lyndon_words("A", 2, weigh=lambda letter: 0))
