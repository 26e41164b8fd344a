"""The section about order conditions.

The section shows the independent order conditions of each method family, and the conditions that each method
violates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from codegen.lab.measurement import Measurement, Section
from codegen.lab.measurements.orders import Orders
from codegen.lab.orders.order_study import OrderStudy
from codegen.lab.page.formatting import scientific
from codegen.lab.page.formula_html import formula_html
from codegen.lab.subject import Subject
from orderconds.conditions import OrderCondition
from orderconds.derivation import derive
from orderconds.families import names

DEEPEST = 4
"""The highest order for which all order conditions are shown.

For higher orders, only the conditions that a method violates are shown.
"""

LONGEST = 48
"""The largest number of characters of an exact residual. A longer residual is shown as a decimal number."""


@dataclass(frozen=True)
class FamilyConditions:
    """The independent order conditions of one family of methods, grouped by order.

    ``by_order`` contains pairs (p, conditions of order p).
    """

    family: str
    by_order: tuple[tuple[int, tuple[OrderCondition, ...]], ...]

    @property
    def counts(self) -> str:
        """The numbers of conditions of the orders 1, 2, ..., separated by commas."""
        return ", ".join(str(len(rows)) for _, rows in self.by_order)


@dataclass(frozen=True)
class ConditionTables:
    """The order conditions of each method family, and the order of each method."""

    families: tuple[FamilyConditions, ...]
    methods: tuple[OrderStudy, ...]


class Conditions(Measurement[ConditionTables]):
    """Creates the section of the report about order conditions.

    The section lists the order conditions of each family to which a method of the report belongs. The section
    also lists the conditions that each method violates, with their residuals.
    """

    name = "conditions"
    title = "Order conditions"
    about = "the independent order conditions, and the residuals of the violated conditions"
    part_of = "orders"

    def run(self, subject: Subject) -> ConditionTables:
        """Derive the order conditions of each method family in the report."""
        studies = Orders().result(subject).measured
        return ConditionTables(tuple(_conditions(*pair) for pair in _families(studies)), studies)

    def as_json(self, result: ConditionTables) -> object:
        """Return the numbers of conditions by family and order, and the violated conditions by method."""
        return {
            "counts": {f.family: [len(rows) for _, rows in f.by_order] for f in result.families},
            "violated": {
                m.method.label: [{"tree": f.condition.tree, "residual": f.residual} for f in m.order.failing]
                for m in result.methods
            },
        }

    def verdict(self, result: ConditionTables, subject: Subject) -> str:
        """Return a sentence that says how many methods violate a condition of order p + 1.

        Here p is the order that the program computed for the method, so p can differ from method to method.
        The order of a method that violates a condition of order p + 1 is not higher than p. For the other
        methods, no violated condition of order p + 1 is known.
        """
        if not result.methods:
            return ""
        exact, total = sum(bool(m.order.failing) for m in result.methods), len(result.methods)
        count = f"{exact} of {total}" if exact < total or total == 1 else f"all {total}"
        return (
            f"For {count} methods, the order is not higher than the computed order p, "
            "because a condition of order p + 1 is violated."
        )

    def section(self, result: ConditionTables, subject: Subject) -> Section | None:
        """Return a section with the conditions of each family and the violated conditions of each method."""
        if not result.methods:
            return None
        families = [
            {
                "family": f.family,
                "counts": f.counts,
                "by_order": [(n, [_row(c) for c in rows]) for n, rows in f.by_order],
            }
            for f in result.families
        ]
        values = {"conditions": families, "failing": [_violated(m) for m in result.methods]}
        return Section('{% include "sections/conditions.html.j2" %}', values)


def _families(study: Sequence[OrderStudy]) -> list[tuple[str, int]]:
    """Return pairs (family, n). The report shows the conditions of the family for the orders 1 to n."""
    highest: dict[str, int] = {}
    for each in study:
        label = each.method.family_label
        if each.method.family not in names() or each.method.coefficients is None:
            # The report omits methods without a tableau, and families that are not in
            # :mod:`orderconds.families`.
            continue
        highest[label] = max(highest.get(label, 1), min(each.order.order, DEEPEST))
    return list(highest.items())


def _conditions(family: str, order: int) -> FamilyConditions:
    groups = enumerate(derive(family, order).by_order, start=1)
    return FamilyConditions(family, tuple((n, tuple(conditions)) for n, conditions in groups))


def _row(condition: OrderCondition) -> tuple[str, Markup]:
    return condition.tree, Markup(formula_html(str(condition)))


def _violated(study: OrderStudy) -> dict[str, object]:
    rows = []
    for failure in study.order.failing[:3]:
        short = len(failure.residual) <= LONGEST
        residual = formula_html(failure.residual) if short else scientific(float(failure.decimal), 4)
        rows.append((_row(failure.condition)[1], Markup(residual)))
    return {
        "label": study.method.label,
        "order": study.order.order,
        "count": len(study.order.failing),
        "rows": rows,
    }
