"""Magnus, Fer and Cayley expansions solve linear equations with random polynomial matrices, over Q[[h]]."""

import random
from fractions import Fraction

import pytest

from orderconds.words.expansions import (
    cayley,
    dcay_inverse,
    dexp,
    dexp_inverse,
    expansion,
    fer,
    fer_remainder,
    iterated_integral,
    magnus,
    words_of_weight,
)
from orderconds.words.lie import backwards, lyndon_coordinates
from tests.orderconds.words import series_of_matrices as matrices

WEIGHT = 8


@pytest.fixture(scope="module", params=[1, 2])
def fields(request):
    numbers = random.Random(request.param)
    return [matrices.random_matrix(numbers) for _ in range(4)]


def values(coefficient, fields):
    return matrices.of_words(expansion(coefficient, WEIGHT), fields, WEIGHT)


def test_the_flow_is_the_series_of_iterated_integrals(fields):
    flow = matrices.flow(fields, WEIGHT)
    assert matrices.add(matrices.one(WEIGHT), values(iterated_integral, fields)) == flow


def test_the_exponential_of_the_magnus_expansion_is_the_flow(fields):
    omega = values(magnus, fields)
    assert matrices.exponential(omega) == matrices.flow(fields, WEIGHT)
    omega[WEIGHT][0, 0] += 1
    assert matrices.exponential(omega) != matrices.flow(fields, WEIGHT)


def test_the_product_of_the_exponentials_of_fers_expansion_is_the_flow(fields):
    # F_4 begins with weight fifteen.
    f1, f2, f3 = (values(lambda word, n=n: fer(n, word), fields) for n in (1, 2, 3))
    assert any(f3[n] != matrices.zero() for n in range(WEIGHT + 1))
    first, second, third = map(matrices.exponential, (f1, f2, f3))
    product = matrices.multiply(first, matrices.multiply(second, third))
    assert product == matrices.flow(fields, WEIGHT)
    remainder = matrices.exponential(values(fer_remainder, fields))
    assert matrices.multiply(first, remainder) == matrices.flow(fields, WEIGHT)


def test_the_cayley_transform_of_its_expansion_is_the_flow(fields):
    half = [x * matrices.rational(Fraction(1, 2)) for x in values(cayley, fields)]
    above = matrices.add(matrices.one(WEIGHT), half)
    below = matrices.add(matrices.one(WEIGHT), half, Fraction(-1))
    assert matrices.multiply(matrices.inverse(below), above) == matrices.flow(fields, WEIGHT)


def test_magnus_and_fer_are_lie_elements_and_cayley_is_none():
    for series in (
        expansion(magnus, 6),
        expansion(fer_remainder, 6),
        expansion(lambda word: fer(3, word), 8),
    ):
        assert lyndon_coordinates(backwards(series))
    with pytest.raises(ValueError, match="not a Lie element"):
        lyndon_coordinates(backwards(expansion(cayley, 3)))


def test_the_magnus_expansion_begins_as_published():
    # Omega = a_1 + a_2/2 + a_3/3 + a_4/4 - [a_1, a_2]/12 - [a_1, a_3]/12 + ... with a_k of weight k about 0.
    found = lyndon_coordinates(backwards(expansion(magnus, 4)))
    assert {word: str(value) for word, value in found.items()} == {
        (1,): "1",
        (2,): "1/2",
        (3,): "1/3",
        (4,): "1/4",
        (1, 2): "-1/12",
        (1, 3): "-1/12",
    }


def test_cayley_expansions_belong_to_every_quadratic_group():
    for n in range(1, WEIGHT + 1):
        for word in words_of_weight(n):
            assert cayley(word[::-1]) == (-1) ** (len(word) + 1) * cayley(word)


def solved(differential, series):
    """Return True if U solves U' = (the sum of the words in U and the field X), for each weight up to 5."""
    for n in range(1, 6):
        for word in words_of_weight(n):
            found = sum(
                (value * _letters(product[::-1], word, series) for product, value in differential.items()),
                Fraction(0),
            )
            if found != sum(word) * series(word):
                return False
    return True


def _letters(product, word, series):
    """The coefficient of ``word`` in a product of U and X; the first acts first."""
    if not product:
        return Fraction(not word)
    values = {"U": series, "X": lambda head: Fraction(len(head) == 1)}
    cuts = range(1, len(word) + 1)
    return sum(
        (values[product[0]](word[:cut]) * _letters(product[1:], word[cut:], series) for cut in cuts),
        Fraction(0),
    )


def test_magnus_solves_the_equation_with_dexp_inverse_and_cayley_with_dcay_inverse():
    assert solved(dexp_inverse(5), magnus)
    assert solved(dcay_inverse(), cayley)
    assert not solved(dexp(5), magnus)
    assert not solved(dcay_inverse(), magnus)


def test_dexp_and_its_inverse_are_inverse():
    length, result = 6, {}
    for product, value in dexp_inverse(length).items():
        for inner, scale in dexp(length).items():
            place = product.index("X")
            word = product[:place] + inner + product[place + 1 :]
            if len(word) <= length:
                result[word] = result.get(word, Fraction(0)) + value * scale
    assert {word: value for word, value in result.items() if value} == {("X",): 1}
