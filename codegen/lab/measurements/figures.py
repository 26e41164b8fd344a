"""The figures that the file of a scene declares, drawn from emitted code."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from markupsafe import Markup

from codegen.lab.measurement import Measurement, Section
from codegen.lab.page.formatting import Picture
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.registry import command, draw
from codegen.lab.pictures.source import Source
from codegen.lab.subject import Subject
from codegen.scene.figure import Figure
from orderconds.errors import InputError


@dataclass(frozen=True)
class Stored:
    """A drawn figure in the cache.

    ``svg`` is the SVG element, and ``note`` is a sentence for the caption. ``numbers`` contains
    numbers (for example, the final point of each run) that the figure shows.
    """

    svg: str
    note: str
    numbers: dict[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Result:
    """A figure of a scene.

    ``drawn`` is the picture of the figure. If the figure could not be drawn, ``drawn`` is None, and
    ``failure`` is the reason.
    """

    figure: Figure
    drawn: Stored | None
    failure: str = ""


Results = tuple[Result, ...]


class Figures(Measurement[Results]):
    """Draws the figures that the file of the scene declares.

    The file of the scene also gives the methods and step sizes of the figures. Options of the command
    ``report`` do not change these methods and step sizes.
    """

    name = "figures"
    title = "Figures"
    about = "the figures that the file of the scene declares, computed with emitted code"

    def run(self, subject: Subject) -> Results:
        """Draw every figure."""
        source = Source(subject.scene, subject.progress)
        return tuple(_result(figure, source, subject) for figure in subject.scene.figures)

    def as_json(self, result: Results) -> object:
        """Return a list of dictionaries, one for each figure."""
        return [
            {
                "name": one.figure.name,
                "title": one.figure.title,
                "source": one.figure.source,
                "note": "" if one.drawn is None else one.drawn.note,
                "numbers": {} if one.drawn is None else one.drawn.numbers,
                "failure": one.failure,
            }
            for one in result
        ]

    def holds(self, result: Results) -> bool:
        """Return True if every figure could be drawn."""
        return not any(one.failure for one in result)

    def lines(self, result: Results, subject: Subject) -> Iterable[str]:
        """Return one line for each figure that could not be drawn."""
        for one in result:
            if one.failure:
                yield f"{subject.scene.name} {one.figure.name}: the figure failed: {one.failure}"

    def verdict(self, result: Results, subject: Subject) -> str:
        """Return a sentence that states how many figures are drawn."""
        drawn, count = sum(one.drawn is not None for one in result), len(result)
        return f"{drawn} of {count} figures are drawn. Every curve comes from emitted C code."

    def section(self, result: Results, subject: Subject) -> Section | None:
        """Return the section with the pictures. Each picture has a caption and the command that draws it."""
        if not result:
            return None
        pictures = [_picture(one.figure, one.drawn, subject) for one in result if one.drawn is not None]
        failures = [f"{one.figure.title}: {one.failure}" for one in result if one.failure]
        return Section(TEMPLATE, {"pictures": pictures, "failures": failures})


TEMPLATE = """{% import "parts.html.j2" as parts with context %}
<div class="figures">
{% for picture in pictures %}
{{ parts.figure(picture) }}
{% endfor %}
</div>
{% for failure in failures %}
<p class="fails">Not drawn: {{ failure }}</p>
{% endfor %}
"""


def _result(figure: Figure, source: Source, subject: Subject) -> Result:
    runs = [*figure.runs, *([] if figure.reference is None else [figure.reference])]
    try:
        files = [sorted(source.artifact(run).files.items()) for run in runs]
        stored = subject.cache.get(
            ("figure", source.problem.name, repr(figure), files),
            Stored,
            lambda: _stored(draw(figure, source)),
        )
    except (InputError, ArithmeticError, ValueError) as error:
        return Result(figure, None, str(error))
    return Result(figure, stored)


def _stored(drawn: Drawn) -> Stored:
    return Stored(str(drawn.svg), drawn.note, dict(drawn.numbers))


def _picture(figure: Figure, stored: Stored, subject: Subject) -> Picture:
    drawn = Drawn(Markup(stored.svg))
    caption = f"{figure.title}." + "".join(f" {text}" for text in (figure.caption, stored.note) if text)
    if figure.source:
        caption += f" ({figure.source})"
    return Picture(drawn.svg, caption, command(subject.name, figure), drawn.wide)
