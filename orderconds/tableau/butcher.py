r"""Printing of methods in LaTeX or HTML. A Runge-Kutta method is printed as a Butcher array if the array is
small enough. In all other cases, the method is printed as equations (:mod:`orderconds.tableau.equations`)."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

from orderconds.tableau.coefficient_latex import to_latex
from orderconds.tableau.equations import equations, has_name, short_text
from orderconds.tableau.line_width import COLUMN, width
from orderconds.tableau.methods import Embedded, RungeKutta

if TYPE_CHECKING:
    from orderconds.tableau.record import Tableau

WIDEST = 12
"""A Butcher array is printed only for methods with at most this number of stages."""

BETWEEN = 10.0
"""Space between two columns of an array, in points."""

SPACED = r" \\[2pt] "
"""LaTeX code that ends a row with extra vertical space. Without the extra space, fractions in neighbouring
rows would touch."""

NARROWER = r"\!"
"""LaTeX code of a negative space, for wide arrays."""

CELL = "border:none;padding:2px 8px;text-align:center;background:none"


def tableau_latex(tableau: Tableau) -> str:
    r"""Return a method in LaTeX, as a Butcher array or as equations.

    The function returns equations in three cases: the method has no Butcher array, the array does not fit in
    a column of a two-column article, or a coefficient contains a named number, such as g in ``1 - 2*g``.

    >>> from orderconds.tableau import Tableau
    >>> print(tableau_latex(Tableau.rk([[0, 0], [1, 0]], ["1/2", "1/2"])))
    \begin{array}{c|cc} 0 &  &  \\[2pt] 1 & 1 &  \\[2pt] \hline  & \frac{1}{2} & \frac{1}{2} \end{array}
    """
    rows = _butcher(tableau)
    return (_array(*rows, tableau) if rows else None) or equations(tableau)


def _array(above: list[list[str]], below: list[list[str]], tableau: Tableau) -> str | None:
    """Return a Butcher array in LaTeX, with the rows of the stages (``above``) and of the weights
    (``below``). Return None if the array is too wide, or if a coefficient contains a name, such as ``g``."""
    rows = [*above, *below]
    if any(has_name(x) for row in rows for x in row):
        return None
    cells = [[x and (x if tableau.doubles else to_latex(x)) for x in row] for row in rows]
    natural = sum(max(map(width, column)) + BETWEEN for column in zip(*cells, strict=True))
    saved = -2 * width(NARROWER) * len(cells[0])
    for number in range(3):
        if natural - number * saved <= COLUMN:
            break
    else:
        return None
    narrow = NARROWER * number
    lines = [" & ".join(x and f"{narrow}{x}{narrow}" for x in row) for row in cells]
    upper, lower = (SPACED.join(part) for part in (lines[: len(above)], lines[len(above) :]))
    columns = "c" * (len(cells[0]) - 1)
    return rf"\begin{{array}}{{c|{columns}}} {upper} \\[2pt] \hline {lower} \end{{array}}"


def tableau_html(tableau: Tableau) -> str:
    """Return the Butcher array as an HTML table. If the method has no Butcher array, or has more than
    :data:`WIDEST` stages, return HTML with two parts. The first part is the ``repr`` of the tableau. The
    second part contains the equations of the method in LaTeX.

    >>> from orderconds.tableau import Tableau
    >>> tableau_html(Tableau.rk([[0, 0], [1, 0]], ["1/2", "1/2"])).count("<td")
    9
    """
    rows = _butcher(tableau)
    if rows is None:
        return f"<p>{escape(repr(tableau))}</p>$${tableau_latex(tableau)}$$"
    above, below = rows
    lines = [_html_row(line, ruled=False) for line in above]
    lines += [_html_row(line, ruled=k == 0) for k, line in enumerate(below)]
    return f'<table style="border-collapse:collapse;width:auto">{"".join(lines)}</table>'


def _html_row(cells: Sequence[str], *, ruled: bool) -> str:
    rule = ";border-top:1px solid" if ruled else ""
    first = f"{CELL};border-right:1px solid{rule}"
    styles = [first, *[CELL + rule] * (len(cells) - 1)]
    inner = "".join(f'<td style="{s}">{_html(x)}</td>' for s, x in zip(styles, cells, strict=True))
    return f'<tr style="background:none">{inner}</tr>'


def _html(text: str) -> str:
    """Convert the text of a coefficient to HTML."""
    return escape(text).replace("sqrt", "√").replace("-", "−").replace("*", "·")


def _butcher(tableau: Tableau) -> tuple[list[list[str]], list[list[str]]] | None:
    """Return the entries of a Butcher array as text: the rows of the stages and the rows of the weights.
    Return None if the method has no Butcher array, or has more than :data:`WIDEST` stages."""
    method = tableau.method
    if not isinstance(method, RungeKutta) or method.s > WIDEST:
        return None
    ring = tableau.ring
    above = []
    for node, row in zip(method.c, method.A, strict=True):
        last = max((j for j, x in enumerate(row) if ring.is_zero(x) is not True), default=-1)
        above.append(
            [
                short_text(node, tableau),
                *(short_text(x, tableau) if j <= last else "" for j, x in enumerate(row)),
            ]
        )
    weights = [method.b]
    if isinstance(tableau.embedded, Embedded):
        weights.append(tableau.embedded.b)
    return above, [["", *(short_text(x, tableau) for x in row)] for row in weights]
