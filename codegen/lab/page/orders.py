"""Orders on the page: the table, the ladders, the conditions, what fails, and what was emitted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from codegen.kernel.operations import sentences
from codegen.lab.figures import Curve, convergence_figure
from codegen.lab.page.spelling import Picture, scientific
from codegen.lab.study import MethodStudy
from codegen.lab.typeset import typeset
from codegen.scene.problem import Problem
from orderconds.conditions import OrderCondition
from orderconds.derivation import derive
from orderconds.families import names

DEEPEST = 4
"""Order up to which conditions are written out; beyond it only the conditions that fail are shown."""

LONGEST = 48
"""Characters of an exact residual that fits a line; longer ones are shown in decimals."""


@dataclass(frozen=True)
class Conditions:
    """The independent order conditions of one family, grouped by order."""

    family: str
    by_order: tuple[tuple[int, tuple[tuple[str, Markup], ...]], ...]

    @property
    def counts(self) -> str:
        """Numbers of conditions, order by order."""
        return ", ".join(str(len(rows)) for _, rows in self.by_order)


def agreement(spread: float | None) -> str:
    """Say how far the executors are apart."""
    if spread is None:
        return "no run"
    return scientific(spread) if spread else "bit for bit"


def section(study: Sequence[MethodStudy], scene: Problem, again: str) -> dict[str, Any]:
    """Return what the templates need of the orders; ``again`` is the command that measures them again."""
    return {
        "rows": [_row(m) for m in study],
        "picture": _picture(study, scene, again),
        "conditions": [_conditions(family, order) for family, order in _families(study)],
        "failing": [_failing(m) for m in study],
        "emissions": [_emission(m) for m in study],
    }


def _row(found: MethodStudy) -> dict[str, Any]:
    return {
        "label": found.method.label,
        "order": f"{'≥ ' if found.order.bound else ''}{found.order.order}",
        "certificate": found.order.certificate,
        "c": _observed(found.compiled.observed),
        "python": _observed(found.python.observed),
        "verdict": found.verdict,
        "spread": agreement(found.spread),
        "ns": f"{found.times[-1].ns_per_step:.0f}" if found.times else "–",
    }


def _observed(order: float | None) -> str:
    return "–" if order is None else f"{order:.2f}"


def _picture(study: Sequence[MethodStudy], scene: Problem, again: str) -> Picture:
    ladders = [
        Curve(m.method.label, tuple((r.h, r.error) for r in m.compiled.ladder.clean), m.order.order, place=k)
        for k, m in enumerate(study)
    ]
    label = f"error at t = {scene.span[1]}"
    return Picture(
        Markup(convergence_figure(f"{scene.name} convergence", [c for c in ladders if c.points], label)),
        "Error of the emitted C against the step size. Dashed: the slope of each computed order.",
        again,
    )


def _families(study: Sequence[MethodStudy]) -> list[tuple[str, int]]:
    """Return the families of a study with the highest order that is written out, in order of appearance."""
    highest: dict[str, int] = {}
    for found in study:
        label = found.method.family_label
        if found.method.family not in names():
            continue  # a variant of the compiler's: its conditions are not spelled out
        highest[label] = max(highest.get(label, 1), min(found.order.order, DEEPEST))
    return list(highest.items())


def _conditions(family: str, order: int) -> Conditions:
    derivation = derive(family, order)
    groups = enumerate(derivation.by_order, start=1)
    return Conditions(family, tuple((n, tuple(_line(c) for c in found)) for n, found in groups))


def _line(condition: OrderCondition) -> tuple[str, Markup]:
    return condition.tree, Markup(typeset(str(condition)))


def _failing(found: MethodStudy) -> dict[str, Any]:
    rows = []
    for failure in found.order.failing[:3]:
        short = len(failure.residual) <= LONGEST
        residual = typeset(failure.residual) if short else scientific(float(failure.decimal), 4)
        rows.append((_line(failure.condition)[1], Markup(residual)))
    return {
        "label": found.method.label,
        "order": found.order.order,
        "count": len(found.order.failing),
        "rows": rows,
    }


def _emission(found: MethodStudy) -> dict[str, Any]:
    manifest = found.emission.manifest
    return {
        "label": found.method.label,
        "module": manifest["module"],
        "operations": sentences(manifest["operations"]),
        "left_out": manifest["left_out"],
        "command": manifest["command"],
        "lines": {name: text.count("\n") for name, text in sorted(found.emission.files.items())},
    }
