"""The report section on long runs: the growth of the deviations of conserved quantities, e.g. the energy."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from codegen.lab.invariants import MANIFOLD
from codegen.lab.long_runs.drift import CONFIDENCE
from codegen.lab.long_runs.long_run import LongRun, long_run
from codegen.lab.measurement import Measurement, Section
from codegen.lab.page.figures import Curve, growth_figure
from codegen.lab.page.formatting import Picture, enumeration, scientific
from codegen.lab.subject import CompiledMethod, MethodResults, Subject

LEAST = 1e-17
"""Deviations below LEAST are drawn as LEAST in a logarithmic plot."""

Result = MethodResults[LongRun]


class LongRuns(Measurement[Result]):
    """Measures the drift of conserved quantities over many steps.

    The step size is T/100, where T is the length of the time span of the scene. A run can be longer than T.
    """

    name = "long"
    title = "Long runs"
    about = "drift of conserved quantities and growth of rounding errors over many steps"
    json_key = "longruns"

    def run(self, subject: Subject) -> Result:
        """Make a long run with every method."""
        effort, scene = subject.effort, subject.scene
        h = float((scene.span[1] - scene.span[0]) / 100)

        def measure(m: CompiledMethod) -> LongRun:
            subject.progress(f"{scene.name}, {m.label}: {effort.steps} steps")
            key = ("long runs", m.files, h, effort.steps, effort.back, effort.rounding)
            return subject.cache.get(
                key,
                LongRun,
                lambda: long_run(m.compiled, h, effort.steps, back=effort.back, rounding=effort.rounding),
            )

        return subject.each(measure)

    def as_json(self, result: Result) -> object:
        """Return a list of dictionaries, one for each method."""
        return [*(run.as_json() for run in result.measured), *(f.as_json() for f in result.failures)]

    def holds(self, result: Result) -> bool:
        """Return True if every method completed its run."""
        return not result.failures and not any(run.failure for run in result.measured)

    def lines(self, result: Result, subject: Subject) -> Iterable[str]:
        """Return one line for each method that failed or did not complete its run."""
        for run in result.measured:
            if run.failure:
                yield f"{subject.scene.name} {run.method}: the long run stopped: {run.failure}"
        for failure in result.failures:
            yield f"{subject.scene.name} {failure.method}: the long run failed: {failure.reason}"

    def verdict(self, result: Result, subject: Subject) -> str:
        """Return a sentence that says for each method how the deviation of the energy grows.

        If the scene has no energy, the first invariant replaces the energy. If there is no invariant, the
        residual of the manifold equations replaces the energy. A second sentence lists the methods that did
        not complete their runs.
        """
        steps = subject.effort.steps
        stopped = [run for run in result.measured if run.steps < steps]
        sentences = []
        for name in _shown(result.measured)[:1]:
            laws: dict[str, list[str]] = {}
            for run in result.measured:
                for kept in run.kept if run.steps >= steps else ():
                    if kept.name == name:
                        laws.setdefault(kept.drift.law, []).append(run.method)
            listed = "; ".join(f"{law} for {enumeration(methods)}" for law, methods in laws.items())
            if listed:
                about = f"Growth of the deviation of the {name} over {_count(steps)} steps"
                sentences.append(f"{about}: {listed}.")
        if stopped:
            listed = enumeration([f"{run.method} after {_count(run.steps)} steps" for run in stopped])
            sentences.append(f"Runs that stopped early: {listed}.")
        return " ".join(sentences)

    def section(self, result: Result, subject: Subject) -> Section:
        """Return the section with the diagrams and tables of the long runs."""
        runs, effort = result.measured, subject.effort
        values = {
            "pictures": _pictures(runs, subject),
            "steps": _count(effort.steps),
            "h": f"{float((subject.scene.span[1] - subject.scene.span[0]) / 100):g}",
            "confidence": f"{100 * CONFIDENCE:.0f}\u00a0%",
            "rounded": max((g.steps[-1] for run in runs for g in run.rounding), default=0),
            "runs": [_run(run) for run in runs],
            "failures": result.failures,
        }
        return Section('{% include "sections/long.html.j2" %}', values)


def _count(n: int) -> str:
    return f"{n:,}".replace(",", "\u00a0")


def _shown(runs: Sequence[LongRun]) -> list[str]:
    names = list(dict.fromkeys(k.name for run in runs for k in run.kept))
    shown = [n for n in names if n == "energy"] or [n for n in names if n != MANIFOLD][:1]
    return [*shown, *([MANIFOLD] if MANIFOLD in names else [])]


def _pictures(runs: Sequence[LongRun], subject: Subject) -> list[Picture]:
    pictures = []
    for name in _shown(runs):
        curves = [
            Curve(run.method, points, subject.styles.of(run.method))
            for run in runs
            if (points := _growth(run, name))
        ]
        if curves:
            title = f"Largest deviation of {name} against time, {subject.scene.title}"
            pictures.append(
                Picture(
                    growth_figure(f"{runs[0].scene} {name}", title, curves, f"largest deviation of {name}"),
                    f"The largest deviation of the {name} up to each time t. "
                    "Dotted lines show growth proportional to √t and to t.",
                    subject.report_command("long"),
                )
            )
    return pictures


def _growth(run: LongRun, name: str) -> tuple[tuple[float, float], ...]:
    for kept in run.kept:
        if kept.name != name:
            continue
        points: list[tuple[float, float]] = []
        largest = LEAST
        for t, x in zip(kept.times, kept.peaks, strict=True):
            if not math.isfinite(x):
                return tuple(points)
            if x > 1.02 * largest or not points:
                largest = max(x, LEAST)
                points.append((abs(t), largest))
        end = (abs(kept.times[-1]), largest)
        return (*points, end) if points[-1] != end else tuple(points)
    return ()


def _defect(run: LongRun) -> str:
    if run.symplectic is not None:
        return scientific(run.symplectic)
    return f"not measured: {run.unmeasured}" if run.unmeasured else "–"


def _run(run: LongRun) -> dict[str, object]:
    return {
        "label": run.method,
        "kept": [
            {
                "name": k.name,
                "largest": scientific(k.drift.largest),
                "slope": f"{scientific(k.drift.slope)} ± {scientific(k.drift.half_width, 1)}",
                "exponent": f"{k.drift.exponent:.2f}" if math.isfinite(k.drift.exponent) else "–",
                "law": k.drift.law + ("" if (t := k.drift.until) is None else f", saturates at t = {t:.3g}"),
            }
            for k in run.kept
        ],
        "symplectic": _defect(run),
        "back": "; ".join(f"{scientific(x)} after {n}" for n, x in run.reversals),
        "failure": run.failure,
        "rounding": [
            {
                "name": g.quantity,
                "steps": "compensated" if g.compensated else "plain",
                "rms": scientific(g.sizes[-1]),
                "exponent": f"{g.exponent:.2f} ± {g.half_width:.2f}",
                "law": g.law,
            }
            for g in run.rounding
        ],
    }
