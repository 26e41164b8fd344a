"""C arrays: doubles with their exact values in comments, and the sources of others."""

from __future__ import annotations

import pytest

from orderconds import Tableau
from orderconds.errors import TableauError
from orderconds.exchange import export, read_data
from orderconds.tableau.record import from_data


def test_c_source_with_quotients_and_suffixes() -> None:
    text = (
        "/* somebody's */ const double rk_A[2][2] = {{0.0, 0.0}, {2.0/3.0, 0.0f}};\n"
        "double rk_b[] = { 0.25, 7.5e-1 }; // weights\n"
    )
    tableau = from_data(read_data(text.encode(), "c", "x.c", name="ralston"))
    assert (
        tableau.method
        == Tableau.loads('name = "t"\nfamily = "rk"\nA = [[], ["2/3"]]\nb = ["1/4", "3/4"]\n').method
    )


def test_printed_doubles_are_doubles() -> None:
    text = b"static double A[1][1] = {{0.5}}; static double b[1] = {0.3333333333333333};"
    tableau = from_data(read_data(text, "c", "x.c"))
    assert tableau.ring.text(tableau.method.b[0]) == "0.33333333333333~"  # type: ignore[union-attr]


def test_rounded_doubles_have_their_exact_value_beside_them() -> None:
    source = export({"name": "t", "family": "rk", "A": [[], [], []], "b": ["1/3", "0.5", "2"]}, "c").decode()
    assert "t_b[3] = {0.3333333333333333 /* 1/3 */, 0.5, 2.0};" in source


def test_two_arrays_of_one_name_are_refused() -> None:
    with pytest.raises(TableauError, match="two arrays b"):
        read_data(b"double x_b[1] = {1}; double y_b[1] = {1};", "c", "x.c")


def test_the_longest_name_that_fits_is_taken() -> None:
    source = b"double A[2][2] = {{0, 0}, {1, 0}}; double b[2] = {0, 1}; double m_embedded_b[2] = {1, 0};"
    data = read_data(source, "c", "x.c")
    assert (data["b"], data["embedded"]["b"]) == (["0", "1"], ["1", "0"])
