"""The report section about stability.

The section contains the largest usable step and the results of steps with extreme input. The section also
contains the results for stiff variants of the scene, for runs of many steps, and for linear stability.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from codegen.lab.measurement import Measurement, Section
from codegen.lab.page.figures import region_figure
from codegen.lab.page.formatting import Picture, enumeration, scientific
from codegen.lab.stability.endurance import Endurance
from codegen.lab.stability.extreme_steps import ACCURATE, WRONG, Answer
from codegen.lab.stability.linear_stability import interval, region
from codegen.lab.stability.stability_study import Findings, Stability, StiffScenes, findings, stiff_scenes
from codegen.lab.subject import CompiledMethod, MethodResults, Subject

OVERVIEW = (
    '<p class="note">Of {{ all }} steps with extreme input, {{ wrong }} had a wrong result that was reported '
    "as success.</p>"
)

NAMED = 2
"""If at most NAMED methods share the largest usable step, the verdict names these methods."""

Result = MethodResults[Stability]


class StabilityTests(Measurement[Result]):
    """Runs the stability tests of each method, and computes its region of linear stability."""

    name = "stability"
    title = "Stability"
    about = "the largest usable step, extreme input, stiff variants, runs of many steps"

    def run(self, subject: Subject) -> Result:
        """Run the stability tests of each method."""
        effort, scene = subject.effort, subject.scene
        exact = subject.exact_or_reason
        known = exact if isinstance(exact, str) else exact.digits()
        stiff = stiff_scenes(scene, subject.progress) if effort.stiff else StiffScenes()

        def measure(m: CompiledMethod) -> Stability:
            key = ("stability", m.files, known, effort.stiff, effort.endurance)
            measured = subject.cache.get(
                key,
                Findings,
                lambda: findings(m.compiled, exact, stiff, subject.progress, endurance=effort.endurance),
            )
            return Stability(scene.name, m.label, region(m.compiled.method), measured)

        return subject.each(measure)

    def as_json(self, result: Result) -> object:
        """Return a list of dictionaries, one for each method."""
        return [*(s.as_json() for s in result.measured), *(f.as_json() for f in result.failures)]

    def holds(self, result: Result) -> bool:
        """Return True if all methods were tested and passed.

        A method fails if a step with extreme input has a wrong result, or if a run of many steps fails.
        """
        return not result.failures and all(s.honest for s in result.measured)

    def lines(self, result: Result, subject: Subject) -> Iterable[str]:
        """Return one line for each extreme input with a wrong result.

        Each method that was not tested adds one line with the reason.
        """
        for stability in result.measured:
            for wrong in stability.wrong:
                yield f"{stability.scene} {stability.method}: {wrong.case.name}: {wrong.verdict}"
        for failure in result.failures:
            yield f"{subject.scene.name} {failure.method}: the stability tests failed: {failure.reason}"

    def verdict(self, result: Result, subject: Subject) -> str:
        """Return a sentence about the tests with extreme input, and about the largest usable step."""
        answers = [(_kind(a), s.method) for s in result.measured for a in s.findings.answers]
        wrong = [method for kind, method in answers if kind == "wrong"]
        parts = []
        if answers:
            names = f" ({enumeration(list(dict.fromkeys(wrong)))})" if wrong else ""
            parts.append(
                f"of {len(answers)} steps with extreme input, {len(wrong) or 'none'} had a wrong result "
                f"that was reported as success{names}"
            )
        if undetermined := sum(kind == "undetermined" for kind, _ in answers):
            parts.append(f"{undetermined} had an undetermined result")
        limits = {s.method: s.findings.limit.h for s in result.measured if s.findings.limit.h is not None}
        if limits:
            longest = max(limits.values())
            best = [method for method, h in limits.items() if h == longest]
            who = enumeration(best) if len(best) <= NAMED else f"{len(best)} of {len(limits)} methods"
            parts.append(f"the largest usable step is {longest:.3g} ({who})")
        sentence = "; ".join(parts)
        return f"{sentence[0].upper()}{sentence[1:]}." if parts else ""

    def section(self, result: Result, subject: Subject) -> Section:
        """Return the section with the diagram of the stability regions and the tables of all tests."""
        return Section('{% include "sections/stability.html.j2" %}', data(result, subject))

    def overview(self, result: Result, subject: Subject) -> Section | None:
        """Return a paragraph that says how many steps with extreme input have a wrong result.

        If no steps with extreme input were tested, return None.
        """
        answers = sum(len(s.findings.answers) for s in result.measured)
        wrong = sum(len(s.wrong) for s in result.measured)
        return Section(OVERVIEW, {"wrong": wrong, "all": answers}) if answers else None


def data(result: Result, subject: Subject) -> dict[str, object]:
    """Return the variables of the template for the section."""
    methods = result.measured
    stiff = [(s, v) for s in methods for v in s.findings.stiff]
    rows = [_row(s) for s in methods]
    return {
        "rows": rows,
        "undetermined": any(row["other"] for row in rows),
        "failures": result.failures,
        "picture": _picture(methods, subject),
        "command": subject.report_command("stability"),
        "cases": [_cases(s) for s in methods],
        "variants": [
            {"variant": name, "verdicts": [(s.method, v.verdict) for s, v in stiff if v.variant == name]}
            for name in dict.fromkeys(v.variant for _, v in stiff)
        ],
        "endurance": [(s.method, e.name, endurance_text(e)) for s in methods for e in s.findings.endurance],
        "notes": list(dict.fromkeys(note for s in methods for note in s.findings.notes)),
    }


def _picture(methods: Sequence[Stability], subject: Subject) -> Picture | None:
    styles = subject.styles
    functions = [(s.method, styles.of(s.method), s.region.value) for s in methods if s.region is not None]
    if not functions:
        return None
    title = f"Regions of linear stability, {subject.scene.title}"
    return Picture(
        region_figure(f"{methods[0].scene} regions", title, functions),
        "The regions of linear stability for y′ = λy, shaded: |R(hλ)| ≤ 1, where R is the stability function "
        "of the method. If several methods have the same R, their markers alternate along the boundary.",
        subject.report_command("stability"),
    )


def _row(stability: Stability) -> dict[str, object]:
    kinds = Counter(_kind(a) for a in stability.findings.answers)
    limit, linear = stability.findings.limit, stability.region
    return {
        "label": stability.method,
        "h": "none" if limit.h is None else f"{limit.h:.3g}",
        "reason": limit.reason,
        "real": "–" if linear is None else interval(linear.real, 3),
        "imaginary": "–" if linear is None else interval(linear.imaginary, 3),
        "accurate": kinds["accurate"],
        "status": kinds["status"],
        "other": kinds["undetermined"],
        "wrong": kinds["wrong"],
    }


def _kind(answer: Answer) -> str:
    if answer.verdict.startswith(WRONG):
        return "wrong"
    return answer.verdict.partition(":")[0] if answer.verdict != ACCURATE else "accurate"


def _cases(stability: Stability) -> dict[str, object]:
    """Return the results of one method for extreme inputs, as variables of a page template."""
    rows: list[dict[str, object]] = []
    names: list[str] = []
    for a in stability.findings.answers:
        if rows and a.error is None and rows[-1]["verdict"] == a.verdict:
            names.append(a.case.name)
            continue
        names = [a.case.name]
        rows.append(
            {
                "names": names,
                "verdict": a.verdict,
                "kind": _kind(a),
                "error": "" if a.error is None else scientific(a.error),
                "digits": "" if a.determined in (None, float("inf")) else f"{a.determined:.0f}",
            }
        )
    return {"label": stability.method, "count": len(stability.findings.answers), "rows": rows}


def endurance_text(run: Endurance) -> str:
    """Return the number of steps, the residual of the manifold equations, and the distance from the start.

    Values that were not measured are omitted. If a step failed, return the status message of the failed step.
    """
    if run.failure:
        return run.failure
    parts = [f"{run.steps} steps"]
    parts += [] if run.defect is None else [f"residual {scientific(run.defect)} of the manifold equations"]
    parts += [] if run.returned is None else [f"distance {scientific(run.returned)} from the start"]
    return ", ".join(parts) + ("" if run.held else "; rounding errors do not explain this result")
