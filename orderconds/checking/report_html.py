"""The HTML text of a report in a notebook: a table of orders, and one failing condition for each family."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orderconds.checking.order import FamilyOrder
    from orderconds.checking.report import Report

LONGEST = 120
"""A condition is shown only if its LaTeX text has at most LONGEST characters."""


def report_html(report: Report) -> str:
    """Return a report in HTML, with equations as LaTeX between dollar signs.

    >>> from orderconds.checking import check
    >>> page = report_html(check("kutta3"))
    >>> page.startswith("<p><b>kutta3</b>: holds</p>"), page.count("<tr>")
    (True, 9)
    """
    head = "".join(f"<th>{name}</th>" for name in ("family", "claimed", "order", "certificate", "verdict"))
    rows = "".join(_row(order) for order in report.orders)
    broken = "".join(f"<li>claim fails: {escape(text)}</li>" for text in report.broken_claims)
    failing = "".join(f"<li>{text}</li>" for order in report.orders for text in _failing(order))
    holding = ", ".join(name.replace("_", " ") for name, value in report.properties.items() if value)
    return (
        f"<p><b>{escape(report.name)}</b>: {escape(report.conclusion)}</p>"
        f"<table><tr>{head}</tr>{rows}</table><ul>{broken}{failing}</ul>"
        f"<p>properties: {escape(holding or 'none')}</p>"
    )


def _row(order: FamilyOrder) -> str:
    claimed = "" if order.claimed is None else str(order.claimed)
    claimed = claimed if order.required is None else f"≥ {order.required}"
    reached = f"≥ {order.order}" if order.limit is not None else str(order.order)
    cells = (order.family, claimed, reached, order.certificate, order.verdict)
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"


def _failing(order: FamilyOrder) -> Iterator[str]:
    """Yield at most one line, about the first failing condition."""
    for failure in order.failing[:1]:
        count, n = len(order.failing), order.order + 1
        of_all = f"the first of {count} failing conditions" if count > 1 else "a failing condition"
        text = f"{escape(order.family)}: {of_all} of order {n}"
        latex = failure.condition.latex_equation
        yield f"{text}: ${escape(latex, quote=False)}$" if len(latex) <= LONGEST else text
