r"""Tableaux in the notation of publications. A Butcher tableau is written as an array in LaTeX or HTML; other
methods are written as rows of coefficients with names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING, cast

from orderconds.errors import TableauError
from orderconds.tableau.coefficient_latex import to_latex
from orderconds.tableau.methods import CommutatorFree, Embedded, Row, RungeKutta
from orderconds.tableau.write import as_data

if TYPE_CHECKING:
    from orderconds.ring.protocol import Element, RealRing
    from orderconds.tableau.record import Tableau

WIDEST = 12
"""The largest number of stages for which the coefficients of a tableau are printed."""

SHORT = 10
"""Rounded decimals are printed with this number of digits."""

BLANK = r"\,"
"""A narrow space between a factor and a vector field."""

CELL = "border:none;padding:2px 8px;text-align:center;background:none"


def tableau_latex(tableau: Tableau) -> str:
    r"""Return a displayed LaTeX formula that contains the Butcher array, or each coefficient with its name.

    >>> from orderconds.tableau import Tableau
    >>> print(tableau_latex(Tableau.rk([[0, 0], [1, 0]], ["1/2", "1/2"])))
    \begin{array}{c|cc} 0 &  &  \\ 1 & 1 &  \\ \hline  & \frac{1}{2} & \frac{1}{2} \end{array}
    """
    rows = _butcher(tableau)
    if rows is None:
        return r"\begin{aligned} " + r" \\ ".join(_equations(tableau)) + r" \end{aligned}"
    above, below = rows
    lines = [_latex_row(line, tableau) for line in above]
    lines[-1] += r" \\ \hline " + r" \\ ".join(_latex_row(line, tableau) for line in below)
    return rf"\begin{{array}}{{c|{'c' * (len(above[0]) - 1)}}} " + r" \\ ".join(lines) + r" \end{array}"


def _latex_row(cells: Sequence[str], tableau: Tableau) -> str:
    return " & ".join(_latex(x, tableau) if x else "" for x in cells)


def _latex(text: str, tableau: Tableau) -> str:
    return text if tableau.doubles else to_latex(text)


def _equations(tableau: Tableau) -> Iterator[str]:
    """Yield stages and update of a commutator-free method; for other formats, rows of coefficients."""
    method = tableau.method
    if isinstance(method, CommutatorFree):
        if method.s > WIDEST:
            yield rf"&\text{{{method.s} stages}}"
            return
        for i, stage in enumerate(method.stages, start=1):
            start = "y_0" if stage.start is None else f"Y_{{{stage.start + 1}}}"
            yield rf"Y_{{{i}}} &= {_product(stage.exponentials, tableau)}{start}"
        start = "y_0" if method.update.start is None else f"Y_{{{method.update.start + 1}}}"
        yield rf"y_1 &= {_product(method.update.exponentials, tableau)}{start}"
        return
    for key, value in as_data(tableau).items():
        if isinstance(value, list) and len(value) <= 4 * WIDEST:
            entries = ", ".join(map(_entry, value))
            yield rf"\text{{{key.replace('_', ' ')}}} &= ({entries})"


def _entry(value: object) -> str:
    """Return one entry in LaTeX. The entry is a coefficient, a name, or a list of coefficients and names."""
    if isinstance(value, list):
        return rf"[{', '.join(map(_entry, value))}]"
    try:
        return to_latex(str(value))
    except TableauError:
        return rf"\text{{{value}}}"


def _product(rows: Sequence[Row], tableau: Tableau) -> str:
    """Return exponentials in the order of composition: the exponential that acts first is at the right."""
    return "".join(rf"\exp\bigl({_exponent(row, tableau)}\bigr)\, " for row in reversed(rows))


def _exponent(row: Row, tableau: Tableau) -> str:
    """Return an exponent in LaTeX: h times a linear combination. A linear combination of one term is printed
    without brackets."""
    text = _combination(row, tableau).replace(r"\frac", r"\tfrac")
    if text.count("k_") == 1:
        factor, _, index = text.rpartition("k_")
        return f"{factor.removesuffix(BLANK)} h k_{index}".strip()
    return f"h({text})"


def _combination(row: Row, tableau: Tableau) -> str:
    """Return a linear combination of the vector fields k_j of the stages."""
    written = ""
    for j, x in enumerate(row, start=1):
        if tableau.ring.is_zero(x) is True:
            continue
        size = _latex(_text(x, tableau), tableau)
        minus = size.startswith("-") and " " not in size
        size = size.removeprefix("-") if minus else size
        factor = "" if size == "1" else f"({size}){BLANK}" if " " in size else f"{size}{BLANK}"
        sign = (" - " if minus else " + ") if written else "-" if minus else ""
        written += f"{sign}{factor}k_{{{j}}}"
    return written or "0"


def tableau_html(tableau: Tableau) -> str:
    """Return a table in HTML that needs no LaTeX.

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
    """Return a coefficient in HTML."""
    return escape(text).replace("sqrt", "√").replace("-", "−").replace("*", "·")


def _butcher(tableau: Tableau) -> tuple[list[list[str]], list[list[str]]] | None:
    """Return the texts of the rows of a Butcher array: c_i and a_ij for each stage, then the rows of weights.
    Zeros at the end of a row of A are blank. Return None for a method without a Butcher array."""
    method = tableau.method
    if not isinstance(method, RungeKutta) or method.s > WIDEST:
        return None
    ring = tableau.ring
    above = []
    for node, row in zip(method.c, method.A, strict=True):
        last = max((j for j, x in enumerate(row) if ring.is_zero(x) is not True), default=-1)
        above.append(
            [_text(node, tableau), *(_text(x, tableau) if j <= last else "" for j, x in enumerate(row))]
        )
    weights = [method.b]
    if isinstance(tableau.embedded, Embedded):
        weights.append(tableau.embedded.b)
    return above, [["", *(_text(x, tableau) for x in row)] for row in weights]


def _text(x: Element, tableau: Tableau) -> str:
    if tableau.doubles:
        return f"{cast('RealRing', tableau.ring).nearest_float(x):.6g}"
    text = tableau.ring.text(x)
    if "~" in text and len(text) > SHORT:
        return f"{cast('RealRing', tableau.ring).nearest_float(x):.{SHORT}g}~"
    return text
