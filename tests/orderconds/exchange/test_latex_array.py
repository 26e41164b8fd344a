"""LaTeX: tableaux as papers print them."""

from __future__ import annotations

from orderconds import Tableau
from orderconds.exchange import read_data
from orderconds.tableau import find
from orderconds.tableau.file import from_data


def test_latex_from_a_paper() -> None:
    text = r"""
    \begin{array}{c|cc}
      \frac12 - \frac{\sqrt{3}}{6} & \tfrac{1}{4} & \tfrac{1}{4} - \tfrac{\sqrt{3}}{6} \\[4pt]
      \frac12 + \frac{\sqrt{3}}{6} & \tfrac{1}{4} + \tfrac{\sqrt{3}}{6} & \tfrac{1}{4} \\ \hline
      & \frac{1}{2} & \frac{1}{2}
    \end{array}"""
    tableau = from_data(read_data(text.encode(), "latex", "x.tex"))
    assert tableau.method.b == Tableau.load(find("gauss2")).method.b  # type: ignore[union-attr]
    assert tableau.method == Tableau.load(find("gauss2")).method


def test_blank_cells_of_a_printed_tableau_are_zeros() -> None:
    printed = r"""
    \begin{array}{l | l l l l}
      0 & & & & \\ 1/2 & 1/2 & & & \\ 1/2 & & 1/2 & & \\ 1 & & & 1 & \\
      \hline & 1/6 & 1/3 & 1/3 & 1/6 \\
    \end{array}"""
    table = "0,,,,,\n1/2,1/2,,,,\n1/2, ,1/2\n1,,,1\n,1/6,1/3,1/3,1/6,\n,1,,,\n"
    rk4 = Tableau.load(find("rk4")).method
    assert from_data(read_data(printed.encode(), "latex", "x.tex")).method == rk4
    found = from_data(read_data(table.encode(), "csv", "x.csv"))
    assert found.method == rk4
    assert found.embedded is not None
    assert found.embedded.b == (1, 0, 0, 0)
