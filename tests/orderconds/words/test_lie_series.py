"""Named Lie series: both bases give the same element, and that element is the logarithm or sum it claims."""

from __future__ import annotations

from fractions import Fraction
from math import factorial

import pytest

from orderconds.errors import UnknownName
from orderconds.words.expansions import expansion, magnus
from orderconds.words.lie import backwards, expand
from orderconds.words.lie_series import SERIES, lie_terms
from orderconds.words.shuffle import Series, add, concatenate, exponential, logarithm

WEIGHT = 6
HALF = Fraction(1, 2)


def multiplied_out(name: str, weight: int, basis: str) -> Series:
    """The series as a sum of words, each bracket written as products."""
    return add(*((term.coefficient, expand(term.bracket)) for term in lie_terms(name, weight, basis)))


@pytest.mark.parametrize("name", SERIES)
def test_both_bases_give_the_same_element(name: str) -> None:
    assert multiplied_out(name, WEIGHT, "hall") == multiplied_out(name, WEIGHT, "lyndon")


@pytest.mark.parametrize("name", SERIES)
def test_terms_rise_in_weight_up_to_the_one_asked_for(name: str) -> None:
    weights = [term.weight for term in lie_terms(name, WEIGHT)]
    assert weights == sorted(weights)
    assert weights[0] == 1
    assert weights[-1] <= WEIGHT


@pytest.mark.parametrize(
    ("name", "factors"),
    [
        ("bch", [("A", Fraction(1)), ("B", Fraction(1))]),
        ("symmetric-bch", [("A", HALF), ("B", 1), ("A", HALF)]),
    ],
)
def test_bch_series_are_logarithms_of_products_of_exponentials(
    name: str, factors: list[tuple[str, Fraction | int]]
) -> None:
    product: Series = {(): Fraction(1)}
    for letter, scale in factors:
        product = concatenate(product, exponential({(letter,): Fraction(scale)}, WEIGHT), WEIGHT)
    assert multiplied_out(name, WEIGHT, "lyndon") == logarithm(product, WEIGHT)


def test_the_symmetric_bch_series_is_odd() -> None:
    assert {term.weight for term in lie_terms("symmetric-bch", 8)} == {1, 3, 5, 7}


def test_the_magnus_series_is_that_of_the_words() -> None:
    numbered = {
        tuple(f"X{k}" for k in word): value for word, value in backwards(expansion(magnus, WEIGHT)).items()
    }
    assert multiplied_out("magnus", WEIGHT, "lyndon") == numbered


def test_dexp_and_its_inverse_have_the_coefficients_of_their_generating_functions() -> None:
    dexp = [term.coefficient for term in lie_terms("dexp", WEIGHT)]
    assert dexp == [Fraction(1, factorial(k + 1)) for k in range(WEIGHT)]
    inverse = {term.weight - 1: term.coefficient for term in lie_terms("dexpinv", WEIGHT)}
    for n in range(WEIGHT):
        # The product of (e^x - 1)/x and x/(e^x - 1) is one.
        assert sum(inverse.get(k, 0) * dexp[n - k] for k in range(n + 1)) == (n == 0)


def test_unknown_series_and_bases_are_refused() -> None:
    with pytest.raises(UnknownName, match="bhc"):
        lie_terms("bhc", 3)
    with pytest.raises(UnknownName, match="lindon"):
        lie_terms("bch", 3, "lindon")
