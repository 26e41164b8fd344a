"""LaTeX: tableaux as papers print them."""

from __future__ import annotations

import pytest

from orderconds import Tableau
from orderconds.errors import InputError
from orderconds.exchange import export, read_data
from orderconds.tableau import find
from orderconds.tableau.record import from_data


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


def test_other_methods_are_matrices_by_name() -> None:
    text = export(
        {"name": "t", "family": "composition", "base": "symmetric-2", "gamma": ["1/2", "1/2"]}, "latex"
    )
    assert b"gamma = \\begin{pmatrix}\n\\frac{1}{2} & \\frac{1}{2}\n\\end{pmatrix}" in text


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            r"\begin{array}{c|c} 0 & 0 \\ \hline 1 \\ 2 & 1 \end{array}",
            "the rows of weights below the horizontal line differ in length, or their number is not 1 or 2",
        ),
        (r"x = 1", "no tableau"),
        (r"A = \begin{pmatrix} \unknown{1} \end{pmatrix}", "expected a number"),
    ],
)
def test_latex_that_is_no_tableau_is_refused(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        from_data(read_data(text.encode(), "latex", "x.tex"))
