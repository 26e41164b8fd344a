r"""Order conditions for a notebook, as an HTML table of trees and equations, or as a LaTeX formula.

Equations are printed as LaTeX between dollar signs, for MathJax.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape

from orderconds.conditions import OrderCondition
from orderconds.explain import kinds
from orderconds.explain.svg import sheet
from orderconds.formula.equations import broken
from orderconds.formula.notation import latex_fraction
from orderconds.typeset.counts import sum_of_counts
from orderconds.typeset.legend import legend

MOST = 300
"""The largest number of conditions in a table or formula. Further conditions are omitted."""

WIDE = 90
"""The largest width of a line in characters."""


def formula(conditions: Sequence[OrderCondition]) -> str:
    r"""Return a displayed LaTeX formula with one equation for each of the first :data:`MOST` conditions.

    >>> from orderconds.derivation import derive
    >>> print(formula(derive("rk", order=2).conditions))
    $$\begin{aligned}
    \sum_{i} b_{i} &= 1 \\
    \sum_{i} b_{i} c_{i} &= \tfrac{1}{2}
    \end{aligned}$$
    """
    rows = [f"{_lines(c)} &= {latex_fraction(c.rhs)}" for c in conditions[:MOST]]
    return "$$\\begin{aligned}\n" + " \\\\\n".join(rows) + "\n\\end{aligned}$$"


def _lines(condition: OrderCondition) -> str:
    lines = broken(condition.latex, WIDE)
    if len(lines) == 1:
        return lines[0]
    return r"\begin{aligned}[b]" + r" \\ ".join(f"& {line}" for line in lines) + r"\end{aligned}"


def table(family: str, by_order: Sequence[Sequence[OrderCondition]]) -> str:
    """Return an HTML table with the order, the tree and the equation of each of the first :data:`MOST`
    conditions. A legend of the symbols follows the table.

    >>> from orderconds.derivation import derive
    >>> table("rk", derive("rk", order=2).by_order).count("<svg")
    2
    """
    flat = [condition for conditions in by_order for condition in conditions]
    counts = sum_of_counts([len(conditions) for conditions in by_order])
    caption = f"<caption>{escape(family)}: {counts}</caption>"
    names = ("order", "tree", "condition")
    head = "<tr>" + "".join(f'<th style="text-align:left">{name}</th>' for name in names) + "</tr>"
    rows = "".join(_rows(family, flat[:MOST]))
    rest = f"<p>... and {len(flat) - MOST} more</p>" if len(flat) > MOST else ""
    return f"<table>{caption}{head}{rows}</table>{rest}<p>{legend(family, flat)}</p>"


def _rows(family: str, conditions: Sequence[OrderCondition]) -> Iterator[str]:
    kind = kinds.of_family(family)
    for condition in conditions:
        tree = escape(condition.tree) if kind is None else sheet([(kind.diagram(condition.key), [])])
        equation = rf"$\displaystyle {_lines(condition)} = {latex_fraction(condition.rhs)}$"
        cells = (str(condition.order), tree, escape(equation, quote=False))
        yield "<tr>" + "".join(f'<td style="text-align:left">{cell}</td>' for cell in cells) + "</tr>"
