"""The report's page: studies become rows, lists, pictures and, through a template, one HTML document."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from codegen import scenes
from codegen.build import find_compiler
from codegen.emit import bare, quoted
from codegen.lab.figures import Curve, convergence_figure, efficiency_figure
from codegen.lab.study import COMPARED, MethodStudy, Study
from codegen.lab.typeset import typeset
from codegen.printers.operations import sentences
from orderconds import __version__
from orderconds.conditions import OrderCondition
from orderconds.derive import derive
from orderconds.families import names

DEEPEST = 4
"""Order up to which conditions are written out; beyond it only the conditions that fail are shown."""

LONGEST = 48
"""Characters of an exact residual that fits a line; longer ones are shown in decimals."""


@dataclass(frozen=True)
class Picture:
    """An SVG with its caption and the command that makes it again."""

    svg: Markup
    caption: str
    command: str


@dataclass(frozen=True)
class Conditions:
    """The independent order conditions of one family, grouped by order."""

    family: str
    by_order: tuple[tuple[int, tuple[tuple[str, Markup], ...]], ...]

    @property
    def counts(self) -> str:
        """Numbers of conditions, order by order."""
        return ", ".join(str(len(rows)) for _, rows in self.by_order)


def render(studies: Sequence[Study], command: str) -> str:
    """Return the page of these studies; ``command`` is what made it."""
    sections = [_section(study) for study in studies]
    return (
        _environment()
        .get_template("page.html.j2")
        .render(
            sections=sections,
            command=command,
            version=__version__,
            compiler=find_compiler().version,
            compared=COMPARED,
        )
    )


@cache
def _environment() -> Environment:
    loader = PackageLoader("codegen.templates", "report")
    environment = Environment(
        loader=loader,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=True,
    )
    environment.filters["power"] = scientific
    return environment


def agreement(spread: float | None) -> str:
    """Say how far the executors are apart."""
    if spread is None:
        return "no run"
    return scientific(spread) if spread else "bit for bit"


def _section(study: Study) -> dict[str, Any]:
    scene = study.scene
    first, last = scene.span
    return {
        "name": scene.name,
        "title": scene.title.partition(" (")[0],
        "about": scenes.about(study.spelled).split("\n\n"),
        "group": scene.group.name,
        "state": ", ".join(f"{b.name} ({len(b.symbols)} numbers)" for b in scene.state),
        "span": f"{first} ≤ t ≤ {last}",
        "uncertainty": study.exact.uncertainty,
        "rows": [_row(m) for m in study.methods],
        "pictures": _pictures(study),
        "conditions": [_conditions(family, order) for family, order in _families(study)],
        "failing": [_failing(m) for m in study.methods],
        "emissions": [_emission(m) for m in study.methods],
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


def _pictures(study: Study) -> list[Picture]:
    label = f"error at t = {study.scene.span[1]}"
    words = " ".join(f"-m {quoted(bare(m.method.label))}" for m in study.methods)
    ladders, costs = [], []
    for found in study.methods:
        rungs = found.compiled.ladder.clean
        seconds = {t.steps: t.seconds for t in found.times}
        name = found.method.label
        ladders.append(Curve(name, tuple((r.h, r.error) for r in rungs), found.order.order))
        points = tuple((seconds[r.steps], r.error) for r in rungs if seconds.get(r.steps, 0.0) > 0)
        costs.append(Curve(name, points))
    scene = study.scene.name
    again = f"orderconds report {bare(study.spelled)} {words} -o DIR"
    return [
        Picture(
            Markup(convergence_figure(f"{scene} convergence", [c for c in ladders if c.points], label)),
            "Error of the emitted C against the step size. Dashed: the slope of each computed order.",
            again,
        ),
        Picture(
            Markup(efficiency_figure(f"{scene} efficiency", [c for c in costs if c.points], label)),
            "Error of the emitted C against the CPU time of the whole run, least of several measurements.",
            again,
        ),
    ]


def _families(study: Study) -> list[tuple[str, int]]:
    """Return the families of a study with the highest order that is written out, in order of appearance."""
    highest: dict[str, int] = {}
    for found in study.methods:
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


def scientific(x: float, digits: int = 2) -> str:
    """Return a number to some significant digits as people write it.

    >>> scientific(8.86e-35), scientific(0.0), scientific(-0.12345, 4)
    ('8.9 · 10⁻³⁵', '0', '−0.1235')
    """
    from codegen.lab.figures import superscript

    if x == 0 or 1e-3 <= abs(x) < 1e4:
        return f"{x:.{digits}g}".replace("-", "−")
    mantissa, exponent = f"{x:.{digits - 1}e}".split("e")
    return f"{mantissa.replace('-', '−')} · 10{superscript(int(exponent))}"
