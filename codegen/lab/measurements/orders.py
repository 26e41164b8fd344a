"""The section that compares the computed order of each method with the order observed in runs."""

from __future__ import annotations

from collections.abc import Iterable

from codegen.lab.measurement import Measurement, Section
from codegen.lab.orders.order_study import COMPARED, OrderStudy, order_study
from codegen.lab.page.figures import Curve, convergence_figure
from codegen.lab.page.formatting import Picture, enumeration, scientific
from codegen.lab.subject import MethodResults, Subject
from codegen.printers import targets

OVERVIEW = '<p class="note">Observed order equals the computed order for {{ held }} of {{ all }} methods.</p>'

Result = MethodResults[OrderStudy]


class Orders(Measurement[Result]):
    """Compares the observed order of the emitted code with the order computed from the order conditions.

    The observed order is measured for every target (programming language).
    """

    name = "orders"
    title = "Orders"
    about = "the observed orders of the emitted code, compared with the computed orders"
    json_key = "methods"

    def run(self, subject: Subject) -> Result:
        """Run each method with decreasing step sizes, and determine its observed order."""
        exact, progress, cache = subject.exact, subject.progress, subject.cache
        return subject.each(lambda m: order_study(m.compiled, exact, progress, cache))

    def as_json(self, result: Result) -> object:
        """Return a list of dictionaries, one for each method."""
        return [*(m.as_json() for m in result.measured), *(f.as_json() for f in result.failures)]

    def holds(self, result: Result) -> bool:
        """Return True if no method failed and the verdict on each method is ``holds``."""
        return not result.failures and all(m.verdict == "holds" for m in result.measured)

    def lines(self, result: Result, subject: Subject) -> Iterable[str]:
        """Return a line for each method: its verdict, or the reason why it failed."""
        name = subject.scene.name
        for study in result.measured:
            yield f"{name} {study.method.label} {study.main.sentence()}"
        for failure in result.failures:
            yield f"{name} {failure.method} fails: {failure.reason}"

    def section(self, result: Result, subject: Subject) -> Section:
        """Return the section with the table of orders and the convergence diagram."""
        values = {
            "targets": [target.title for target in targets()],
            "rows": [_row(m) for m in result.measured],
            "failures": result.failures,
            "picture": _picture(result.measured, subject) if result.measured else None,
            "compared": COMPARED,
            "uncertainty": subject.exact.uncertainty,
        }
        return Section('{% include "sections/orders.html.j2" %}', values)

    def verdict(self, result: Result, subject: Subject) -> str:
        """Return a sentence with the number of methods whose observed order equals the computed order.

        The sentence names the other methods.
        """
        total = len(result.measured) + len(result.failures)
        held = sum(m.verdict == "holds" for m in result.measured)
        if total == 0:
            return ""
        if held == total:
            number = f"all {total} methods" if total > 1 else "the method"
            return f"The observed order of the emitted code equals the computed order for {number}."
        others = [f"{m.method.label} ({m.verdict})" for m in result.measured if m.verdict != "holds"]
        others += [f"{f.method} (failed)" for f in result.failures]
        sentence = f"The observed order of the emitted code equals the computed order for {held} of {total}"
        return f"{sentence} methods; the exceptions are {enumeration(others)}."

    def overview(self, result: Result, subject: Subject) -> Section:
        """Return a paragraph with the number of methods whose observed order equals the computed order."""
        held = sum(m.verdict == "holds" for m in result.measured)
        return Section(OVERVIEW, {"held": held, "all": len(result.measured) + len(result.failures)})


def agreement(spread: float | None) -> str:
    """Return a text for ``spread`` (:class:`OrderStudy`).

    ``spread`` is the largest difference between the final states of the targets (programming languages). If
    the final states could not be compared, ``spread`` is None.
    """
    if spread is None:
        return "no run"
    return scientific(spread) if spread else "bit for bit"


def _row(study: OrderStudy) -> dict[str, object]:
    return {
        "label": study.method.label,
        "order": f"{'≥ ' if study.order.bound else ''}{study.order.order}",
        "certificate": study.order.certificate,
        "slopes": [_observed(study.convergences[target.name].observed) for target in targets()],
        "verdict": study.verdict,
        "spread": agreement(study.spread),
        "ns": f"{study.times[-1].ns_per_step:.0f}" if study.times else "–",
    }


def _observed(order: float | None) -> str:
    return "–" if order is None else f"{order:.2f}"


def _picture(studies: Iterable[OrderStudy], subject: Subject) -> Picture:
    scene = subject.scene
    curves = [
        Curve(m.method.label, points, subject.styles.of(m.method.label), m.order.order)
        for m in studies
        if (points := tuple((r.h, r.error) for r in m.main.refinement.clean))
    ]
    title = f"Error against step size, {scene.title}"
    return Picture(
        convergence_figure(f"{scene.name} convergence", title, curves, f"error at t = {scene.span[1]}"),
        "Error of the emitted code against the step size. The slopes of the dashed lines are the computed "
        "orders of the methods.",
        subject.report_command("orders"),
    )
