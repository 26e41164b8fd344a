"""Logarithms of products of exponentials and Cayley transforms, on words."""

from __future__ import annotations

import pytest

from orderconds.ring import QQ
from orderconds.series.linear_flow import TRANSFORMS, product_logarithm
from orderconds.words.bch import goldberg
from orderconds.words.convolution import convolution, power_series
from orderconds.words.expansions import words_of_weight

WEIGHT = 5
HALF = QQ.rational(1, 2)


def letter(k, scale=QQ.one):
    """The element scale X_k by its values on words."""
    return lambda word: scale if word == (k,) else QQ.zero


def mixed(word):
    return {(1,): QQ.rational(2, 3), (2,): QQ.rational(-1, 5), (1, 2): HALF, (2, 1): -HALF}.get(word, QQ.zero)


@pytest.mark.parametrize("transform", TRANSFORMS)
def test_the_transform_of_the_logarithm_is_the_product_of_the_transforms(transform):
    exponents = [letter(1), mixed, letter(2, HALF)]
    scales, _ = TRANSFORMS[transform]

    def mapped(element):
        def value(word):
            if not word:
                return QQ.one
            numbers = [QQ.rational(q.numerator, q.denominator) for q in scales(len(word))]
            return power_series(element, word, numbers, QQ.zero)

        return value

    product = mapped(exponents[0])
    for exponent in exponents[1:]:
        product = (lambda f, g: lambda word: convolution(f, g, word, QQ.zero))(product, mapped(exponent))
    omega = mapped(product_logarithm(QQ, exponents, transform))
    for n in range(1, WEIGHT + 1):
        for word in words_of_weight(n):
            assert omega(word) == product(word), word


def test_two_exponentials_have_the_baker_campbell_hausdorff_series():
    # The first exponent acts first, so that as a product its letter is the last.
    omega = product_logarithm(QQ, [letter(1), letter(2)])
    for n in range(1, 6):
        for place in range(2**n):
            word = tuple(1 + (place >> k & 1) for k in range(n))
            name = "".join("BA"[k - 1] for k in reversed(word))
            exact = goldberg(name)
            assert omega(word) == QQ.rational(exact.numerator, exact.denominator), word


@pytest.mark.parametrize("transform", TRANSFORMS)
def test_an_exponent_and_its_negative_cancel(transform):
    omega = product_logarithm(QQ, [mixed, lambda word: -mixed(word)], transform)
    assert all(omega(word) == 0 for n in range(1, WEIGHT + 1) for word in words_of_weight(n))


def test_one_exponent_is_its_own_logarithm_and_none_gives_zero():
    assert product_logarithm(QQ, [mixed]) is mixed
    assert product_logarithm(QQ, [])((1,)) == 0
