"""Baker-Campbell-Hausdorff: published coefficients, another way of computing it, and exp exp = exp."""

import random
from fractions import Fraction

import pytest

from orderconds.words.bch import bch, goldberg
from orderconds.words.lie import lyndon_coordinates, standard_bracketing
from orderconds.words.lyndon import lyndon_words
from orderconds.words.shuffle import concatenate, exponential, logarithm
from tests.orderconds.words import series_of_matrices as matrices


def test_bch_has_dynkins_coefficients():
    # 1/24 [X, [[X, Y], Y]] at degree four; at degree five -1/720 [X,[X,[X,[X,Y]]]] and so on (HLW III.4.11).
    found = {"".join(word): value for word, value in bch(5).items()}
    assert found["AABB"] == Fraction(1, 24)
    assert "AAAB" not in found
    assert found["AAAAB"] == found["ABBBB"] == Fraction(-1, 720)
    assert found["AAABB"] == Fraction(1, 180)


def product_of_exponentials(length):
    one = Fraction(1)
    return concatenate(exponential({("A",): one}, length), exponential({("B",): one}, length), length)


def test_goldbergs_coefficients_are_those_of_the_logarithm():
    series = logarithm(product_of_exponentials(6), 6)
    for n in range(1, 7):
        for place in range(2**n):
            word = "".join("AB"[place >> k & 1] for k in range(n))
            assert goldberg(word) == series.get(tuple(word), 0), word


def test_bch_is_the_logarithm_of_the_product_in_the_lyndon_basis():
    assert bch(6) == lyndon_coordinates(logarithm(product_of_exponentials(6), 6))


def test_bch_of_degree_zero_and_one():
    assert bch(0) == {}
    assert bch(1) == {("A",): 1, ("B",): 1}


@pytest.mark.parametrize("break_it", [False, True])
def test_the_exponential_of_bch_is_the_product_of_exponentials_to_degree_twelve(break_it):
    degree, numbers = 12, random.Random(3)
    letters = {"A": matrices.random_matrix(numbers), "B": matrices.random_matrix(numbers)}
    found = bch(degree)
    if break_it:
        found[next(word for word in found if len(word) == degree)] += Fraction(1, 10**9)
    z = [matrices.zero() for _ in range(degree + 1)]
    for word, value in found.items():
        bracket = matrices.of_bracket(standard_bracketing(word), letters)
        z[len(word)] += bracket * matrices.rational(value)
    a, b = ([matrices.zero(), letters[x], *[matrices.zero()] * (degree - 1)] for x in "AB")
    product = matrices.multiply(matrices.exponential(a), matrices.exponential(b))
    assert (matrices.exponential(z) == product) is not break_it


def test_even_degrees_have_the_parity_of_bch():
    # log(exp(-B) exp(-A)) = -log(exp A exp B): reversing and exchanging letters gives the sign (-1)^(n-1).
    for n in (4, 5, 6):
        for word in map("".join, lyndon_words("AB", n)):
            exchanged = word[::-1].translate(str.maketrans("AB", "BA"))
            assert goldberg(exchanged) == goldberg(word)
