"""The section about run times: the error and the CPU time of methods and peers.

A peer is an integrator that does not belong to this project.

The section also shows the fastest integrator at each error level, and the operations of a step.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from codegen.lab.efficiency.bench import Bench, Result, curves, emitted_forms, peer_forms, table
from codegen.lab.efficiency.emitted_candidate import EmittedCandidate
from codegen.lab.efficiency.equations import all_equations
from codegen.lab.efficiency.ranking import in_form, prevailing_form
from codegen.lab.efficiency.work_precision import Candidate, Refused, Row
from codegen.lab.measurement import Measurement, Section
from codegen.lab.page.figures import efficiency_figure
from codegen.lab.page.formatting import Picture, decade, duration, enumeration
from codegen.lab.peers import find
from codegen.lab.subject import Subject
from codegen.lower import lowering
from codegen.printers import DEFAULT
from codegen.scenes import file_stem


@dataclass(frozen=True)
class CostResult:
    """The results of all runs. ``candidates`` contains the methods and peers (other integrators)."""

    result: Result
    candidates: tuple[Candidate, ...]


class Cost(Measurement[CostResult]):
    """Measures the error and the CPU time of all methods and peers (other integrators)."""

    name = "cost"
    title = "Error against run time"
    about = "the errors and the CPU times of methods and other integrators, and the operations per step"

    def run(self, subject: Subject) -> CostResult:
        """Measure all methods and peers (other integrators) of the subject.

        The methods in ``subject.methods`` run with equal steps. The methods in ``subject.adaptive`` run with
        step-size control.
        """
        scene, exact, budget = subject.scene, subject.exact, subject.effort.budget
        candidates: list[Candidate] = []
        equations = all_equations(scene)
        for method in subject.compiled.measured:
            suited = equations[0] if lowering(method.compiled.method.family).in_coordinates else None
            own = EmittedCandidate(
                scene, method.compiled.method, exact, DEFAULT, budget, method.compiled, suited
            )
            own.emit_seconds += method.seconds
            candidates.append(own)
            if lowering(method.compiled.method.family).in_coordinates:
                kind = method.compiled.method
                candidates += emitted_forms(scene, kind, exact, DEFAULT, budget, equations[1:])
        candidates += [Refused(f.method, DEFAULT, f.reason) for f in subject.compiled.failures]
        for m in subject.adaptive:
            candidates += emitted_forms(scene, m, exact, DEFAULT, budget, equations, adaptive=True)
        candidates += peer_forms(scene, find(subject.peers), exact, budget, equations)

        def done(row: Row) -> None:
            unit = "" if row.steps is None else "steps"
            subject.progress(f"{scene.name}, {row.method}: {row.control:g} {unit}")

        result = Bench(scene, exact, tuple(candidates)).run(done, subject.cache)
        return CostResult(result, tuple(candidates))

    def as_json(self, result: CostResult) -> object:
        """Return plain data with one row for each run of a method or a peer (another integrator)."""
        return [row.as_json() for row in result.result.rows]

    def verdict(self, result: CostResult, subject: Subject) -> str:
        """Return a sentence that names the fastest integrator for each error level 10^-k."""
        places = result.result.places
        if not places:
            return ""
        winners: dict[str, list[int]] = {}
        for place in places:
            winners.setdefault(place.winner.partition(" (")[0], []).append(place.decade)
        first, last = decade(places[0].decade), decade(places[-1].decade)
        if len(winners) == 1:
            return f"For every error from {first} to {last}, the fastest integrator is {next(iter(winners))}."
        choices = [f"{label} for errors of {_decades(ks)}" for label, ks in winners.items()]
        return f"The fastest integrator is {enumeration(choices)}."

    def section(self, result: CostResult, subject: Subject) -> Section:
        """Return the section with the work-precision diagram and its tables."""
        return Section('{% include "sections/cost.html.j2" %}', data(result.result, subject))

    def files(self, result: CostResult, subject: Subject) -> Mapping[str, str]:
        """Return a dictionary that maps a file name to a CSV text with one row for each run."""
        return {f"{file_stem(subject.scene)}.csv": table(result.result.rows)}


def data(result: Result, subject: Subject) -> dict[str, object]:
    """Return the variables of the template ``sections/cost.html.j2``: a diagram and the texts of tables."""
    name, last = result.scene.name, float(result.scene.span[1])
    title = f"Error against CPU time, {result.scene.title}"
    picture = efficiency_figure(
        f"{name} efficiency", title, curves(result, subject.styles), f"error at t = {last:g}"
    )
    return {
        "picture": Picture(
            picture,
            "Error against the CPU time of the whole run. Each point shows the shortest of several measured "
            "times. A broad line extends from the point to the upper quartile of the times. Dashed lines "
            "with open markers show peers (other integrators). Dash-dotted lines show methods with step-size "
            "control. For several p, a dotted line shows the slope -p that is typical of methods of order p.",
            subject.bench_command(),
        ),
        "places": [
            {
                "error": decade(p.decade),
                "winner": p.winner,
                "time": duration(p.seconds),
                "second": p.second,
                "behind": "" if p.behind is None else f"{p.behind / p.seconds:.2f}",
            }
            for p in result.places
        ],
        "split": _operations(result.entries),
        "failures": [
            (label, next(r.failure for r in rows if r.failure))
            for label, rows in result.entries.items()
            if rows and all(r.failure for r in rows)
        ],
    }


def _decades(numbers: Sequence[int]) -> str:
    """Return a text with the errors 10^-k for the sorted numbers k. Consecutive numbers become a range.

    >>> _decades([2, 4, 5, 6])
    '10⁻² and 10⁻⁴ to 10⁻⁶'
    """
    runs: list[list[int]] = []
    for k in numbers:
        if runs and k == runs[-1][-1] + 1:
            runs[-1].append(k)
        else:
            runs.append([k])
    return enumeration([decade(r[0]) if len(r) == 1 else f"{decade(r[0])} to {decade(r[-1])}" for r in runs])


def _operations(entries: Mapping[str, tuple[Row, ...]]) -> list[dict[str, str]]:
    """Return one row of a table for each method and for each peer (other integrator).

    The values per step are averages over all steps of one run: the successful run with the smallest steps.
    """
    lines = []
    for label, rows in entries.items():
        chosen = prevailing_form(rows)
        good = [r for r in chosen if r.steps and r.error is not None]
        if not good:
            continue
        last = good[-1]
        emit_seconds, compile_seconds = chosen[0].emit_seconds, max(r.compile_seconds for r in chosen)
        lines.append(
            {
                "label": in_form(label, last.form),
                "evaluations": _per_step(last.evaluations, last.steps),
                "exponentials": _per_step(last.exponentials, last.steps),
                "iterations": _per_step(last.iterations, last.steps),
                "ns": f"{last.ns_per_step:.0f}" if last.ns_per_step else "–",
                "emission": duration(emit_seconds) if emit_seconds else "–",
                "compilation": duration(compile_seconds) if compile_seconds > 1e-3 else "–",
            }
        )
    return lines


def _per_step(count: int | None, steps: int | None) -> str:
    return "–" if count is None or not steps else f"{count / steps:.3g}"
