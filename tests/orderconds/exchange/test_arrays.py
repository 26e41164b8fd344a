"""Tableaux as named arrays: there and back, and arrays that make no tableau."""

from __future__ import annotations

import pytest

from orderconds.errors import TableauError
from orderconds.exchange.arrays import butcher, coefficient, from_arrays, to_arrays
from orderconds.tableau import Tableau, find
from orderconds.tableau.record import from_data
from orderconds.tableau.write import as_data


@pytest.mark.parametrize(
    "name", ["rk4", "dormand_prince5", "stormer_verlet", "cf4", "cf43", "triple_jump", "gauss2", "radau2a4"]
)
def test_arrays_make_the_same_tableau_again(name: str) -> None:
    tableau = Tableau.load(find(name))
    again = from_data(from_arrays(to_arrays(as_data(tableau), "a table"), "a table"))
    assert (again.method, again.embedded, again.claims) == (tableau.method, tableau.embedded, tableau.claims)


@pytest.mark.parametrize("name", ["strang", "magnus4"])
def test_families_without_arrays_are_refused(name: str) -> None:
    with pytest.raises(TableauError, match="as a table; expected a TOML or JSON file"):
        to_arrays(as_data(Tableau.load(find(name))), "a table")


def test_matrices_are_filled_with_zeros() -> None:
    entries = to_arrays(
        {"name": "t", "family": "rk", "A": [[], ["1"], ["1", "2"]], "b": ["1", "0", "0"]}, "x"
    )
    assert entries["A"] == [["0", "0", "0"], ["1", "0", "0"], ["1", "2", "0"]]


@pytest.mark.parametrize(
    ("entries", "family"),
    [
        ({"A": [["0"]], "b": ["1"]}, "rk"),
        ({"A": [["0"]], "b": ["1"], "A_hat": [["1"]], "b_hat": ["1"]}, "prk"),
        ({"gamma": ["1"]}, "composition"),
        ({"alpha": ["1"], "beta": ["0"]}, "composition"),
        ({"exponentials": [["1"]], "count": ["0", "1"], "start": ["0", "0"]}, "cf"),
    ],
)
def test_the_family_follows_from_the_names_of_the_arrays(entries: dict[str, object], family: str) -> None:
    assert from_arrays(entries, "x")["family"] == family


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"name": "t"}, "no array of coefficients"),
        ({"A": [["0"]], "weights": ["1"]}, "an array with the unknown name 'weights'"),
        ({"exponentials": [["1"]], "count": ["0", "1"]}, "no array start"),
        ({"exponentials": [["1"]], "count": ["0", "2"], "start": ["0", "0"]}, "contradict each other"),
        ({"exponentials": [["1"]], "count": ["-1", "2"], "start": ["0", "0"]}, "contradict each other"),
        ({"exponentials": [["1"]], "count": ["0", "1"], "start": ["0"]}, "contradict each other"),
        ({"exponentials": [["1"], ["1"]], "count": ["0", "1"], "start": ["0", "0"]}, "contradict each other"),
        ({"exponentials": [["1"]], "count": ["0", "x"], "start": ["0", "0"]}, "an integer"),
        ({"A": [["0"]], "b": ["1"], "claims": "[1]"}, "an object in JSON"),
    ],
)
def test_arrays_that_make_no_tableau_are_refused(entries: dict[str, object], message: str) -> None:
    with pytest.raises(TableauError, match=message):
        from_data({"name": "t", **from_arrays(entries, "x")})


@pytest.mark.parametrize(
    ("foreign", "own"),
    [
        ("1e3", "1000"),
        ("1.5E+2", "150"),
        ("25e-3", "0.025"),
        (".5", "0.5"),
        ("-0.25", "-0.25"),
        ("+3", "3"),
        ("2.0L", "2.0"),
        ("0.12345678901", "0.12345678901"),  # eleven digits: exact
        ("0.123456789012", "0.123456789012~"),  # twelve: rounded
        ("0.000000123456789", "0.000000123456789"),  # leading zeros are no digits
        ("sqrt(2)", "sqrt(2)"),
    ],
)
def test_foreign_numbers_lose_their_exponents_and_long_decimals_count_as_rounded(
    foreign: str, own: str
) -> None:
    assert coefficient(foreign) == own


def test_a_printed_tableau_has_nodes_stages_and_weights() -> None:
    entries = butcher([["0", "", ""], ["1", "1", ""]], [["1/2", "1/2"], ["1", ""]])
    assert entries == {
        "c": ["0", "1"],
        "A": [["0", "0"], ["1", "0"]],
        "b": ["1/2", "1/2"],
        "embedded_b": ["1", "0"],
    }
