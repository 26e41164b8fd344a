"""The HTML documents of the report: a page for each scene, and an overview with links to the pages.

Each document contains its style sheet, its figures and a script, and loads no other files. A browser that
does not run the script shows the whole document.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from codegen import scenes
from codegen.build import find_compiler
from codegen.lab.efficiency.requirements import REQUIREMENTS
from codegen.lab.measurement import Section
from codegen.lab.page.formatting import scientific
from codegen.lab.page.series_style import Styles
from codegen.lab.page.svg import SERIES_DARK, SERIES_LIGHT, key
from codegen.lab.scene_results import SceneResults
from codegen.scene.problem import Problem
from orderconds import __version__

OVERVIEW = "index.html"


def page_name(results: SceneResults) -> str:
    """Return the file name of the page of a scene."""
    return f"{scenes.file_stem(results.scene)}.html"


def render(results: SceneResults, command: str) -> str:
    """Return the HTML page of one scene. ``command`` is the command line that writes the report."""
    scene = results.scene
    first, last = scene.span
    values = {
        "name": scene.name,
        "title": _title(scene),
        "about": [_formatted(p) for p in scenes.about(results.subject.name).split("\n\n") if p],
        "group": scene.group.name,
        "state": ", ".join(f"{b.name} ({len(b.symbols)} numbers)" for b in scene.state),
        "span": f"{first} ≤ t ≤ {last}",
    }
    sections = [
        {
            "name": m.name,
            "title": m.title,
            "verdict": _marked(m.verdict(), results.subject.labels),
            "holds": m.holds,
            "failure": m.failure,
            "html": "" if body is None else _html(body, results.subject.styles),
        }
        for m in results.measured
        if (body := m.section()) is not None or m.failure
    ]
    return _filled("scene.html.j2", command, s=values, sections=sections, overview=OVERVIEW)


@dataclass(frozen=True)
class Summary:
    """The texts about one scene on the overview page.

    - ``title`` and ``name``: the title and the name of the scene.
    - ``page``: the file name of the page of the scene.
    - ``about``: the first paragraph of the description of the scene, as HTML.
    - ``sections``: a short result of each measurement, as HTML.
    """

    title: str
    page: str
    name: str
    about: Markup
    sections: tuple[Markup, ...]


def summary(results: SceneResults) -> Summary:
    """Return the texts about one scene for the overview page."""
    sections = (m.overview() for m in results.measured)
    return Summary(
        title=_title(results.scene),
        page=page_name(results),
        name=results.scene.name,
        about=_formatted(scenes.about(results.subject.name).partition("\n\n")[0]),
        sections=tuple(_html(body, results.subject.styles) for body in sections if body is not None),
    )


def render_overview(summaries: Sequence[Summary], command: str) -> str:
    """Return the HTML overview page of several scenes. ``command`` is the command that writes the report."""
    return _filled("overview.html.j2", command, scenes=summaries, needs=REQUIREMENTS)


def _formatted(paragraph: str) -> Markup:
    """Convert a paragraph of a docstring to HTML. Text between backquotes becomes code."""
    # The list ``parts`` contains plain text and code alternately, and begins with plain text.
    parts = re.split(r"`{1,2}([^`]+)`{1,2}", paragraph)
    return Markup("").join(
        Markup("<code>{}</code>").format(part) if k % 2 else escape(part) for k, part in enumerate(parts)
    )


def _html(section: Section, styles: Styles) -> Markup:
    """Return a section as HTML. Special characters are escaped, except in ``Markup`` objects."""
    return Markup(_environment().from_string(section.template).render(section.data, styles=styles))


def _marked(sentence: str, labels: Sequence[str]) -> Markup:
    """Return a sentence as HTML. The names in ``labels`` are marked as code."""
    pattern = "|".join(re.escape(escape(label)) for label in sorted(labels, key=len, reverse=True))
    text = str(escape(sentence))
    return Markup(re.sub(rf"(?<![\w:])({pattern})(?![\w:])", r"<code>\1</code>", text) if labels else text)


def _filled(name: str, command: str, **values: object) -> str:
    facts: dict[str, object] = {
        "command": command,
        "version": __version__,
        "compiler": find_compiler().version,
    }
    facts |= {"light": SERIES_LIGHT, "dark": SERIES_DARK}
    return _environment().get_template(name).render(**facts, **values)


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
    environment.filters["key"] = key
    environment.filters["breakable"] = _breakable
    return environment


def _breakable(name: str) -> Markup:
    """Return a name as HTML that permits a line break after a colon or an underscore."""
    return Markup(re.sub("([:_])", r"\1<wbr>", str(escape(name))))


def _title(scene: Problem) -> str:
    return scene.title.partition(" (")[0]
