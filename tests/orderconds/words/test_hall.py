"""Hall bases: their number, their independence, and rewriting checked on words and on matrices."""

import random
from fractions import Fraction

import pytest

from orderconds.words.bch import bch
from orderconds.words.hall import HallBasis
from orderconds.words.lie import expand, lyndon_coordinates, standard_bracketing
from orderconds.words.lyndon import lyndon_words
from orderconds.words.shuffle import add
from tests.orderconds.words import series_of_matrices as matrices

GRADINGS = [
    ("AB", {"A": 1, "B": 1}, 8),
    ("ABC", {"A": 1, "B": 1, "C": 1}, 5),
    ("ABC", {"A": 1, "B": 2, "C": 3}, 8),
    ("ABC", {"A": 3, "B": 1, "C": 2}, 8),
]


@pytest.mark.parametrize(("letters", "weights", "weight"), GRADINGS)
def test_a_hall_basis_has_as_many_elements_as_there_are_lyndon_words(letters, weights, weight):
    basis = HallBasis(letters, weight, weights.__getitem__)
    for n in range(1, weight + 1):
        assert len(basis.of_weight(n)) == len(list(lyndon_words(letters, n, weights.__getitem__)))


def random_bracket(numbers, letters, length):
    if length == 1:
        return numbers.choice(letters)
    cut = numbers.randint(1, length - 1)
    return random_bracket(numbers, letters, cut), random_bracket(numbers, letters, length - cut)


@pytest.mark.parametrize("seed", range(12))
def test_rewriting_a_bracket_does_not_change_it(seed):
    numbers = random.Random(seed)
    bracket = random_bracket(numbers, "ABC", 5)
    basis = HallBasis("ABC", 5)
    rewritten = basis.rewrite(bracket)
    assert all(x in basis.of_weight(5) for x in rewritten)
    assert add(*((value, expand(x)) for x, value in rewritten.items())) == expand(bracket)


def test_rewriting_holds_for_matrices():
    numbers = random.Random(1)
    letters = {x: matrices.random_matrix(numbers) for x in "AB"}
    bracket = random_bracket(numbers, "AB", 7)
    total = matrices.zero()
    for x, value in HallBasis("AB", 7).rewrite(bracket).items():
        total += matrices.of_bracket(x, letters) * matrices.rational(value)
    assert total == matrices.of_bracket(bracket, letters)


def test_coordinates_reproduce_a_lie_element_and_agree_with_lyndon_coordinates():
    basis = HallBasis("AB", 5)
    element = add(*((Fraction(k, 3), expand(x)) for k, x in enumerate(basis.of_weight(5), 1)))
    assert list(basis.coordinates(element).values()) == [Fraction(k, 3) for k in range(1, 7)]
    assert len(lyndon_coordinates(element)) <= 6


def test_what_is_too_heavy_is_refused():
    with pytest.raises(ValueError, match="weight of the bracket is above 3"):
        HallBasis("AB", 3).rewrite(("A", ("A", ("A", "B"))))
    with pytest.raises(ValueError, match="positive"):
        HallBasis("AB", 3, lambda letter: 0)


def test_what_is_no_lie_element_has_no_coordinates():
    with pytest.raises(ValueError, match="not a Lie element"):
        HallBasis("AB", 2).coordinates({("A", "B"): Fraction(1)})


def test_bch_in_a_hall_basis_is_bch():
    numbers = random.Random(4)
    letters = {x: matrices.random_matrix(numbers) for x in "AB"}
    in_lyndon, in_hall = matrices.zero(), matrices.zero()
    for word, value in bch(9).items():
        in_lyndon += matrices.of_bracket(standard_bracketing(word), letters) * matrices.rational(value)
    for bracket, value in HallBasis("AB", 9).from_lyndon(bch(9)).items():
        in_hall += matrices.of_bracket(bracket, letters) * matrices.rational(value)
    assert in_hall == in_lyndon


def test_bch_has_the_published_coefficients_of_hall_brackets():
    # 1/24 [Y,[X,[Y,X]]] = -1/24 [B,[A,[A,B]]] at degree four (HLW III.4.11).
    found = HallBasis("AB", 4).from_lyndon(bch(4))
    assert [str(found[x]) for x in (("A", "B"), ("A", ("A", "B")), ("B", ("A", "B")))] == [
        "1/2",
        "1/12",
        "-1/12",
    ]
    assert {x: value for x, value in found.items() if x in HallBasis("AB", 4).of_weight(4)} == {
        ("B", ("A", ("A", "B"))): Fraction(-1, 24)
    }
