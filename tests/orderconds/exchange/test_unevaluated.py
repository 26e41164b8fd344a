"""Unevaluated coefficients keep their digits and lose their names."""

from __future__ import annotations

from fractions import Fraction

import pytest

from orderconds.exchange.unevaluated import (
    CoefficientTooLong,
    Unevaluated,
    UnevaluatedNumbers,
    with_names_inlined,
)
from orderconds.tableau import Tableau, find
from orderconds.tableau.record import from_data
from orderconds.tableau.write import as_data

RING = UnevaluatedNumbers()


def value(text: str) -> object:
    """The number that a text stands for, by the grammar of tableau files."""
    return from_data({"name": "t", "family": "rk", "A": [[]], "b": [text]}).method.b  # type: ignore[union-attr]


def test_only_operations_with_zero_and_one_are_simplified() -> None:
    x = RING.constant(Fraction(3), Fraction(0))
    for same in (x + 0, 0 + x, x - 0, x * 1, 1 * x, x / 1, x**1):
        assert RING.text(same) == "3"
    assert RING.is_zero(x * 0) is True
    assert RING.text(x + x) == "3 + 3"
    assert RING.is_zero(x - x) is None


ONE, TWO, THREE = (RING.rational(n) for n in (1, 2, 3))


@pytest.mark.parametrize(
    ("element", "same"),
    [
        (ONE / 2 - RING.root(THREE, 2) / 6, "1/2 - sqrt(3)/6"),
        ((ONE - 2) * (THREE + 4) / 5, "-7/5"),
        (RING.root(TWO, 3) * 3 - RING.rational(-1), "3*2^(1/3) + 1"),
        ((ONE / 2 - ONE / 3) / (ONE / 4), "2/3"),
        (-((TWO - ONE / 3) ** 2), "-25/9"),
        (ONE - (TWO - THREE), "2"),
        (THREE / (TWO * THREE), "1/2"),
    ],
)
def test_texts_have_the_values_of_the_operations(element: Unevaluated, same: str) -> None:
    assert value(RING.text(element)) == value(same)


def test_rounded_decimals_keep_their_digits() -> None:
    text = 'name = "m"\nfamily = "rk"\nA = [[], ["g/2"]]\nb = ["1 - g", "g"]\nnumbers = { g = "0.577350~" }'
    tableau = Tableau.loads(text)
    assert tableau.file is not None
    inlined = with_names_inlined(tableau, tableau.file)
    assert inlined.ring.text(inlined.method.A[1][0]) == "0.577350~/2"  # type: ignore[union-attr]
    assert [inlined.ring.text(x) for x in inlined.method.b] == ["1 - 0.577350~", "0.577350~"]  # type: ignore[union-attr]


def test_a_low_storage_scheme_with_rounded_coefficients_is_the_same_method() -> None:
    tableau = Tableau.load(find("carpenter_kennedy4"))
    assert tableau.file is not None
    inlined = with_names_inlined(tableau, tableau.file)
    data = as_data(inlined)
    again = from_data(data)
    for x, y in zip(again.abelian().b, tableau.abelian().b, strict=True):
        assert (x - y).value.contains(0)


def test_a_text_that_no_file_may_hold_is_refused() -> None:
    x = RING.constant(Fraction(1, 3), Fraction(0))
    long = x
    for _ in range(20):
        long = long + long
    with pytest.raises(CoefficientTooLong):
        RING.text(long)
