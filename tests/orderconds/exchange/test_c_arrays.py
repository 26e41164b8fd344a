"""C arrays: doubles with their exact values in comments, and the sources of others."""

from __future__ import annotations

from orderconds import Tableau
from orderconds.exchange import read_data
from orderconds.tableau.file import from_data


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


def test_long_decimals_are_rounded_numbers() -> None:
    text = b"static double A[1][1] = {{0.5}}; static double b[1] = {0.3333333333333333};"
    tableau = from_data(read_data(text, "c", "x.c"))
    assert tableau.ring.text(tableau.method.b[0]) == "0.333333333333333~"  # type: ignore[union-attr]
