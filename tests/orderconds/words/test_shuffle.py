"""Shuffles and concatenation of words."""

from fractions import Fraction
from itertools import product

from orderconds.words.shuffle import add, concatenate, exponential, logarithm, shuffle


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


def test_concatenation_drops_what_is_too_heavy():
    x, y = {("A",): Fraction(1), ("A", "A"): Fraction(2)}, {("B",): Fraction(3)}
    assert concatenate(x, y, 2) == {("A", "B"): 3}
    assert concatenate(x, y, 3, weigh={"A": 1, "B": 2}.get) == {("A", "B"): 3}
    assert concatenate(x, y, 3) == {("A", "B"): 3, ("A", "A", "B"): 6}


def test_sums_cancel():
    x = {("A",): Fraction(1, 2)}
    assert add((1, x), (-1, x)) == {}
    assert add((2, x), (-1, {("B",): Fraction(1)})) == {("A",): 1, ("B",): -1}
