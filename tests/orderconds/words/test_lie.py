"""Free Lie elements and their coordinates in the Lyndon basis."""

from fractions import Fraction

import pytest

from orderconds.words.lie import (
    backwards,
    coordinates_from_values,
    expand,
    lyndon_coordinates,
    standard_bracketing,
)
from orderconds.words.lyndon import lyndon_words
from orderconds.words.shuffle import add


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


def test_reading_backwards_changes_the_sign_of_brackets_of_even_length():
    for word in [*lyndon_words("AB", 4), *lyndon_words("AB", 5)]:
        bracket = expand(standard_bracketing(word))
        assert backwards(bracket) == add(((-1) ** (len(word) + 1), bracket))


def test_coordinates_from_values_at_lyndon_words_are_the_coordinates():
    words = list(lyndon_words("AB", 6))
    element = add(*((Fraction(n, 5), expand(standard_bracketing(word))) for n, word in enumerate(words, 2)))
    found = coordinates_from_values(lambda word: element.get(word, Fraction(0)), words)
    assert found == lyndon_coordinates(element)


def test_coordinates_follow_the_order_of_letters_that_is_given():
    place = {"B": 0, "A": 1}.__getitem__
    words = list(lyndon_words("BA", 3))
    element = expand(("A", ("A", "B")))
    found = coordinates_from_values(lambda word: element.get(word, Fraction(0)), words, place)
    again = add(*((x, expand(standard_bracketing(word, place))) for word, x in found.items()))
    assert again == element
