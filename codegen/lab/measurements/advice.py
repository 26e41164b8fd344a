"""The section with advice on the choice of a method: the fastest method for each requirement and accuracy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace

from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.features import Features, features
from codegen.lab.efficiency.race import Result
from codegen.lab.efficiency.ranking import fastest_form, in_form
from codegen.lab.efficiency.recommend import step_of
from codegen.lab.efficiency.requirements import DECADES, REQUIREMENTS
from codegen.lab.efficiency.search import Search
from codegen.lab.efficiency.task import Task
from codegen.lab.efficiency.work_precision import Row
from codegen.lab.measurement import Measurement, Section
from codegen.lab.measurements.cost import Cost
from codegen.lab.page.formatting import decade, duration, enumeration
from codegen.lab.subject import Subject

BODY = '{% include "sections/advice.html.j2" %}'
OVERVIEW = '{% import "parts.html.j2" as parts with context %}{{ parts.advice(advice) }}'

SAFETY = 1.5
"""The safety factor for predicted CPU times. A larger factor means that more methods are measured."""


@dataclass(frozen=True)
class Advised:
    """The fastest method or peer (other integrator) whose error is at most ``error``.

    - ``method``: the name of the method or peer.
    - ``seconds``: the CPU time of a run that reaches the error.
    - ``h``: the step size, or None if the method controls its step size.
    - ``tolerance``: the tolerance of the step-size control, or None if all steps are equal.
    - ``steps``: the number of steps.
    - ``command``: the command that emits the integrator.

    If the time is interpolated between measured runs, ``command`` is empty, and ``h``, ``tolerance`` and
    ``steps`` are None.
    """

    error: float
    method: str
    seconds: float
    h: float | None = None
    tolerance: float | None = None
    steps: int | None = None
    command: str = ""


@dataclass(frozen=True)
class Line:
    """A requirement on a method, and the fastest methods that satisfy it.

    ``need`` is the name of the requirement, and ``meaning`` explains it. For each error 10^-k with k in
    :data:`DECADES`, ``best`` contains the fastest method that reaches the error, or None if no method
    reaches it.
    """

    need: str
    meaning: str
    best: tuple[Advised | None, ...]


@dataclass(frozen=True)
class Searched:
    """The result of the search for the fastest methods.

    ``lines`` contains one :class:`Line` for each requirement in :data:`REQUIREMENTS`.

    ``complete`` is False if the time limit ended the search.
    """

    lines: tuple[Line, ...]
    complete: bool


@dataclass(frozen=True)
class Recommendations:
    """The content of the section with advice on the choice of a method.

    - ``advice``: the fastest methods for each requirement.
    - ``features``: the properties of each measured method.
    - ``complete``: False if the time limit ended the search for the fastest methods.
    """

    advice: tuple[Line, ...]
    features: tuple[Features, ...]
    complete: bool


class Advice(Measurement[Recommendations]):
    """Finds the fastest method of the library for each requirement and each error bound."""

    name = "advice"
    title = "Which method"
    about = "the fastest method of the library for each requirement and accuracy"
    part_of = "cost"

    def run(self, subject: Subject) -> Recommendations:
        """Return the fastest methods, and the properties of the measured methods.

        The search considers the methods named by the user. Without names, it considers the whole library.
        """
        cost = Cost().result(subject)
        known = [features(m.compiled, m.artifact) for m in subject.compiled.measured]
        known += [
            features(c.compiled, c.runner.artifact, c.label)
            for c in cost.candidates
            if isinstance(c, EmittedCandidate) and c.method.adaptive and c.equations and c.equations.printed
        ]
        methods = [(m.label, m.adaptive) for m in (*subject.methods, *subject.adaptive)]
        refused = {failure.method for failure in subject.compiled.failures}
        named = tuple(m for m in methods if m[0] not in refused) if subject.named else ()
        task = Task(subject.name, budget=subject.effort.search, methods=named)
        key = ("advice", subject.scene.name, subject.exact.digits(), task.budget, task.methods)
        search = Searched((), complete=True)
        if named or not subject.named:
            search = subject.cache.get(key, Searched, lambda: searched(task, subject))
        lines = search.lines if search.complete else completed(search.lines, known, cost.result.entries)
        all_lines = (*lines, *peers(cost.result.entries))
        return Recommendations(tuple(map(monotone, all_lines)), tuple(known), search.complete)

    def as_json(self, result: Recommendations) -> object:
        """Return a JSON value: the fastest method for each requirement and each error bound.

        The data of a method are the attributes of :class:`Advised`.
        """
        return [{"need": a.need, "best": [b and asdict(b) for b in a.best]} for a in result.advice]

    def verdict(self, result: Recommendations, subject: Subject) -> str:
        """Return a sentence with the fastest methods for the largest and for the smallest error bound."""
        own = result.advice[0].best if result.advice else ()
        choices = [
            f"{best.method.partition(' (')[0]} ({duration(best.seconds)}) is fastest for an error "
            f"of {decade(k)}"
            for k, best in zip(DECADES, own, strict=False)
            if best
        ]
        if not choices:
            return ""
        return f"Among the emitted methods, {enumeration(choices[:: max(1, len(choices) - 1)])}."

    def section(self, result: Recommendations, subject: Subject) -> Section:
        """Return the section with two tables: the fastest methods, and the properties of methods."""
        return Section(BODY, {"advice": table(result, subject), "features": result.features})

    def overview(self, result: Recommendations, subject: Subject) -> Section:
        """Return the table of the fastest methods for the overview page."""
        return Section(OVERVIEW, {"advice": table(result, subject)})


def searched(task: Task, subject: Subject) -> Searched:
    """Search for the fastest method for each requirement and each error 10^-k with k in :data:`DECADES`."""
    goals = {(r.name, k): r.goal(k) for r in REQUIREMENTS for k in DECADES}
    search = Search(task, tuple(dict.fromkeys(goals.values())), subject.progress, SAFETY)
    search.run()
    subject.progress(f"{subject.scene.name}: timing the fastest methods")
    for goal in search.goals:
        search.time_again(goal)
    lines = []
    for requirement in REQUIREMENTS:
        places = [search.leaders(goals[requirement.name, k])[0] for k in DECADES]
        best = tuple(advised(task, k, p[0]) if p else None for k, p in zip(DECADES, places, strict=True))
        lines.append(Line(requirement.name, requirement.meaning, best))
    return Searched(tuple(lines), search.complete)


def advised(task: Task, k: int, place: Result) -> Advised:
    """Return the method of the run ``place``, the fastest measured run with an error of at most 10^-``k``."""
    recipe = place.entry.recipe
    return Advised(
        10.0**-k,
        recipe.label,
        place.seconds,
        step_of(task, place),
        place.tolerance,
        place.steps,
        recipe.command(task.scene),
    )


def completed(
    lines: Sequence[Line], known: Sequence[Features], entries: Mapping[str, Sequence[Row]]
) -> tuple[Line, ...]:
    """Return a copy of ``lines`` in which faster methods from ``known`` replace slower methods.

    ``lines`` is the result of an unfinished search. Each line belongs to a requirement on the methods, for
    example that they are symplectic. For each error 10^-k, a line contains the fastest method that the search
    found, or None. ``known`` contains the properties of measured methods. ``entries`` maps the label of a
    method to the measured runs of this method.

    For each line and each error, let M be the fastest method in ``known`` that satisfies the requirement and
    reaches the error. M replaces None, and M replaces a method that needs more CPU time than M. A line is not
    changed if its requirement must be tested in a long run.
    """
    requirements = {r.name: r for r in REQUIREMENTS}
    result = []
    for line in lines:
        goals = [requirements[line.need].goal(k) for k in DECADES]
        fitting = [f.label for f in known if goals[0].met(f) and entries.get(f.label)]
        best = list(line.best)
        for i, k in enumerate(DECADES):
            if not goals[i].long:
                times = ((fastest_form(entries[label], 10.0**-k), label) for label in fitting)
                reached = sorted((t[0], in_form(label, t[1])) for t, label in times if t is not None)
                entry = best[i]
                if reached and (entry is None or reached[0][0] < entry.seconds):
                    best[i] = Advised(10.0**-k, reached[0][1], reached[0][0])
        result.append(replace(line, best=tuple(best)))
    return tuple(result)


def monotone(line: Line) -> Line:
    """Return a copy of ``line`` in which a smaller error never takes less CPU time than a larger error.

    For each error 10^-k, ``line.best`` contains an entry: a method or None. The function changes the entries
    one after the other, from the second smallest error to the largest. Let A be the entry for one error, and
    let B be the entry for the next smaller error. If B is a method, B also reaches the larger error.
    Therefore B replaces A if A is None or needs more CPU time than B. If B is None, A is not changed.
    """
    best = list(line.best)
    for i in reversed(range(len(best) - 1)):
        entry, smaller = best[i], best[i + 1]
        if smaller is not None and (entry is None or smaller.seconds < entry.seconds):
            best[i] = replace(smaller, error=10.0 ** -DECADES[i])
    return replace(line, best=tuple(best))


def peers(entries: Mapping[str, Sequence[Row]]) -> tuple[Line, ...]:
    """Return a tuple with one :class:`Line`, or an empty tuple if no peer (other integrator) was measured.

    For each error 10^-k with k in :data:`DECADES`, the line contains the fastest peer.
    """
    others = {label: rows for label, rows in entries.items() if rows and rows[0].target == "peer"}
    if not others:
        return ()
    best: list[Advised | None] = []
    for k in DECADES:
        times = [(fastest_form(rows, 10.0**-k), label) for label, rows in others.items()]
        reached = sorted((f[0], in_form(label, f[1])) for f, label in times if f is not None)
        best.append(Advised(10.0**-k, reached[0][1], reached[0][0]) if reached else None)
    return (Line("a peer, for comparison", "other software that integrates the same equations", tuple(best)),)


def table(result: Recommendations, subject: Subject) -> dict[str, object]:
    """Return the recommendations as a table with one row for each error bound.

    The columns are the requirements that at least one method satisfies. The entry ``unmet`` lists the other
    requirements.
    """
    met = [a for a in result.advice if any(a.best)]
    rows = [
        {"error": decade(k), "cells": [cell(a.best[i]) for a in met]}
        for i, k in enumerate(DECADES)
        if any(a.best[i] for a in met)
    ]
    return {
        "needs": [{"name": a.need, "meaning": a.meaning} for a in met],
        "rows": rows,
        "unmet": [a.need for a in result.advice if not any(a.best)],
        "named": subject.named,
        "complete": result.complete,
    }


def cell(best: Advised | None) -> dict[str, str] | None:
    """Return the texts of a cell of the table, or None for an empty cell.

    The text for the key ``control`` contains the step size or the tolerance, followed by the number of steps.
    """
    if best is None:
        return None
    control = "" if best.h is None else f"h = {best.h:.4g}"
    if best.tolerance is not None:
        control = f"tolerance {best.tolerance:.1e}"
    steps = "" if best.steps is None else f"{best.steps} step{'s' * (best.steps != 1)}"
    return {
        "label": best.method,
        "time": duration(best.seconds),
        "control": ", ".join(x for x in (control, steps) if x),
        "command": best.command,
    }
