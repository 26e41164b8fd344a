from fractions import Fraction
from itertools import pairwise, product

import pytest

from orderconds.words.compositions import compositions
from orderconds.words.lie import backwards, expand, lyndon_coordinates, standard_bracketing
from orderconds.words.lyndon import is_lyndon, lyndon_factors, lyndon_words
from orderconds.words.shuffle import add, concatenate, exponential, logarithm, shuffle


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


def test_shuffles_commute_and_number_binomially():
    assert shuffle("AAB", "BC") == shuffle("BC", "AAB")
    assert sum(shuffle("ABC", "ABCD").values()) == 35
    assert shuffle("AB", "") == {("A", "B"): 1}


def test_exponentials_of_letters_multiply_over_shuffles():
    series = concatenate(exponential({("A",): Fraction(1)}, 5), exponential({("B",): Fraction(2)}, 5), 5)
    for u, v in product(product("AB", repeat=2), product("AB", repeat=3)):
        shuffled = sum((times * series.get(word, 0) for word, times in shuffle(u, v).items()), Fraction(0))
        assert shuffled == series.get(u, 0) * series.get(v, 0)


def test_exponential_and_logarithm_are_inverse():
    x = {("A",): Fraction(1), ("B",): Fraction(-2, 3), ("A", "B"): Fraction(5), ("B", "A"): Fraction(1, 7)}
    assert logarithm(exponential(x, 4), 4) == x


def test_bracketed_lyndon_words_are_the_word_and_greater_ones():
    for word in lyndon_words("AB", 6):
        expanded = expand(standard_bracketing(word))
        assert expanded[word] == 1
        assert min(expanded) == word


def test_coordinates_reproduce_a_lie_element():
    element = add(
        *(
            (Fraction(n, 3), expand(standard_bracketing(word)))
            for n, word in enumerate(lyndon_words("AB", 5), 1)
        )
    )
    assert list(lyndon_coordinates(element).values()) == [Fraction(n, 3) for n in range(1, 7)]


def test_what_is_no_lie_element_has_no_coordinates():
    with pytest.raises(ValueError, match="not a Lie element"):
        lyndon_coordinates({("A", "A"): Fraction(1)})


def test_compositions_number_powers_of_two():
    for n in range(1, 8):
        found = list(compositions(n))
        assert len(set(found)) == len(found) == 2 ** (n - 1)
        assert all(sum(parts) == n for parts in found)


def test_reading_backwards_changes_the_sign_of_brackets_of_even_length():
    for word in [*lyndon_words("AB", 4), *lyndon_words("AB", 5)]:
        bracket = expand(standard_bracketing(word))
        assert backwards(bracket) == add(((-1) ** (len(word) + 1), bracket))
