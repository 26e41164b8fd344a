"""Cost on the page: error against CPU time, who is first at each accuracy, what a step consists of."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from markupsafe import Markup

from codegen.lab.bench import Result, curves
from codegen.lab.contest import Row
from codegen.lab.figures import efficiency_figure
from codegen.lab.page.spelling import Picture, decade, duration


def section(result: Result, again: str) -> dict[str, Any]:
    """Return what the templates need of a bench; ``again`` is the command that measures it again."""
    name, last = result.scene.name, float(result.scene.span[1])
    picture = efficiency_figure(f"{name} efficiency", curves(result), f"error at t = {last:g}")
    return {
        "picture": Picture(
            Markup(picture),
            "Error against the CPU time of the whole run, the least of several measurements. Dashed: peers.",
            again,
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
        "split": _split(result.entries),
        "failures": [
            (label, failed)
            for label, rows in result.entries.items()
            if (failed := next((r.failure for r in rows if r.failure), "")) and all(r.failure for r in rows)
        ],
    }


def _split(entries: Mapping[str, tuple[Row, ...]]) -> list[dict[str, str]]:
    """Return a row a contestant: what a step consists of on its finest rung, and its set-up."""
    found = []
    for label, rows in entries.items():
        good = [r for r in rows if r.steps and r.error is not None]
        if not good:
            continue
        last = good[-1]
        assert last.steps is not None
        emission, compilation = rows[0].emission_seconds, max(r.compile_seconds for r in rows)
        found.append(
            {
                "label": label,
                "evaluations": _each(last.evaluations, last.steps),
                "exponentials": _each(last.exponentials, last.steps),
                "sweeps": _each(last.iterations, last.steps),
                "ns": f"{last.ns_per_step:.0f}" if last.ns_per_step else "–",
                "emission": duration(emission) if emission else "–",
                "compilation": duration(compilation) if compilation > 1e-3 else "–",
            }
        )
    return found


def _each(count: int | None, steps: int) -> str:
    return "–" if count is None else f"{count / steps:.3g}"
