"""Every word is a polynomial in Lyndon words: tried on products of exponentials."""

from fractions import Fraction
from itertools import product
from math import prod

from orderconds.words.lyndon import is_lyndon
from orderconds.words.radford import in_lyndon_words
from orderconds.words.shuffle import concatenate, exponential


def test_values_of_a_product_of_exponentials_follow_from_those_at_lyndon_words():
    values = {(): Fraction(1)}
    for letter, step in (("A", 2), ("B", -3), ("A", 5), ("C", 1), ("B", 7), ("A", -4)):
        values = concatenate(values, exponential({(letter,): Fraction(step, 3)}, 5), 5)
    for word in product("ABC", repeat=5):
        polynomial = in_lyndon_words(word)
        assert all(is_lyndon(factor) for monomial in polynomial for factor in monomial)
        found = sum(
            (
                value * prod(values.get(factor, 0) for factor in monomial)
                for monomial, value in polynomial.items()
            ),
            Fraction(0),
        )
        assert found == values.get(word, 0)


def test_a_lyndon_word_is_itself():
    assert in_lyndon_words(("A", "A", "B")) == {(("A", "A", "B"),): 1}
    assert in_lyndon_words(()) == {(): 1}
