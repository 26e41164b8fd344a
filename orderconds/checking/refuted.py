"""The claims of a tableau that ``check`` refutes."""

from __future__ import annotations

from collections.abc import Iterator

from orderconds.checking.report import Report
from orderconds.checking.verdict import check
from orderconds.tableau import Tableau

UNDECIDED = "none"
"""The certificate in a report if the coefficients have too few digits to determine the order."""


def refuted_claims(tableau: Tableau) -> tuple[str, ...]:
    """Return one text for each wrong claim of a tableau.

    The claims concern the properties of the method, and the orders of the method, of its embedded method and
    of its continuous extension. Claims that remain undecided are omitted.

    >>> refuted_claims(Tableau.rk([[0]], [1], claims=2))
    ('rk: claimed order 2, computed order 1',)
    """
    report = check(tableau)
    return (*_orders(report), *_properties(tableau, report))


def _orders(report: Report) -> Iterator[str]:
    """Yield a text for each wrong claim about an order.

    One more text is yielded if the dense output does not end at the new state.
    """
    wrong = [order for order in report.orders if order.verdict == "fails"]
    orders = [(order.family, order.claimed, order.order) for order in wrong]
    embedded, dense = report.embedded, report.dense
    if embedded is not None and embedded.certificates[embedded.own] != UNDECIDED:
        orders.append(("embedded", embedded.claimed, embedded.orders[embedded.own]))
    if dense is not None and dense.certificate != UNDECIDED:
        orders.append(("dense", dense.claimed, dense.order))
    for name, claimed, computed in orders:
        if claimed != computed:
            yield f"{name}: claimed order {claimed}, computed order {computed}"
    if dense is not None and dense.continuous is False:
        yield "dense: the continuous extension does not end at the new state: some b_i(1) differs from b_i"


def _properties(tableau: Tableau, report: Report) -> Iterator[str]:
    """Yield a text for each wrong claim about a property."""
    for name, claimed in tableau.claims.properties.items():
        computed = report.properties.get(name)
        if computed is not None and computed is not claimed:
            yield f"property {name}: claimed {str(claimed).lower()}, computed {str(computed).lower()}"
