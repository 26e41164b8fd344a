"""The report's pages: surveys become tables and pictures and, through templates, HTML documents.

A page a scene, and an overview that says of every scene which method to take. Each document is whole: style
and pictures are inside, and nothing is fetched.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from codegen import scenes
from codegen.build import find_compiler
from codegen.emitter import bare, quoted
from codegen.lab.needs import NEEDS
from codegen.lab.page import advice, cost, longruns, orders, stability
from codegen.lab.page.spelling import scientific
from codegen.lab.study import COMPARED
from codegen.lab.survey import COST, LONG, ORDERS, STABILITY, Survey
from orderconds import __version__

OVERVIEW = "index.html"


def page_name(survey: Survey) -> str:
    """Return the file name of a scene's page."""
    return f"{survey.scene.name}.html"


def render(survey: Survey, command: str) -> str:
    """Return the page of one scene; ``command`` is what made it."""
    return _filled("scene.html.j2", s=_scene(survey), overview=OVERVIEW, **_facts(command))


def render_overview(surveys: Sequence[Survey], command: str) -> str:
    """Return the overview of several scenes, with links to their pages."""
    return _filled("overview.html.j2", scenes=[_summary(s) for s in surveys], needs=NEEDS, **_facts(command))


def _facts(command: str) -> dict[str, Any]:
    return {
        "command": command,
        "version": __version__,
        "compiler": find_compiler().version,
        "compared": COMPARED,
    }


def _filled(name: str, **values: Any) -> str:
    return _environment().get_template(name).render(**values)


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("codegen.templates", "report"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=True,
    )
    environment.filters["power"] = scientific
    return environment


def _title(survey: Survey) -> str:
    return survey.scene.title.partition(" (")[0]


def again(survey: Survey, part: str) -> str:
    """Return the command that measures a part of a scene again."""
    plan = survey.plan
    words = [
        f"orderconds report {bare(plan.spelled)}",
        *(f"-m {quoted(bare(m.label))}" for m in plan.methods),
    ]
    return " ".join([*words, f"--only {part}", "-o DIR"])


def bench_again(survey: Survey) -> str:
    """Return the command that measures a scene's bench again."""
    plan = survey.plan
    words = ["orderconds bench", bare(plan.spelled), *(f"-m {quoted(bare(m.label))}" for m in plan.methods)]
    words += [f"--adaptive {quoted(bare(m.label))}" for m in plan.adaptive]
    words += [f"-a {peer}" for peer in plan.peers]
    return " ".join([*words, f"--budget {plan.effort.budget:g}", "-o DIR"])


def _scene(survey: Survey) -> dict[str, Any]:
    scene = survey.scene
    first, last = scene.span
    return {
        "name": scene.name,
        "title": _title(survey),
        "about": [p for p in scenes.about(survey.plan.spelled).split("\n\n") if p],
        "group": scene.group.name,
        "state": ", ".join(f"{b.name} ({len(b.symbols)} numbers)" for b in scene.state),
        "span": f"{first} ≤ t ≤ {last}",
        "uncertainty": survey.exact.uncertainty,
        "features": survey.features,
        "advice": advice.section(survey.advice) if survey.advice else None,
        "orders": orders.section(survey.orders, scene, again(survey, ORDERS)) if survey.orders else None,
        "cost": cost.section(survey.cost, bench_again(survey)) if survey.cost else None,
        "stability": stability.section(survey.stability, again(survey, STABILITY))
        if survey.stability
        else None,
        "long": longruns.section(survey.longruns, again(survey, LONG)) if survey.longruns else None,
        "again": {part: again(survey, part) for part in (ORDERS, COST, STABILITY, LONG)},
    }


def _summary(survey: Survey) -> dict[str, Any]:
    """Return what the overview says of a scene."""
    verdicts = [m.verdict for m in survey.orders]
    answers = [a for s in survey.stability for a in s.answers]
    return {
        "title": _title(survey),
        "page": page_name(survey),
        "name": survey.scene.name,
        "about": scenes.about(survey.plan.spelled).partition("\n\n")[0],
        "advice": advice.section(survey.advice) if survey.advice else None,
        "methods": [f.label for f in survey.features],
        "orders": (verdicts.count("holds"), len(verdicts)),
        "cases": (sum(len(s.wrong) for s in survey.stability), len(answers)),
    }
